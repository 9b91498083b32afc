#include "hlc_bridge/time/resident_memory.hpp"

#include <link.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdint>
#include <limits>
#include <memory>

namespace hlc::time {
namespace {

std::size_t page_size() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

/// An object's read-only segments. The address sanitizer places fences among constants.
__attribute__((no_sanitize("address"))) int read_segments(dl_phdr_info* object, std::size_t,
                                                          void*) {
  const std::uintptr_t page = page_size();
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& segment = object->dlpi_phdr[i];
    const bool is_constant = (segment.p_flags & PF_R) != 0 && (segment.p_flags & PF_W) == 0;
    if (segment.p_type != PT_LOAD || !is_constant) continue;
    const std::uintptr_t begin = object->dlpi_addr + segment.p_vaddr;
    for (std::uintptr_t at = begin / page * page; at < begin + segment.p_memsz; at += page) {
      static_cast<void>(*reinterpret_cast<const volatile char*>(at));
    }
  }
  return 0;
}

}  // namespace

void make_code_resident() { dl_iterate_phdr(read_segments, nullptr); }

void reserve_heap(std::size_t bytes) {
  constexpr int kNever = std::numeric_limits<int>::max();
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(bytes + page_size()));
  const auto heap = std::make_unique_for_overwrite<char[]>(bytes);
  for (std::size_t at = 0; at < bytes; at += page_size()) {
    *const_cast<volatile char*>(&heap[at]) = 1;
  }
}

}  // namespace hlc::time

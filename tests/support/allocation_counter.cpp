#include "tests/support/allocation_counter.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> counter{0};
}  // namespace

std::size_t hlc::test::num_allocations() { return counter; }

void* operator new(std::size_t size) {
  ++counter;
  void* memory = std::malloc(size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

// std::stable_sort asks for its buffer in this way; what is deleted below must come from malloc,
// too.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++counter;
  return std::malloc(size);
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

#pragma once

#include <cstddef>

namespace hlc::time {

/// Makes the memory of a control loop resident before the loop begins: the first touch of a page is
/// a fault, which takes longer than a whole search if the memory has to come from a virtual
/// machine's host, and milliseconds if code has to be read from a disk.

/// Reads all pages of code and constants of the program and of the loaded libraries. A system that
/// is short of memory may still drop them.
void make_code_resident();

/// Gives the calling thread's heap this many touched bytes, and lets the process keep all memory
/// that it frees from now on. Blocks up to that size come from the heap.
void reserve_heap(std::size_t bytes);

}  // namespace hlc::time

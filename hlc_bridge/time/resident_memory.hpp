#pragma once

#include <cstddef>

namespace hlc {

/// Memory that a control loop needs is the process's before the loop begins: the first touch of a
/// page is a fault, which takes longer than a whole search where the memory has to come from a
/// virtual machine's host, and milliseconds where code has to be read from a disk.

/// Reads all pages of code and constants of the program and of the libraries that are loaded.
/// A system that is short of memory may still drop them.
void make_code_resident();

/// Gives the calling thread's heap so many bytes that were touched, and lets the process keep all
/// that it frees from now on. Blocks up to that size come from the heap.
void reserve_heap(std::size_t bytes);

}  // namespace hlc

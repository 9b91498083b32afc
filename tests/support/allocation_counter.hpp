#pragma once

#include <cstddef>

namespace hlc::test {

/// Allocations of this program by `operator new` so far. A test that asks names
/// `support/allocation_counter.cpp` among its own sources: that file replaces the operator for the
/// whole program and is no part of the library. Eigen's dynamic matrices do not count.
[[nodiscard]] std::size_t num_allocations();

}  // namespace hlc::test

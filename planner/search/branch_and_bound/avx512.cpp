// The kernel for processors with AVX-512; see CMakeLists.txt for how it is compiled.
#include "planner/search/branch_and_bound/kernel.hpp"

namespace hlc::search::branch_and_bound {

Kernel avx512_kernel() { return {prepare, run, expand_start, is_free_entry}; }

}  // namespace hlc::search::branch_and_bound

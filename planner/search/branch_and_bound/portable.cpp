// The kernel for any processor.
#include "planner/search/branch_and_bound/kernel.hpp"

namespace hlc::search::branch_and_bound {

Kernel portable_kernel() { return {prepare, run, expand_start, is_free_entry}; }

}  // namespace hlc::search::branch_and_bound

#pragma once

#include "hlc_bridge/view/page_json.hpp"

namespace hlc::view {

/// Words of the page: an object of `keys`, what keys and mouse do; `terms`, what rows of a report
/// mean;
/// `qualities` of plans; and `reasons` why a vehicle kept its plan, by enumerator. In a reason,
/// CARS stands for the vehicles that hinder it; "REASON alone" has the words where there are none.
[[nodiscard]] Json page_words();

}  // namespace hlc::view

#pragma once

#include "hlc_bridge/view/page_json.hpp"

namespace hlc::view {

/// Words that the page shows, as data of a run: so they have a compiler that misses none of an
/// enumerator, and no part in the 60 kB of the page. An object of `keys`, what keys and mouse do
/// (page/main.js); `terms`, what rows of a report mean; `kinds` of states, with what the time
/// line's legend calls them, in its order ("late" is no state but a mark of the planning times);
/// `qualities` of plans; `reasons` why a vehicle kept its plan: [words in which CARS stands for the
/// vehicles that hinder it, words where none are named].
[[nodiscard]] Json page_words();

}  // namespace hlc::view

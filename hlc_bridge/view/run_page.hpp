#pragma once

#include <string>

#include "hlc_bridge/view/page_messages.hpp"

namespace hlc::view {

/// run.html: the page with the whole run in it. It opens from disk and loads nothing else.
///
/// The page's style sheet and modules stand in it as they are, the modules one after the other as
/// one, each after those that it imports, without their import lines and the word `export`: so the
/// names of all modules differ, and an import is one line. The data is a JSON text in which every
/// `<` is escaped, so that no name or message can end it.
[[nodiscard]] std::string run_page(const FinishedRun& run);

/// A page that shows nothing by itself, with the run in it: its script draws pictures of the run
/// (picture/picture.js, `window.picture`), of the page's own map.
[[nodiscard]] std::string picture_page(const FinishedRun& run);

/// The page of a run under way: it loads its files from the server that it comes from, and connects
/// to no other.
[[nodiscard]] std::string live_page();

}  // namespace hlc::view

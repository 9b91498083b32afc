#include "hlc_bridge/view/run_page.hpp"

#include <array>
#include <span>
#include <string_view>

#include "hlc_bridge/view/page_files.hpp"
#include "planner/common/demand.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::view {
namespace {

/// Each after those that it imports.
constexpr std::array kModules{"model.js", "words.js",    "draw.js", "timeline.js",
                              "panel.js", "controls.js", "main.js"};
constexpr std::array kPictureModules{"model.js", "words.js", "draw.js", "svg.js", "picture.js"};
constexpr std::string_view kExport = "export ";

const std::string& module_of(const std::string& name) {
  const auto file = page_files().find(name);
  return file != page_files().end() ? file->second : picture_files().at(name);
}

std::string as_one_script(std::span<const char* const> modules) {
  std::string script;
  for (const char* name : modules) {
    for (const std::string& line : split(module_of(name), '\n')) {
      if (line.starts_with("import ")) continue;
      script += line.starts_with(kExport) ? line.substr(kExport.size()) : line;
      script += '\n';
    }
  }
  return script;
}

/// @pre the template has the element
void replace(std::string& page, std::string_view element, const std::string& with) {
  const std::size_t at = page.find(element);
  HLC_DEMAND(at != std::string::npos, element);
  page.replace(at, element.size(), with);
}

/// The same JSON without `<`, which occurs in its strings only.
std::string escaped(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

/// @param page  the template
std::string filled(std::string page, std::span<const char* const> modules, const FinishedRun& run) {
  replace(page, R"(<script type="module" src="main.js"></script>)",
          "<script type=\"module\">\n" + as_one_script(modules) + "</script>");
  replace(page, R"(<link rel="stylesheet" href="page.css">)",
          "<style>\n" + page_files().at("page.css") + "</style>");
  const std::string begin = R"(<script type="application/json" id="data">)";
  replace(page, begin + "[]", begin + escaped(page_messages(run)));
  return page;
}

}  // namespace

std::string run_page(const FinishedRun& run) {
  return filled(page_files().at("run.html"), kModules, run);
}

std::string picture_page(const FinishedRun& run) {
  return filled(picture_files().at("picture.html"), kPictureModules, run);
}

std::string live_page() {
  std::string page = page_files().at("run.html");
  replace(page, "default-src 'none';", "default-src 'none'; connect-src 'self';");
  replace(page, R"(src="main.js")", R"(src="live.js")");
  return page;
}

}  // namespace hlc::view

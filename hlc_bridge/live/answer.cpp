#include "hlc_bridge/live/answer.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "hlc_bridge/view/page_files.hpp"
#include "planner/common/demand.hpp"

namespace hlc::live {
namespace {

constexpr std::string_view kJavaScript = "text/javascript; charset=utf-8";

/// @pre the text has the part
void replace(std::string& text, std::string_view part, std::string_view with) {
  const std::size_t at = text.find(part);
  HLC_DEMAND(at != std::string::npos, part);
  text.replace(at, part.size(), with);
}

std::string live_page() {
  std::string page = view::page_files().at("run.html");
  replace(page, "default-src 'none';", "default-src 'none'; connect-src 'self';");
  replace(page, "src=\"main.js\"", "src=\"live.js\"");
  return page;
}

bool names_this_machine(std::string_view host) {
  constexpr std::array<std::string_view, 3> kNames{"127.0.0.1", "localhost", "[::1]"};
  return std::ranges::any_of(kNames, [host](std::string_view name) {
    return host == name || (host.starts_with(name) && host[name.size()] == ':');
  });
}

Answer refusal(unsigned status, const std::string& line) {
  return {.status = status, .body = line + '\n'};
}

}  // namespace

Answer answer_to(const Request& request, Audience audience) {
  if (audience == Audience::kThisMachine && !names_this_machine(request.host)) {
    return refusal(403, "the host must be 127.0.0.1, localhost or [::1]");
  }
  if (request.method != "GET") return refusal(405, "the method must be GET");
  const std::string path = request.target.substr(0, request.target.find('?'));
  if (path == "/events") return {.type = "text/event-stream", .is_events = true};
  if (path == "/") return {.type = "text/html; charset=utf-8", .body = live_page()};
  const auto file = view::page_files().find(path.substr(std::min<std::size_t>(1, path.size())));
  if (!path.starts_with('/') || file == view::page_files().end() || path == "/run.html") {
    return refusal(404, "no such page; the view is at /");
  }
  const bool is_style = path.ends_with(".css");
  return {.type = is_style ? "text/css; charset=utf-8" : std::string(kJavaScript),
          .body = file->second};
}

}  // namespace hlc::live

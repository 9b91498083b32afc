#include "hlc_bridge/live/answer.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "hlc_bridge/live/foxglove_protocol.hpp"
#include "hlc_bridge/view/page_files.hpp"
#include "hlc_bridge/view/run_page.hpp"

namespace hlc::live {
namespace {

constexpr std::string_view kJavaScript = "text/javascript; charset=utf-8";

bool names_this_machine(std::string_view host) {
  constexpr std::array<std::string_view, 3> kNames{"127.0.0.1", "localhost", "[::1]"};
  return std::ranges::any_of(kNames, [host](std::string_view name) {
    return host == name || (host.starts_with(name) && host[name.size()] == ':');
  });
}

bool may_open_websocket(std::string_view origin) {
  constexpr std::array<std::string_view, 4> kOthers{"", "file://", "https://app.foxglove.dev",
                                                    "https://studio.foxglove.dev"};
  constexpr std::string_view kScheme = "http://";
  return std::ranges::find(kOthers, origin) != kOthers.end() ||
         (origin.starts_with(kScheme) && names_this_machine(origin.substr(kScheme.size())));
}

Answer refusal(unsigned status, const std::string& line) {
  return {.status = status, .body = line + '\n'};
}

Answer websocket_for(const Request& request, Audience audience) {
  if (audience == Audience::kThisMachine && !may_open_websocket(request.origin)) {
    return refusal(403, "the origin must be a program, this machine or https://app.foxglove.dev");
  }
  const std::string subprotocol = subprotocol_among(request.subprotocols);
  if (subprotocol.empty()) return refusal(400, "the subprotocol must be foxglove.websocket.v1");
  return {.status = 101, .subprotocol = subprotocol};
}

}  // namespace

Answer answer_to(const Request& request, Audience audience) {
  if (audience == Audience::kThisMachine && !names_this_machine(request.host)) {
    return refusal(403, "the host must be 127.0.0.1, localhost or [::1]");
  }
  if (request.method != "GET") return refusal(405, "the method must be GET");
  if (request.is_upgrade) return websocket_for(request, audience);
  const std::string path = request.target.substr(0, request.target.find('?'));
  if (path == "/events") return {.type = "text/event-stream", .is_events = true};
  if (path == "/") return {.type = "text/html; charset=utf-8", .body = view::live_page()};
  const auto file = view::page_files().find(path.substr(std::min<std::size_t>(1, path.size())));
  if (!path.starts_with('/') || file == view::page_files().end() || path == "/run.html") {
    return refusal(404, "no such page; the view is at /");
  }
  const bool is_style = path.ends_with(".css");
  return {.type = is_style ? "text/css; charset=utf-8" : std::string(kJavaScript),
          .body = file->second};
}

}  // namespace hlc::live

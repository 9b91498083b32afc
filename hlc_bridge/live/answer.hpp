#pragma once

#include <string>

namespace hlc::live {

/// The parts of an HTTP request that the answer depends on.
struct Request {
  std::string method;
  std::string target;
  std::string host;            ///< field Host; empty: none
  bool is_upgrade{};           ///< to a websocket
  std::string origin{};        ///< field Origin; empty: none
  std::string subprotocols{};  ///< field Sec-WebSocket-Protocol
};

struct Answer {
  unsigned status{200};
  std::string type{"text/plain; charset=utf-8"};  ///< Content-Type
  std::string body{};
  bool is_events{};           ///< the stream of events instead of the body
  std::string subprotocol{};  ///< a websocket of this subprotocol instead; empty: none
};

/// Who may ask.
enum class Audience {
  kThisMachine,  ///< whose requests name it as their host
  kAll,
};

/// `/`: the page of a run under way (hlc_bridge/view/page/live.js), `/events`: its messages, and
/// the page's files. Only GET is allowed.
///
/// A page of another site can make a browser of this machine ask here under the name of that site
/// (DNS rebinding), and could then read the answer: for kThisMachine such a host is refused.
/// Websockets may be opened by pages of any site: for kThisMachine the origin must be this machine,
/// a program, or Foxglove's site.
[[nodiscard]] Answer answer_to(const Request& request, Audience audience);

}  // namespace hlc::live

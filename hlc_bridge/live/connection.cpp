#include "hlc_bridge/live/connection.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace hlc::live {
namespace {

constexpr std::uint32_t kMostHeaderBytes = 8192;
constexpr std::size_t kMostBytesAtOnce = 256UL * 1024UL;
constexpr std::string_view kStillThere = ":\n\n";  // a comment, which browsers ignore

std::string text_of(boost::beast::string_view view) { return {view.data(), view.size()}; }

std::string head_of(const Answer& answer) {
  const auto reason = http::obsolete_reason(static_cast<http::status>(answer.status));
  std::string head = "HTTP/1.1 " + std::to_string(answer.status) + ' ' + text_of(reason);
  head += "\r\nContent-Type: " + answer.type;
  if (!answer.is_events) head += "\r\nContent-Length: " + std::to_string(answer.body.size());
  if (answer.status == 405) head += "\r\nAllow: GET";
  return head +
         "\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nX-Frame-Options: DENY"
         "\r\nConnection: close\r\n\r\n";
}

Answer refusal(error_code error) {
  if (error == http::error::header_limit) {
    return {.status = 431, .body = "the header is too long\n"};
  }
  if (error == http::error::body_limit) return {.status = 413, .body = "the body is too long\n"};
  return {.status = 400, .body = "not an HTTP request\n"};
}

}  // namespace

void Connection::start() {
  parser_.header_limit(kMostHeaderBytes);
  parser_.body_limit(kMostHeaderBytes);
  stream_.expires_after(site_.patience);
  http::async_read_header(
      stream_, buffer_, parser_,
      [self = shared_from_this()](error_code error, std::size_t) { self->answer(error); });
}

void Connection::answer(error_code error) {
  const bool is_refused = error && error.category() == make_error_code(http::error{}).category() &&
                          error != http::error::end_of_stream;
  if (is_refused) return send(refusal(error));
  if (error) return close();
  const auto& request = parser_.get();
  position_ = site_.history.position_after(text_of(request["Last-Event-ID"]));
  const Answer answer =
      answer_to({.method = text_of(request.method_string()),
                 .target = text_of(request.target()),
                 .host = text_of(request[http::field::host]),
                 .is_upgrade = websocket::is_upgrade(request),
                 .origin = text_of(request[http::field::origin]),
                 .subprotocols = text_of(request[http::field::sec_websocket_protocol])},
                site_.audience);
  if (answer.subprotocol.empty()) return send(answer);
  site_.open_websocket(std::move(stream_), parser_.release(), answer.subprotocol);
  close();
}

void Connection::send(const Answer& answer) {
  state_ = State::kAnswer;
  answer_ = head_of(answer) + answer.body;
  stream_.expires_after(site_.patience);
  asio::async_write(
      stream_, asio::buffer(answer_),
      [self = shared_from_this(), is_events = answer.is_events](error_code error, std::size_t) {
        if (error) return self->close();
        if (!is_events) return self->finish();
        self->state_ = State::kEvents;
        self->written_at_ = std::chrono::steady_clock::now();
        self->send_events();
      });
}

void Connection::send_events() {
  if (state_ != State::kEvents || is_writing_) return;
  const auto now = std::chrono::steady_clock::now();
  const std::size_t begin = position_;
  std::vector<asio::const_buffer> events;
  for (std::size_t bytes = 0; position_ < site_.history.size() && bytes < kMostBytesAtOnce;
       ++position_) {
    events.push_back(asio::buffer(site_.history.event(position_)));
    bytes += events.back().size();
  }
  if (position_ == begin) {
    if (site_.history.has_ended()) return finish();
    if (now - written_at_ < site_.patience) return;
    events.emplace_back(kStillThere.data(), kStillThere.size());
  }
  is_writing_ = true;
  written_at_ = now;
  stream_.expires_after(site_.patience);
  asio::async_write(stream_, events, [self = shared_from_this()](error_code error, std::size_t) {
    self->is_writing_ = false;
    if (error) return self->close();
    self->send_events();
  });
}

void Connection::finish() {
  state_ = State::kAnswer;
  error_code error;
  stream_.socket().shutdown(tcp::socket::shutdown_send, error);
  if (error) return close();
  stream_.expires_after(site_.patience);
  discard();
}

void Connection::discard() {
  stream_.async_read_some(asio::buffer(discarded_),
                          [self = shared_from_this()](error_code error, std::size_t) {
                            if (error) return self->close();
                            self->discard();
                          });
}

}  // namespace hlc::live

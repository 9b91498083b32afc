#include "hlc_bridge/live/foxglove_client.hpp"

#include <utility>

namespace hlc::live {
namespace {

constexpr std::size_t kMostMessageBytes = 65'536;  ///< of a client's message

}  // namespace

FoxgloveClient::FoxgloveClient(boost::beast::tcp_stream stream, const NewestMessages& messages,
                               std::chrono::milliseconds patience)
    : messages_(messages),
      patience_(patience),
      socket_(std::move(stream)),
      subscriptions_(view::LiveScene::channels().size()) {}

void FoxgloveClient::start(const http::request<http::empty_body>& request,
                           const std::string& subprotocol) {
  boost::beast::get_lowest_layer(socket_).expires_never();  // the websocket has its own timer
  socket_.set_option(websocket::stream_base::timeout{
      .handshake_timeout = patience_, .idle_timeout = patience_, .keep_alive_pings = true});
  socket_.set_option(websocket::stream_base::decorator([subprotocol](http::fields& answer) {
    answer.set(http::field::sec_websocket_protocol, subprotocol);
  }));
  socket_.read_message_max(kMostMessageBytes);
  socket_.async_accept(request, [self = shared_from_this()](error_code error) {
    if (error) {
      self->is_closed_ = true;
      return;
    }
    self->is_open_ = true;
    self->send(server_info(self->messages_.session()), false);
    self->send(advertisement(view::LiveScene::channels()), false);
    self->read();
  });
}

void FoxgloveClient::read() {
  socket_.async_read(
      buffer_, [self = shared_from_this()](error_code error, std::size_t) { self->take(error); });
}

void FoxgloveClient::take(error_code error) {
  if (error) {
    is_closed_ = true;
    return;
  }
  const auto data = buffer_.cdata();
  std::string status = subscriptions_.take({static_cast<const char*>(data.data()), data.size()});
  buffer_.consume(buffer_.size());
  if (!status.empty() && outbox_.size() <= 1) send(std::move(status), false);
  send_news();
  read();
}

void FoxgloveClient::send_news() {
  if (!is_open_ || is_closed_ || !outbox_.empty()) return;
  std::erase_if(sent_,
                [this](const auto& one) { return !subscriptions_.channels().contains(one.first); });
  for (const auto& [subscription, channel] : subscriptions_.channels()) {
    const NewestMessages::Newest& newest = messages_.of(channel);
    if (newest.number <= sent_[subscription]) continue;
    sent_[subscription] = newest.number;
    send(message_data(subscription, newest.time, newest.text), true);
  }
}

void FoxgloveClient::send(std::string bytes, bool is_binary) {
  outbox_.push_back({std::move(bytes), is_binary});
  if (outbox_.size() == 1) write_next();
}

void FoxgloveClient::write_next() {
  socket_.binary(outbox_.front().is_binary);
  socket_.async_write(asio::buffer(outbox_.front().bytes),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        self->outbox_.pop_front();
                        if (error) {
                          self->is_closed_ = true;
                        } else if (!self->outbox_.empty()) {
                          self->write_next();
                        }
                      });
}

void FoxgloveClient::finish() {
  if (!is_open_ || is_closed_ || !outbox_.empty()) return;
  is_open_ = false;
  socket_.async_close(websocket::close_code::going_away,
                      [self = shared_from_this()](error_code) { self->is_closed_ = true; });
}

}  // namespace hlc::live

#include "hlc_bridge/live/server.hpp"

#include <stdexcept>
#include <vector>

#include "hlc_bridge/live/connection.hpp"
#include "hlc_bridge/live/foxglove_client.hpp"

namespace hlc::live {
namespace {

constexpr std::chrono::seconds kFarewell{2};  ///< for clients to take the end of the history

asio::ip::address address_of(const std::string& text) {
  error_code error;
  asio::ip::address address = asio::ip::make_address(text, error);
  if (!error) return address;
  throw std::invalid_argument("--listen = " + text + ", must be an IP address of this machine");
}

/// @return whether the acceptor listens there; false: the port is taken
/// @throws std::invalid_argument for another reason
bool listen(tcp::acceptor& acceptor, const tcp::endpoint& endpoint) {
  error_code error;
  acceptor.open(endpoint.protocol());
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (!error) return true;
  acceptor.close();
  if (error == asio::error::address_in_use) return false;
  throw std::invalid_argument("--listen = " + endpoint.address().to_string() + ", port " +
                              std::to_string(endpoint.port()) + ": " + error.message());
}

void listen(tcp::acceptor& acceptor, const ServerOptions& options) {
  const asio::ip::address address = address_of(options.address);
  const std::uint16_t first = options.port.value_or(kFirstPort);
  const int count = options.port ? 1 : kNumPorts;
  for (int i = 0; i < count; ++i) {
    const auto port = static_cast<std::uint16_t>(first + i);
    if (listen(acceptor, {address, port})) return;
  }
  throw std::invalid_argument(
      "--port = " + std::to_string(first) +
      (options.port ? " is taken, must be free" : " and the next ones are taken, must be given"));
}

}  // namespace

class Server::Core {
 public:
  Core(const ServerOptions& options, const History& history, const NewestMessages& newest)
      : site_{.history = history,
              .audience = {},
              .patience = options.patience,
              .open_websocket =
                  [this](auto stream, const auto& request, const auto& subprotocol) {
                    viewers_.push_back(std::make_shared<FoxgloveClient>(std::move(stream), newest_,
                                                                        site_.patience));
                    viewers_.back()->start(request, subprotocol);
                  }},
        newest_(newest) {
    listen(acceptor_, options);
    if (!is_on_loopback()) site_.audience = Audience::kAll;
    accept();
  }

  [[nodiscard]] tcp::endpoint endpoint() const { return acceptor_.local_endpoint(); }
  [[nodiscard]] bool is_on_loopback() const { return endpoint().address().is_loopback(); }
  [[nodiscard]] std::size_t num_clients() const { return connections_.size() + viewers_.size(); }

  void run(std::chrono::milliseconds interval, const std::function<void()>& on_tick) {
    interval_ = interval;
    on_tick_ = on_tick;
    wait();
    context_.run();
  }

 private:
  using Clock = std::chrono::steady_clock;

  void accept() {
    is_accepting_ = true;
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      is_accepting_ = !error;
      if (error) return;  // no sockets left, for example: the next tick tries again
      if (num_clients() < kMostClients) {
        connections_.push_back(std::make_shared<Connection>(std::move(socket), site_));
        connections_.back()->start();
      }
      accept();
    });
  }

  void wait() {
    timer_.expires_after(interval_);
    timer_.async_wait([this](error_code) { tick(); });
  }

  void tick() {
    on_tick_();
    for (const auto& connection : connections_) connection->send_events();
    std::erase_if(connections_, [](const auto& connection) { return connection->is_closed(); });
    for (const auto& viewer : viewers_) {
      viewer->send_news();
      if (site_.history.has_ended()) viewer->finish();
    }
    std::erase_if(viewers_, [](const auto& viewer) { return viewer->is_closed(); });
    if (!is_accepting_) accept();
    if (site_.history.has_ended()) {
      if (!farewell_until_) farewell_until_ = Clock::now() + kFarewell;
      if (num_clients() == 0 || Clock::now() >= *farewell_until_) return context_.stop();
    }
    wait();
  }

  Site site_;
  const NewestMessages& newest_;
  std::chrono::milliseconds interval_{};
  std::function<void()> on_tick_;
  std::optional<Clock::time_point> farewell_until_;
  bool is_accepting_{};
  asio::io_context context_;
  tcp::acceptor acceptor_{context_};
  asio::steady_timer timer_{context_};
  std::vector<std::shared_ptr<Connection>> connections_;  // after the context of their sockets
  std::vector<std::shared_ptr<FoxgloveClient>> viewers_;
};

Server::Server(const ServerOptions& options, const History& history, const NewestMessages& newest)
    : core_(std::make_unique<Core>(options, history, newest)) {}
Server::~Server() = default;

std::string Server::url() const {
  const tcp::endpoint endpoint = core_->endpoint();
  const std::string address = endpoint.address().to_string();
  const std::string host = endpoint.address().is_v6() ? '[' + address + ']' : address;
  return "http://" + host + ':' + std::to_string(endpoint.port()) + '/';
}

std::uint16_t Server::port() const { return core_->endpoint().port(); }
bool Server::is_open_to_others() const { return !core_->is_on_loopback(); }
std::size_t Server::num_clients() const { return core_->num_clients(); }

void Server::run(std::chrono::milliseconds interval, const std::function<void()>& on_tick) {
  core_->run(interval, on_tick);
}

}  // namespace hlc::live

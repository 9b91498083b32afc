#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "tests/support/http_client.hpp"

namespace hlc::live {

/// A websocket by RFC 6455, as far as the tests need it: it sends messages in one frame.
class Websocket {
 public:
  struct Frame {
    int opcode{};  ///< 1: text, 2: binary, 8: close
    std::string payload;
  };

  /// Sends the request; `answer` is the head of what comes back.
  explicit Websocket(std::uint16_t port, const std::string& more = kSubprotocol) : client_(port) {
    client_.get("/",
                "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                    more);
    answer_ = client_.read_until("\r\n\r\n");
  }

  [[nodiscard]] const std::string& answer() const { return answer_; }

  /// A text. The mask is zero.
  void send(const std::string& text) const {
    std::string frame{'\x81'};
    const int size_bytes = text.size() < 126 ? 0 : text.size() < 65'536 ? 2 : 8;
    const std::size_t first = size_bytes == 0 ? text.size() : size_bytes == 2 ? 126 : 127;
    frame.push_back(static_cast<char>(0x80 | first));
    for (int i = size_bytes - 1; i >= 0; --i) {
      frame.push_back(static_cast<char>(text.size() >> (8 * i) & 0xFF));
    }
    client_.send(frame + std::string(4, '\0') + text);
  }

  /// The next message, or control frame but pings; nothing if the server has closed.
  [[nodiscard]] std::optional<Frame> next() {
    Frame message;
    for (;;) {
      const std::string head = client_.read_exactly(2);
      if (head.size() < 2) return std::nullopt;
      const int opcode = head[0] & 0x0F;
      const std::string payload = client_.read_exactly(payload_size(head[1]));
      if (opcode == kPing) continue;
      if (opcode != kContinuation) message.opcode = opcode;
      message.payload += payload;
      const bool is_last = (head[0] & 0x80) != 0;
      if (is_last) return message;
    }
  }

  static constexpr const char* kSubprotocol = "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n";

 private:
  static constexpr int kContinuation = 0;
  static constexpr int kPing = 9;

  [[nodiscard]] std::uint64_t payload_size(char of_head) {
    std::uint64_t size = static_cast<unsigned char>(of_head);
    if (size < 126) return size;
    const std::string long_size = client_.read_exactly(size == 126 ? 2 : 8);
    size = 0;
    for (const char byte : long_size) size = size << 8 | static_cast<unsigned char>(byte);
    return size;
  }

  test::HttpClient client_;
  std::string answer_;
};

}  // namespace hlc::live

#include "vehicle_sim/apps/hand_inputs.hpp"

#include <fcntl.h>
#include <linux/joystick.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace hlc::apps {

HandInputs::HandInputs(const std::string& gamepad) {
  if (!gamepad.empty()) {
    gamepad_ = open(gamepad.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (gamepad_ < 0) {
      throw std::invalid_argument("--gamepad = " + gamepad +
                                  ", must be a joystick device that can be read: " +
                                  std::generic_category().message(errno));
    }
  }
  termios terminal{};
  if (tcgetattr(STDIN_FILENO, &terminal) != 0) return;  // a pipe or a file
  terminal_before_ = terminal;
  terminal.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &terminal);
}

HandInputs::~HandInputs() {
  if (terminal_before_) tcsetattr(STDIN_FILENO, TCSANOW, &*terminal_before_);
  if (gamepad_ >= 0) close(gamepad_);
}

bool HandInputs::pass_to(guest::HandControl& control,
                         std::chrono::steady_clock::time_point deadline) {
  while (true) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return true;
    std::array<pollfd, 2> inputs{pollfd{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0},
                                 pollfd{.fd = gamepad_, .events = POLLIN, .revents = 0}};
    if (poll(inputs.data(), inputs.size(), static_cast<int>(left.count())) <= 0) continue;
    if (inputs[0].revents != 0 && !pass_keys(control)) return false;
    if (inputs[1].revents != 0 && !pass_axes(control)) return false;
  }
}

bool HandInputs::pass_keys(guest::HandControl& control) {
  std::array<char, 64> keys{};
  const ssize_t size = read(STDIN_FILENO, keys.data(), keys.size());
  if (size < 0) return errno == EINTR || errno == EAGAIN;
  control.type(std::string_view(keys.data(), static_cast<std::size_t>(size)));
  return size > 0;
}

bool HandInputs::pass_axes(guest::HandControl& control) const {
  std::array<char, sizeof(js_event)> bytes{};
  const ssize_t size = read(gamepad_, bytes.data(), bytes.size());
  if (size < 0) return errno == EINTR || errno == EAGAIN;
  if (size != static_cast<ssize_t>(bytes.size())) return false;
  js_event event{};
  std::memcpy(&event, bytes.data(), bytes.size());
  if ((event.type & ~JS_EVENT_INIT) == JS_EVENT_AXIS) control.push(event.number, event.value);
  return true;
}

}  // namespace hlc::apps

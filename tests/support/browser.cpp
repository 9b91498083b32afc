#include "tests/support/browser.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

namespace hlc::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr int kPatience_ms = 20'000;

/// Opened for both directions, so that nobody waits for the other side.
int make_pipe(const std::filesystem::path& path) {
  const int pipe =
      ::mkfifo(path.c_str(), 0600) == 0 ? ::open(path.c_str(), O_RDWR | O_CLOEXEC) : -1;
  if (pipe < 0) throw std::runtime_error(path.string() + ": cannot be made");
  return pipe;
}

std::vector<std::string> command_of(const std::filesystem::path& folder) {
  const std::string home = folder.string();
  return {"/bin/sh", "-c",
          "HOME=" + home + " exec " + chromium() +
              " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage"
              " --window-size=1200,800 --remote-debugging-pipe --user-data-dir=" +
              home + "/profile about:blank 3<" + home + "/commands 4>" + home + "/answers"};
}

}  // namespace

std::string chromium() {
  FILE* pipe = popen("command -v chromium", "r");
  std::array<char, 4096> line{};
  const bool is_there = pipe != nullptr && std::fgets(line.data(), line.size(), pipe) != nullptr;
  if (pipe != nullptr) pclose(pipe);
  const std::string path = is_there ? line.data() : "";
  return path.substr(0, path.find('\n'));
}

Browser::Browser()
    : commands_(make_pipe(folder_ / "commands")),
      answers_(make_pipe(folder_ / "answers")),
      process_(command_of(folder_.path()), folder_ / "log") {
  if (!eventually(60s, [this] {
        attach();
        return !session_.empty();
      })) {
    throw std::runtime_error("Chromium opens no page: " + read_text(folder_ / "log"));
  }
}

Browser::~Browser() {
  ::close(commands_);
  ::close(answers_);
}

void Browser::attach() {
  const json found = call("Target.getTargets", json::object());
  for (const json& target : found.value("targetInfos", json::array())) {
    if (target.value("type", "") != "page") continue;
    const json attached =
        call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}});
    session_ = attached.value("sessionId", "");
  }
}

void Browser::open(const std::string& url) {
  static_cast<void>(call("Page.navigate", {{"url", url}}));
}

json Browser::value_of(const std::string& expression) {
  const json answer =
      call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}});
  return answer.value("result", json::object()).value("value", json());
}

bool Browser::becomes_true(const std::string& expression) {
  return eventually(60s, [&] { return value_of(expression) == true; });
}

json Browser::call(const std::string& method, const json& parameters) {
  json command{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) command["sessionId"] = session_;
  const std::string text = command.dump() + '\0';
  if (::write(commands_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) return {};
  while (const auto message = next_message()) {
    const json answer = json::parse(*message, nullptr, false);
    if (answer.is_object() && answer.value("id", 0) == last_id_) {
      return answer.value("result", json::object());
    }
  }
  return json::object();
}

std::optional<std::string> Browser::next_message() {
  std::size_t end = received_.find('\0');
  while (end == std::string::npos) {
    pollfd readable{.fd = answers_, .events = POLLIN, .revents = 0};
    std::array<char, 65536> buffer{};
    if (::poll(&readable, 1, kPatience_ms) <= 0) return std::nullopt;
    const ssize_t count = ::read(answers_, buffer.data(), buffer.size());
    if (count <= 0) return std::nullopt;
    received_.append(buffer.data(), static_cast<std::size_t>(count));
    end = received_.find('\0');
  }
  std::string message = received_.substr(0, end);
  received_.erase(0, end + 1);
  return message;
}

}  // namespace hlc::test

#include "hlc_bridge/render/browser.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <vector>

namespace hlc::render {
namespace {

using nlohmann::json;

constexpr int kPatience_ms = 60'000;

std::filesystem::path log_in(const std::filesystem::path& folder) {
  return folder / "chromium.log";
}

std::vector<std::string> command_in(const std::filesystem::path& folder) {
  std::vector<std::string> command{
      "/usr/bin/env", "TMPDIR=" + folder.string(), "HOME=" + folder.string(),
      needed_path_of("chromium", "chromium"), "--headless", "--disable-gpu",
      "--disable-dev-shm-usage", "--disable-background-networking", "--disable-breakpad",
      "--no-first-run", "--window-size=1200,800", "--remote-debugging-pipe",
      // No name is looked up; tests have servers on this machine.
      "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
      "--user-data-dir=" + (folder / "profile").string()};
  if (::geteuid() == 0) command.emplace_back("--no-sandbox");  // with it root starts no browser
  return command;
}

/// Chromium takes commands from file 3 and answers on file 4.
std::vector<int> files_of(const Descriptor& nothing, const Descriptor& log, const Pipe& commands,
                          const Pipe& answers) {
  return {nothing.number(), log.number(), log.number(), commands.out.number(), answers.in.number()};
}

}  // namespace

Browser::Browser(int stop)
    : stop_(stop),
      process_(
          command_in(folder_.path()),
          files_of(open_file("/dev/null", O_RDONLY),
                   open_file(log_in(folder_.path()), O_WRONLY | O_CREAT), commands_, answers_)) {
  commands_.out.close();
  answers_.in.close();
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  const json attached =
      call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}});
  session_ = attached.at("sessionId");
}

void Browser::open(const std::string& url) {
  call("Page.navigate", {{"url", url}});
  static_cast<void>(
      value_of("document.readyState === 'complete' || "
               "new Promise((resolve) => addEventListener('load', () => resolve(true)))"));
}

json Browser::value_of(const std::string& expression) {
  const json answer =
      call("Runtime.evaluate",
           {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (answer.contains("exceptionDetails")) {
    const json thrown = answer["exceptionDetails"].value("exception", json::object());
    const std::string description = thrown.value("description", "an exception");
    throw Fault("the page: " + description.substr(0, description.find('\n')));
  }
  return answer.value("result", json::object()).value("value", json());
}

json Browser::call(const std::string& method, const json& parameters) {
  json command{{"id", ++last_id_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) command["sessionId"] = session_;
  try {
    write_all(commands_.in, command.dump() + '\0');
  } catch (const Fault&) {
    report_end();
  }
  while (true) {
    json answer = json::parse(next_message());
    if (answer.value("id", 0) != last_id_) continue;  // an event
    if (answer.contains("error")) {
      throw Fault("Chromium: " + method + ": " + answer["error"].value("message", ""));
    }
    return std::move(answer["result"]);
  }
}

std::string Browser::next_message() {
  std::size_t end = received_.find('\0');
  while (end == std::string::npos) {
    wait_for_answer();
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(answers_.out.number(), buffer.data(), buffer.size());
    if (count <= 0) report_end();
    const std::size_t known = received_.size();
    received_.append(buffer.data(), static_cast<std::size_t>(count));
    end = received_.find('\0', known);
  }
  std::string message = received_.substr(0, end);
  received_.erase(0, end + 1);
  return message;
}

void Browser::report_end() const {
  throw Fault("Chromium has ended: " + last_line_of(log_in(folder_.path())));
}

void Browser::wait_for_answer() const {
  std::array<pollfd, 2> files{pollfd{answers_.out.number(), POLLIN, 0}, pollfd{stop_, POLLIN, 0}};
  int num_ready = -1;
  do {
    num_ready = ::poll(files.data(), files.size(), kPatience_ms);
  } while (num_ready < 0 && errno == EINTR);
  if (files[1].revents != 0) throw Stopped{};
  if (num_ready <= 0) throw Fault("Chromium does not answer");
}

}  // namespace hlc::render

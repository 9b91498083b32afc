#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hlc_bridge/render/child_process.hpp"
#include "planner/common/temporary_folder.hpp"

namespace hlc::render {

/// What the user asked for is no longer wanted.
struct Stopped {};

/// A page in Chromium without a window, driven over the pipe of its DevTools. It sends nothing
/// beyond this machine.
///
/// It is to be made before a server of the same process, whose sockets it would inherit. All waits
/// end: with Fault if the browser ends or is silent for a minute.
class Browser {
 public:
  /// @param stop  file that ends every wait with Stopped once it is readable; -1: none
  /// @throws Fault, Stopped
  explicit Browser(int stop = -1);

  /// Returns when the page and its scripts are loaded. @throws Fault, Stopped
  void open(const std::string& url);
  /// Value of a JavaScript expression in the page, null for none as JSON.
  /// @throws Fault, also for an exception of the expression; Stopped
  [[nodiscard]] nlohmann::json value_of(const std::string& expression);
  /// @return result of a method of the DevTools. @throws Fault, also if it is refused; Stopped
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters);
  /// For files that go with this browser.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  [[nodiscard]] std::string next_message();
  void wait_for_answer() const;
  [[noreturn]] void report_end() const;

  TemporaryFolder folder_;
  int stop_;
  Pipe commands_{make_pipe()};
  Pipe answers_{make_pipe()};
  ChildProcess process_;
  std::string received_;
  std::string session_;
  int last_id_{};
};

}  // namespace hlc::render

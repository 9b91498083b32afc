#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {

/// Path of Chromium; empty: none on this machine.
[[nodiscard]] std::string chromium();

/// A page in Chromium without a window, driven over the pipe of its DevTools. It is to be made
/// before a server of the same process: it would inherit the sockets.
class Browser {
 public:
  /// @throws std::runtime_error if the browser does not start
  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  void open(const std::string& url);
  /// Value of a JavaScript expression in the page; null: there is none, or the browser is silent.
  [[nodiscard]] nlohmann::json value_of(const std::string& expression);
  /// Whether the expression becomes true.
  [[nodiscard]] bool becomes_true(const std::string& expression);

 private:
  /// @return `result` of the answer; null: none
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters);
  std::optional<std::string> next_message();
  void attach();

  TemporaryFolder folder_;
  int commands_;
  int answers_;
  ChildProcess process_;
  std::string received_;
  std::string session_;
  int last_id_{};
};

}  // namespace hlc::test

#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hlc_bridge/view/run_page.hpp"
#include "tests/support/temporary_folder.hpp"

/// The page of a run in a browser, opened from disk. Skipped on a machine without Chromium.
namespace hlc::view {

inline std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::string output;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
  pclose(pipe);
  return output;
}

inline std::string browser() {
  const std::string path = output_of("command -v chromium");
  return path.substr(0, path.find('\n'));
}

/// What a test's script uses: `page`, text and clicks.
inline constexpr const char* kHelpers = R"(
  const page = window.page;
  const by_id = (id) => document.getElementById(id);
  const text = (id) => by_id(id).textContent;
  const row = (name) => document.querySelector(`[data-row="${name}"]`).textContent;
  const at = (t) => { page.player.seek(t); page.draw(); };
  const press = (key) => {
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
    page.draw();
  };
  const click = (element, x, y) => {
    const { left, top } = element.getBoundingClientRect();
    for (const type of ["pointerdown", "pointerup"]) {
      const place = { clientX: left + x, clientY: top + y, pointerId: 1, bubbles: true };
      element.dispatchEvent(new PointerEvent(type, place));
    }
    page.draw();
  };
)";

/// As JSON without characters that the printed page would escape.
inline constexpr const char* kPutResult = R"(
  by_id("result").textContent = JSON.stringify(result).replace(
    /[<>&]/g, (c) => "\\u00" + c.charCodeAt(0).toString(16));
</script>
)";

class PageInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (browser().empty()) GTEST_SKIP() << "no chromium on this machine";
  }

  [[nodiscard]] nlohmann::json result_of(const FinishedRun& run, const std::string& script,
                                         const std::string& address = "") const {
    return result_of(run_page(run), script, address);
  }

  /// Opens the page and runs a script after it. @return what it has put into `result`
  [[nodiscard]] nlohmann::json result_of(std::string page, const std::string& script,
                                         const std::string& address = "") const {
    const std::string end = "</body>";
    page.insert(page.find(end),
                std::string("<pre id=\"result\"></pre><script type=\"module\">const result = {};") +
                    kHelpers + script + kPutResult);
    const std::filesystem::path file = folder_ / "run.html";
    test::put(file, page);
    const std::string dom = output_of(
        "HOME=" + folder_.path().string() + " timeout 60 " + browser() +
        " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --window-size=1200,800" +
        " --user-data-dir=" + (folder_ / "profile").string() + " --virtual-time-budget=3000" +
        " --dump-dom 'file://" + file.string() + address + "' 2>" + (folder_ / "log").string());
    const std::string begin = "<pre id=\"result\">";
    const std::size_t from = dom.find(begin);
    const std::size_t to = dom.find("</pre>", from);
    if (from == std::string::npos || to == from + begin.size()) {
      ADD_FAILURE() << "the script has no result: " << dom.substr(0, 2000);
      return nlohmann::json::object();
    }
    return nlohmann::json::parse(dom.substr(from + begin.size(), to - from - begin.size()));
  }

 private:
  test::TemporaryFolder folder_;
};

}  // namespace hlc::view

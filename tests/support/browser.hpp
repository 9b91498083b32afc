#pragma once

#include <string>

#include "hlc_bridge/render/browser.hpp"
#include "tests/support/child_process.hpp"

namespace hlc::test {

/// Whether a JavaScript expression in the page becomes true. One that throws is not true yet.
[[nodiscard]] inline bool becomes_true(render::Browser& browser, const std::string& expression) {
  return eventually(std::chrono::seconds{60}, [&] {
    try {
      return browser.value_of(expression) == true;
    } catch (const render::Fault&) {
      return false;
    }
  });
}

}  // namespace hlc::test

#pragma once

#include <string>

namespace hlc::apps {

/// While it lives, Ctrl-C (SIGINT) ends the program with exit code 130 and one line on stderr:
/// "PROGRAM: interrupted; HOW TO GO ON". What is in files by then stays. At most one at a time.
class Interruption {
 public:
  Interruption(const std::string& program, const std::string& how_to_go_on);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
};

}  // namespace hlc::apps

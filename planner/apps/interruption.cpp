#include "planner/apps/interruption.hpp"

#include <unistd.h>

#include <csignal>

namespace hlc::apps {
namespace {

constexpr int kExitInterrupted = 130;

/// What the signal's handler writes; it may not allocate.
std::string& message() {
  static std::string text;
  return text;
}
const char* message_begin = nullptr;
std::size_t message_size = 0;

extern "C" void end_interrupted(int /*signal*/) {
  // What follows is the same whether or not the line could be written.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message_begin, message_size);
  ::_exit(kExitInterrupted);
}

}  // namespace

Interruption::Interruption(const std::string& program, const std::string& how_to_go_on) {
  // A line of progress may be under way there.
  message() = std::string(isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") + program +
              ": interrupted; " + how_to_go_on + '\n';
  message_begin = message().data();
  message_size = message().size();
  std::signal(SIGINT, &end_interrupted);
}

Interruption::~Interruption() { std::signal(SIGINT, SIG_DFL); }

}  // namespace hlc::apps

#include "hlc_bridge/render/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "planner/common/text_file.hpp"

namespace hlc::render {
namespace {

int checked(int result, const std::string& what) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), what);
  return result;
}

/// In the child, where only calls are allowed that are safe after fork.
[[noreturn]] void become(char* const* argv, const std::vector<int>& files, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);  // it ended before prctl took effect
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  for (std::size_t i = 0; i < files.size(); ++i) ::dup2(files[i], static_cast<int>(i));
  ::execv(argv[0], argv);
  ::_exit(127);
}

}  // namespace

std::string path_of(const std::string& program) {
  const char* const folders = std::getenv("PATH");
  if (folders == nullptr) return "";
  for (const std::string& folder : split(folders, ':')) {
    std::string path = folder + "/" + program;
    if (::access(path.c_str(), X_OK) == 0 && std::filesystem::is_regular_file(path)) return path;
  }
  return "";
}

std::string needed_path_of(const std::string& program, const std::string& package) {
  std::string path = path_of(program);
  if (path.empty()) {
    throw Fault(program + " is not installed: apt-get install " + package + " (Debian)");
  }
  return path;
}

void Descriptor::close() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));
}

Pipe make_pipe() {
  int ends[2];
  checked(::pipe2(ends, O_CLOEXEC), "pipe");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

Descriptor open_file(const std::filesystem::path& file, int flags) {
  return Descriptor(checked(::open(file.c_str(), flags | O_CLOEXEC, 0600), file.string()));
}

void write_all(const Descriptor& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file.number(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Fault(std::generic_category().message(errno));
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const std::vector<int>& files) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  // Copies beyond the numbers that the program gets: none replaces one that is still to be copied.
  std::vector<Descriptor> copies;
  std::vector<int> numbers;
  for (const int file : files) {
    const int least = static_cast<int>(files.size());
    copies.emplace_back(checked(::fcntl(file, F_DUPFD_CLOEXEC, least), "fcntl"));
    numbers.push_back(copies.back().number());
  }
  const pid_t parent = ::getpid();
  pid_ = checked(::fork(), "fork");
  if (pid_ == 0) become(argv.data(), numbers, parent);
}

ChildProcess::~ChildProcess() {
  ::kill(-pid_, SIGKILL);
  if (has_ended_) return;
  ::kill(pid_, SIGKILL);  // it may not have its group yet
  ::waitpid(pid_, nullptr, 0);
}

bool ChildProcess::is_good_at_end() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  has_ended_ = true;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string last_line_of(const std::filesystem::path& log) {
  std::string last = "no message";
  for (const std::string& line : split(read_file(log), '\n')) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace hlc::render

// Programs given a file that is none, or that is too large.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <string>
#include <tuple>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

struct Command {
  std::string name;
  std::string before;  ///< the file
};
void PrintTo(const Command& one, std::ostream* out) { *out << one.name; }

struct Input {
  std::string name;
  std::function<void(const fs::path&)> make;
};
void PrintTo(const Input& one, std::ostream* out) { *out << one.name; }

class Inputs : public testing::TestWithParam<std::tuple<Command, Input>> {};

// A pipe without a writer was waited for. A gigabyte of addresses is less than what the libraries
// of a sanitizer reserve.
TEST_P(Inputs, AreRefusedInOneLine) {
  const auto& [command, input] = GetParam();
  const test::TemporaryFolder folder;
  const fs::path file = folder / "input";
  input.make(file);
#if defined(__SANITIZE_ADDRESS__)
  const std::string limits;
#else
  const std::string limits = "ulimit -v 1000000; ";
#endif
  const test::Outcome outcome =
      test::run_command(limits + "timeout 60 " + test::build_folder() + "/bin/" + command.before +
                        file.string() + " </dev/null");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, testing::HasSubstr(file.string()));
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output.substr(0, 2000);
  EXPECT_LT(outcome.output.size(), 500U);
}

void write_keys(const fs::path& file) {
  std::ofstream stream(file);
  for (int i = 0; i < 100'000; ++i) stream << "key_" << i << ": 1\n";
}

void write_long_value(const fs::path& file) {
  std::ofstream(file) << "name: [" << std::string(1'000'000, 'x') << "]\n";
}

void write_zeros(const fs::path& file) {
  test::put(file, "");
  fs::resize_file(file, 100'000'000);
}

INSTANTIATE_TEST_SUITE_P(
    Programs, Inputs,
    testing::Combine(
        testing::Values(Command{"ShowScenario", "show_scenario --scenario "},
                        Command{"Rollout", "rollout --scenario "},
                        Command{"ShowAutomaton", "show_automaton "},
                        Command{"BuildAutomaton", "build_automaton --out /dev/null "},
                        Command{"PlanProblem", "plan_problem "}),
        testing::Values(
            Input{"Pipe", [](const auto& file) { EXPECT_EQ(mkfifo(file.c_str(), 0600), 0); }},
            Input{"Device", [](const auto& file) { fs::create_symlink("/dev/zero", file); }},
            Input{"Folder", [](const auto& file) { fs::create_directory(file); }},
            Input{"ZerosOf100Megabytes", write_zeros}, Input{"100000Keys", write_keys},
            Input{"LongValue", write_long_value})),
    [](const auto& one) { return std::get<0>(one.param).name + std::get<1>(one.param).name; });

}  // namespace
}  // namespace hlc::apps

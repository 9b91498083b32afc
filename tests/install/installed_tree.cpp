#include "tests/install/installed_tree.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "planner/common/program_version.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {

namespace fs = std::filesystem;

std::vector<std::string> installed_programs() {
  std::istringstream programs(HLC_PROGRAMS);
  std::vector<std::string> names;
  for (std::string name; programs >> name;) names.push_back(name);
  return names;
}

std::string command_of(const std::string& program) {
  std::string command = "hlc-" + program;
  std::ranges::replace(command, '_', '-');
  return command;
}

Outcome run_in(const fs::path& folder, const fs::path& prefix, const std::string& command) {
  return run_command("cd " + folder.string() + " && " + (prefix / "bin").string() + "/" + command);
}

void expect_every_command(const fs::path& prefix) {
  std::set<std::string> expected{"hlc-run-lab", "hlc-vehicle"};
  for (const std::string& program : installed_programs()) expected.insert(command_of(program));
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(prefix / "bin")) {
    found.insert(entry.path().filename());
    const Outcome outcome = run_in("/", prefix, entry.path().filename().string() + " --version");
    EXPECT_EQ(outcome.exit_code, 0) << entry.path() << ": " << outcome.output;
    EXPECT_NE(outcome.output.find(' ' + program_release() + ", revision "), std::string::npos)
        << entry.path() << ": " << outcome.output;
  }
  EXPECT_EQ(found, expected);
}

void expect_it_drives(const fs::path& prefix) {
  const TemporaryFolder folder;
  const Outcome outcome = run_in(folder.path(), prefix, "hlc-run-lab --steps 5 --out run");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(outcome.output.find("Building"), std::string::npos) << outcome.output;
  EXPECT_TRUE(fs::exists(folder / "run/summary.json")) << outcome.output;
}

double built_cost_m2() {
  const Outcome outcome = run_program("plan_problem --json " + source_folder() +
                                      "/launch_scripts/problems/parked_car.json");
  return nlohmann::json::parse(outcome.output).at("cost").get<double>();
}

}  // namespace hlc::test

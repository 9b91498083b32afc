#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {

/// A program in a folder of its own, as it is deployed, with a stand-in for report/draw.sh: it
/// needs no Python, and leaves the drawing's data as the drawing.
class DeployedProgram {
 public:
  explicit DeployedProgram(const std::string& name) : name_(name) {
    std::filesystem::copy_file(std::filesystem::path(build_folder()) / "bin" / name,
                               folder_ / name);
    std::filesystem::create_directory(folder_ / "report");
    put_script("echo \"$1\" > \"$3.kind\" && cp \"$2\" \"$3\"");
  }

  void put_script(const std::string& body) const {
    const std::filesystem::path script = folder_ / "report/draw.sh";
    std::ofstream(script) << "#!/bin/sh\n" << body << '\n';
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  }
  void remove_script() const { std::filesystem::remove(folder_ / "report/draw.sh"); }

  [[nodiscard]] Outcome run(const std::string& flags) const {
    return run_command((folder_ / name_).string() + " " + flags + " --plot " + plot().string());
  }

  [[nodiscard]] std::filesystem::path plot() const { return folder_ / "out.svg"; }
  [[nodiscard]] nlohmann::json drawn() const {
    return nlohmann::json::parse(std::ifstream(plot()), nullptr, false);
  }
  [[nodiscard]] std::string kind() const {
    std::string kind;
    std::ifstream(plot().string() + ".kind") >> kind;
    return kind;
  }

 private:
  std::string name_;
  TemporaryFolder folder_;
};

}  // namespace hlc::test

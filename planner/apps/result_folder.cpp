#include "planner/apps/result_folder.hpp"

#include <unistd.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "planner/apps/scenario_name.hpp"
#include "planner/common/processor_model.hpp"
#include "planner/common/program_version.hpp"
#include "planner/common/run_program.hpp"

namespace hlc::apps {

using Json = nlohmann::ordered_json;

std::string command_line(int argc, const char* const* argv) {
  std::string line = std::filesystem::path(argv[0]).filename().string();
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  return line;
}

EvaluationOrigin origin_of(const std::string& command) {
  return {.command = command,
          .revision = program_revision(),
          .compiler = "GCC " __VERSION__,
          .processor = processor_model()};
}

std::string campaign_json(const std::string& kind, const EvaluationOrigin& origin,
                          const Json& content) {
  Json json;
  json["kind"] = kind;
  json["origin"] = Json{{"command", origin.command},
                        {"revision", origin.revision},
                        {"compiler", origin.compiler},
                        {"processor", origin.processor}};
  json[kind] = content;
  return json.dump(1) + "\n";
}

bool make_report(const std::string& program, const std::filesystem::path& folder) {
  const std::filesystem::path script = program_folder() / "report/report.sh";
  if (::access(script.c_str(), X_OK) != 0) {
    std::cerr << program << ": " << script.string() << ": not found, must be beside the program\n";
    return false;
  }
  if (run_program({script.string(), folder.string()})) return true;
  std::cerr << program
            << ": the report was not made; the rows stay, and the same command goes on\n";
  return false;
}

}  // namespace hlc::apps

#include "hlc_bridge/record/configuration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "planner/common/node.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::record {
namespace {

namespace fs = std::filesystem;

/// Folder and name of a file's copy.
fs::path folder_and_name(const fs::path& file) {
  const fs::path full = fs::absolute(file).lexically_normal();
  return full.parent_path().filename() / full.filename();
}

/// For YAML: null for none.
std::string text_of(const std::optional<std::string>& value) {
  return value ? quoted_yaml(*value) : "null";
}

fs::path flags_file(const fs::path& run_folder) {
  return run_folder / "configuration" / "flags.yaml";
}

fs::path copy_or_original(const fs::path& run_folder, const fs::path& file) {
  fs::path copy = kept_copy(run_folder, file);
  return fs::exists(copy) ? copy : file;
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  return a.filename() == b.filename() && read_file(a) == read_file(b);
}

/// Compares what is given with what a run was driven with.
class Comparison {
 public:
  explicit Comparison(const fs::path& run_folder) : flags_{flags_file(run_folder).string()} {}

  template <class Value>
  void check(const char* flag, const std::optional<Value>& given,
             const std::optional<Value>& kept) const {
    if (given && given != kept) refuse(flag, *given, kept ? fmt::to_string(*kept) : "left out");
  }
  void check_file(const char* flag, const fs::path& given,
                  const std::optional<fs::path>& kept) const {
    if (given.empty() || (kept && is_same_file(given, *kept))) return;
    refuse(flag, given.string(), kept ? kept->string() + ", or the same" : "left out");
  }

 private:
  template <class Value>
  [[noreturn]] void refuse(const char* flag, const Value& given, const std::string& kept) const {
    throw std::invalid_argument(
        fmt::format("{} = {}, must be {}: the run was driven so ({})", flag, given, kept, flags_));
  }

  std::string flags_;
};

void check_same(const fs::path& run_folder, const scenario::ScenarioChoices& given,
                const scenario::ScenarioChoices& kept) {
  const Comparison comparison(run_folder);
  comparison.check_file("--scenario", given.file, kept.file);
  if (!given.profile.empty()) {
    comparison.check("--profile", std::optional(given.profile), std::optional(kept.profile));
  }
  comparison.check("--engine", given.engine, kept.engine);
  comparison.check("--priorities", given.priorities, kept.priorities);
  comparison.check("--subgraph", given.subgraph, kept.subgraph);
  comparison.check("--policy", given.policy, kept.policy);
  comparison.check_file("--map", given.map_file.value_or(fs::path{}), kept.map_file);
  comparison.check("--cars", given.cars, kept.cars);
  comparison.check("--seed", given.seed, kept.seed);
  comparison.check("--routes", given.routes, kept.routes);
}

std::optional<std::string> text_or_null(const Node& flags, const std::string& key) {
  return flags.is_value(key) ? std::optional(flags.required<std::string>(key)) : std::nullopt;
}

/// The copy of the file that is named, or the file.
fs::path kept_file(const fs::path& run_folder, const Node& flags, const std::string& key) {
  const auto path = flags.required<std::string>(key);
  if (path.empty()) flags.fail(key, "a path");
  return copy_or_original(run_folder, path);
}

}  // namespace

fs::path kept_copy(const fs::path& run_folder, const fs::path& file) {
  return run_folder / "configuration" / folder_and_name(file);
}

fs::path path_between_kept(const fs::path& file) { return ".." / folder_and_name(file); }

void keep_configuration(const fs::path& run_folder, const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const fs::path copy = kept_copy(run_folder, file);
    const fs::path folder = copy.parent_path();
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      throw std::runtime_error(folder.string() + ": cannot be created");
    }
    write_file(copy, read_file(file));
  }
}

std::string flags_yaml(const scenario::ScenarioChoices& choices) {
  const auto path = [](const fs::path& file) { return fs::absolute(file).string(); };
  const auto map = choices.map_file ? std::optional(path(*choices.map_file)) : std::nullopt;
  const auto number = [](const auto& value) { return value ? fmt::to_string(*value) : "null"; };
  return fmt::format(
      "scenario: {}\nprofile: {}\nengine: {}\npriorities: {}\nsubgraph: {}\npolicy: {}\nmap: "
      "{}\ncars: {}\n"
      "seed: {}\nroutes: {}\nsteps: {}\n",
      text_of(path(choices.file)), text_of(choices.profile), text_of(choices.engine),
      text_of(choices.priorities), text_of(choices.subgraph), text_of(choices.policy), text_of(map),
      number(choices.cars), number(choices.seed), text_of(choices.routes), number(choices.steps));
}

scenario::ScenarioChoices kept_choices(const fs::path& run_folder) {
  const fs::path file = flags_file(run_folder);
  if (!fs::exists(file)) {
    throw std::invalid_argument(file.string() + ": missing; --scenario must be given");
  }
  const Node flags = Node::read_yaml(file);
  scenario::ScenarioChoices choices;
  choices.file = kept_file(run_folder, flags, "scenario");
  choices.profile = flags.required<std::string>("profile");
  choices.engine = text_or_null(flags, "engine");
  choices.priorities = text_or_null(flags, "priorities");
  if (choices.priorities == kRuleInPython) {
    throw std::invalid_argument(
        fmt::format("{}: a run whose priorities are a rule in Python, which only Python can drive; "
                    "must be a run with a rule that has a name",
                    run_folder.string()));
  }
  choices.subgraph = text_or_null(flags, "subgraph");
  choices.policy = text_or_null(flags, "policy");
  if (flags.is_value("map")) choices.map_file = kept_file(run_folder, flags, "map");
  if (flags.is_value("cars")) choices.cars = flags.required<std::size_t>("cars");
  if (flags.is_value("seed")) choices.seed = flags.required<std::size_t>("seed");
  choices.routes = text_or_null(flags, "routes");
  return choices;
}

fs::path forks_file(const fs::path& run_folder) {
  return run_folder / "configuration" / "forks.yaml";
}

std::vector<KeptFork> kept_forks(const fs::path& run_folder) {
  std::vector<KeptFork> forks;
  if (!fs::exists(forks_file(run_folder))) return forks;
  const Node file = Node::read_yaml(forks_file(run_folder));
  for (const Node& one : file.list("forks")) {
    KeptFork& fork = forks.emplace_back();
    fork.from = one.required<std::size_t>("from");
    for (const Node& text : one.list("set")) fork.set.push_back(text.as<std::string>());
    one.check_no_unknown_keys();
  }
  file.check_no_unknown_keys();
  return forks;
}

std::string forks_text(std::span<const KeptFork> forks) {
  std::vector<std::string> texts;
  for (const KeptFork& fork : forks) {
    texts.push_back(fmt::format(
        "from step {} on {}", fork.from,
        fork.set.empty() ? "nothing changed" : fmt::format("{}", fmt::join(fork.set, ", "))));
  }
  return texts.empty() ? "" : fmt::format("a fork: {}", fmt::join(texts, "; "));
}

void add_obstacles(std::span<const KeptFork> forks, result::RunDescription& description) {
  constexpr std::string_view kKey = "obstacle=";
  for (const KeptFork& fork : forks) {
    for (const std::string& text : fork.set) {
      if (!text.starts_with(kKey)) continue;
      std::istringstream numbers(text.substr(kKey.size()));
      Pose middle;
      Footprint size;
      char comma{};
      numbers >> middle.x_m >> comma >> middle.y_m >> comma >> size.length_m >> comma >>
          size.width_m;
      if (!numbers) continue;  // not written by a fork
      if (!(numbers >> comma >> middle.heading_rad)) middle.heading_rad = 0.0;
      description.obstacles.push_back(
          {.name = {}, .from = fork.from, .area_m = footprint_area(size, middle)});
    }
  }
}

bool takes_out(std::span<const KeptFork> forks, std::uint8_t vehicle) {
  const std::string change = fmt::format("without={}", vehicle);
  return std::ranges::any_of(
      forks, [&](const KeptFork& fork) { return std::ranges::count(fork.set, change) > 0; });
}

void omit_changed_routes(std::span<const KeptFork> forks, result::RunDescription& description) {
  for (result::VehicleDescription& vehicle : description.vehicles) {
    const std::string change = fmt::format("route={}:", vehicle.id.value);
    const auto changes_it = [&](const KeptFork& fork) {
      return std::ranges::any_of(fork.set,
                                 [&](const std::string& text) { return text.starts_with(change); });
    };
    if (std::ranges::any_of(forks, changes_it)) vehicle.route.reset();
  }
}

std::string forks_yaml(const std::vector<KeptFork>& forks) {
  std::string yaml = "forks:\n";
  for (const KeptFork& fork : forks) {
    std::vector<std::string> texts;
    for (const std::string& text : fork.set) texts.push_back(quoted_yaml(text));
    yaml += fmt::format("  - from: {}\n    set: [{}]\n", fork.from, fmt::join(texts, ", "));
  }
  return yaml;
}

RunChoices choices_of_run(const fs::path& run_folder, const RunChoices& given) {
  if (!fs::exists(flags_file(run_folder)) && !given.scenario.file.empty()) {
    RunChoices choices = given;
    if (choices.scenario.profile.empty())
      choices.scenario.profile = scenario::ScenarioChoices{}.profile;
    return choices;
  }
  RunChoices choices{.scenario = kept_choices(run_folder), .noise_seed = given.noise_seed};
  check_same(run_folder, given.scenario, choices.scenario);
  const Node flags = Node::read_yaml(flags_file(run_folder));
  if (!flags.has("noise_seed")) return choices;
  choices.noise_seed.reset();
  if (flags.is_value("noise_seed")) {
    choices.noise_seed = flags.required<std::size_t>("noise_seed");
  }
  Comparison(run_folder).check("--noise_seed", given.noise_seed, choices.noise_seed);
  return choices;
}

}  // namespace hlc::record

#include "planner/automaton/automaton_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "planner/automaton/maneuver_check.hpp"
#include "planner/automaton/subgraph_yaml.hpp"
#include "planner/automaton/vehicle_yaml.hpp"
#include "planner/common/node.hpp"
#include "planner/common/sha256.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::automaton {
namespace {

// --- writing ------------------------------------------------------------------------------------

constexpr const char* kHashKey = "sha256: ";

std::string row(std::initializer_list<double> values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(shortest_text(value));
  return fmt::format("{}", fmt::join(texts, " "));
}

std::string row(const vehicle::Input& u) {
  return row({u.acceleration_mps2, u.steering_rate_radps});
}
std::string row(const vehicle::State& x) {
  return row({x.pose.x_m, x.pose.y_m, x.pose.heading_rad, x.speed_mps, x.steering_rad});
}
std::string row(const Point& p) { return row({p.x(), p.y()}); }

/// A literal block: one row per line.
template <class Rows>
void append_table(std::string& text, const char* key, const Rows& rows) {
  text += fmt::format("    {}: |\n", key);
  for (const auto& one : rows) text += fmt::format("      {}\n", row(one));
}

std::string map_of(const std::vector<CriterionValue>& values) {
  std::vector<std::string> texts;
  for (const CriterionValue& value : values) {
    texts.push_back(value.name + ": " + shortest_text(value.value));
  }
  return fmt::format("{{{}}}", fmt::join(texts, ", "));
}

void append_maneuver(std::string& text, const Maneuver& m) {
  text += fmt::format("  - from: {}\n    to: {}\n    label: {}\n", m.from.index + 1, m.to.index + 1,
                      quoted_yaml(m.label));
  text += fmt::format("    displacement: [{}, {}, {}]\n    criteria: {}\n",
                      shortest_text(m.displacement.x_m), shortest_text(m.displacement.y_m),
                      shortest_text(m.displacement.heading_rad), map_of(m.criteria));
  append_table(text, "inputs", m.inputs);
  append_table(text, "states", m.states);
  append_table(text, "swept_area_m", m.swept_area_m.vertices_m);
  append_table(text, "lane_area_m", m.lane_area_m.vertices_m);
}

/// Everything except the line with the hash, which comes second.
std::string text_without_hash(const AutomatonFile& file) {
  const UniversalAutomaton& automaton = *file.automaton;
  std::string text = fmt::format("automaton_schema: {}\n", kAutomatonSchema);
  text +=
      "# Built by build_automaton. Not to be edited: change the configuration and build again.\n";
  text +=
      "# Rows of inputs: u_v [m/s^2], u_delta [rad/s]; of states: x, y [m], psi [rad], v [m/s],\n";
  text += "# delta [rad]; of areas: x, y [m]. In the frame of the start pose.\n";
  text += fmt::format(
      "configuration: {{file: {}, sha256: {}{}, horizon_steps: {}}}\n",
      quoted_yaml(file.configuration_file), file.configuration_sha256,
      file.chosen_intervals ? fmt::format(", intervals: {}", *file.chosen_intervals) : "",
      file.horizon_steps);
  text += fmt::format("vehicle: {}\nlimits: {}\nstep_s: {}\nlabels:",
                      to_yaml(automaton.vehicle, automaton.identified), to_yaml(automaton.limits),
                      shortest_text(automaton.step_s));
  for (const std::string& label : file.labels) text += fmt::format("\n  - {}", quoted_yaml(label));
  text += "\ntrims:\n";
  for (std::size_t i = 0; i < automaton.trims.size(); ++i) {
    const Trim& trim = automaton.trims[i];
    text += fmt::format("  - {{speed_mps: {}, steering_rad: {}, unit_costs: {}}}\n",
                        shortest_text(trim.speed_mps), shortest_text(trim.steering_rad),
                        map_of(automaton.unit_costs[i]));
  }
  text += "subgraphs:\n";
  for (const SubgraphSpec& subgraph : file.subgraphs) text += "  - " + to_yaml(subgraph) + "\n";
  text += "maneuvers:\n";
  for (const Maneuver& maneuver : automaton.maneuvers) append_maneuver(text, maneuver);
  return text;
}

// --- reading ------------------------------------------------------------------------------------

/// The hash of the text without its second line.
std::string hash_of_rest(const std::string& text) {
  const std::size_t first = std::min(text.find('\n'), text.size() - 1) + 1;
  const std::size_t second = std::min(text.find('\n', first), text.size() - 1) + 1;
  Sha256 hash;
  hash.add(std::string_view(text).substr(0, first));
  hash.add(std::string_view(text).substr(second));
  return hash.hex();
}

/// Rows of `columns` finite numbers.
std::vector<std::vector<double>> read_table(const Node& entry, const std::string& key,
                                            std::size_t columns) {
  const auto text = entry.required<std::string>(key);
  std::vector<std::vector<double>> rows;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    std::vector<double> numbers;
    while (at != end && *at != '\n') {
      if (*at == ' ') {
        ++at;
        continue;
      }
      double number = 0.0;
      const auto [next, error] = std::from_chars(at, end, number);
      if (error != std::errc{} || !std::isfinite(number)) entry.fail(key, "a table of numbers");
      numbers.push_back(number);
      at = next;
    }
    if (at != end) ++at;
    if (numbers.size() != columns) {
      entry.fail(key, fmt::format("a table of {} columns", columns));
    }
    rows.push_back(std::move(numbers));
  }
  return rows;
}

ConvexPolygon read_area(const Node& entry, const std::string& key) {
  ConvexPolygon area;
  for (const auto& r : read_table(entry, key, 2)) area.vertices_m.emplace_back(r[0], r[1]);
  return area;
}

std::vector<CriterionValue> read_values(const Node& entry, const std::string& key) {
  const Node map = entry.map(key);
  std::vector<CriterionValue> values;
  for (const std::string& name : map.keys()) values.push_back({name, map.required<double>(name)});
  return values;
}

Maneuver read_maneuver(const Node& entry, const UniversalAutomaton& automaton,
                       const std::vector<std::string>& labels) {
  const Allowed trims = between(1.0, static_cast<double>(automaton.trims.size()));
  Maneuver m;
  m.from = {entry.required<std::size_t>("from", trims) - 1};
  m.to = {entry.required<std::size_t>("to", trims) - 1};
  std::vector<std::string> allowed = labels;
  if (m.from == m.to) allowed.push_back(kSelfLoopLabel);
  m.label = entry.required<std::string>("label", one_of(allowed));
  m.duration_s = automaton.step_s;
  const auto end = entry.list("displacement", 3, "x, y and heading");
  m.displacement = {end[0].as<double>(), end[1].as<double>(), end[2].as<double>()};
  m.criteria = read_values(entry, "criteria");
  for (const auto& r : read_table(entry, "inputs", 2)) m.inputs.push_back({r[0], r[1]});
  for (const auto& r : read_table(entry, "states", 5)) {
    m.states.push_back({{r[0], r[1], r[2]}, r[3], r[4]});
  }
  m.swept_area_m = read_area(entry, "swept_area_m");
  m.lane_area_m = read_area(entry, "lane_area_m");
  entry.check_no_unknown_keys();
  const std::string fault = validate(m, automaton);
  if (!fault.empty()) {
    entry.fail("label", fmt::format("a maneuver that its vehicle can drive: {} -> {}: {}",
                                    m.from.index + 1, m.to.index + 1, fault));
  }
  return m;
}

void read_trims(const Node& node, UniversalAutomaton& automaton) {
  for (const Node& entry : node.list("trims")) {
    automaton.trims.push_back(read_trim(entry, automaton.vehicle, automaton.limits));
    automaton.unit_costs.push_back(read_values(entry, "unit_costs"));
    entry.check_no_unknown_keys();
  }
}

void check_subgraphs(const Node& node, const AutomatonFile& file) {
  for (std::size_t i = 0; i < file.automaton->trims.size(); ++i) {
    if (file.automaton->find({i}, {i}, kSelfLoopLabel) == nullptr) {
      node.fail("maneuvers",
                fmt::format("a list with the self-loop of every trim; that of trim {} is missing",
                            i + 1));
    }
  }
  for (const SubgraphSpec& spec : file.subgraphs) {
    try {
      check_driving(Subgraph(file.automaton, spec), file.horizon_steps);
    } catch (const std::invalid_argument& error) {
      node.fail("subgraphs", std::string("possible with the maneuvers: ") + error.what());
    }
  }
}

/// The path as a shell word, quoted if necessary.
std::string shell_word(const std::filesystem::path& path) {
  const std::string text = path.string();
  const bool is_plain = text.find_first_not_of(
                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                            "0123456789_-+./:@%,") == std::string::npos;
  if (is_plain && !text.empty()) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// Checked before anything else is read: another version may have other keys.
void check_version(const Node& node, const std::filesystem::path& path) {
  if (!node.has("automaton_schema")) {
    throw std::invalid_argument(path.string() +
                                ":1: no built automaton, must be a file of build_automaton");
  }
  if (node.required<std::size_t>("automaton_schema") == kAutomatonSchema) return;
  node.fail("automaton_schema",
            fmt::format("{}; rebuild the file from its configuration: build_automaton "
                        "CONFIG.yaml --out {}",
                        kAutomatonSchema, shell_word(path)));
}

void check_hash(const Node& node, const std::string& text, const std::string& command) {
  if (node.required<std::string>("sha256") == hash_of_rest(text)) return;
  node.fail("sha256",
            "the hash of the file's other lines: it was edited or damaged; rebuild it: " + command);
}

}  // namespace

std::string to_text(const AutomatonFile& file) {
  std::string text = text_without_hash(file);
  const std::size_t second_line = text.find('\n') + 1;
  return text.insert(second_line, kHashKey + sha256_of(text) + "\n");
}

void write_automaton_file(const AutomatonFile& file, const std::filesystem::path& path) {
  write_file(path, to_text(file));
}

bool is_automaton_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  // The first bytes are sufficient: large files are read once.
  constexpr std::string_view kBegin = "automaton_schema:";
  std::string begin(kBegin.size(), '\0');
  std::ifstream(path, std::ios::binary)
      .read(begin.data(), static_cast<std::streamsize>(kBegin.size()));
  return begin == kBegin;
}

AutomatonFile read_automaton_file(const std::filesystem::path& path) {
  const std::string text = read_regular_file(path, "an automaton file");
  const Node node = Node::parse_yaml(text, path.string());
  check_version(node, path);
  AutomatonFile file;
  const Node configuration = node.map("configuration");
  file.configuration_file = configuration.required<std::string>("file");
  file.configuration_sha256 = configuration.required<std::string>("sha256");
  if (configuration.has("intervals")) {
    file.chosen_intervals = configuration.required<std::size_t>("intervals", at_least(1.0));
  }
  file.horizon_steps = configuration.required<std::size_t>("horizon_steps", at_least(1.0));
  configuration.check_no_unknown_keys();
  check_hash(node, text, rebuild_command(file, path, path.parent_path() / file.configuration_file));

  auto automaton = std::make_shared<UniversalAutomaton>();
  const Node vehicle = node.map("vehicle");
  automaton->vehicle = read_vehicle(vehicle);
  automaton->limits = read_limits(node.map("limits"));
  automaton->identified = read_identified(vehicle, automaton->vehicle, automaton->limits);
  vehicle.check_no_unknown_keys();
  automaton->step_s = node.required<double>("step_s", above(0.0));
  for (const Node& label : node.list("labels")) {
    file.labels.push_back(label.as<std::string>());
  }
  read_trims(node, *automaton);
  for (const Node& entry : node.list("maneuvers")) {
    automaton->maneuvers.push_back(read_maneuver(entry, *automaton, file.labels));
  }
  file.subgraphs = read_subgraphs(node, {automaton->trims, automaton->vehicle, automaton->limits,
                                         automaton->step_s, file.horizon_steps, file.labels});
  node.check_no_unknown_keys();
  file.automaton = std::move(automaton);
  check_subgraphs(node, file);
  return file;
}

std::string rebuild_command(const AutomatonFile& file, const std::filesystem::path& path,
                            const std::filesystem::path& configuration_path) {
  return fmt::format(
      "build_automaton {} --out {}{}", shell_word(configuration_path), shell_word(path),
      file.chosen_intervals ? fmt::format(" --intervals {}", *file.chosen_intervals) : "");
}

}  // namespace hlc::automaton

#include "vehicle_sim/closed_loop/fork.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/controller/coordination_rules.hpp"

namespace hlc::closed_loop {
namespace {

constexpr std::uint64_t kMostLostSteps = 100'000;
/// Far beyond any map [m], and any turn [rad].
constexpr double kLargestObstacle = 1000.0;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

template <class Number>
std::optional<Number> number_in(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && rest == end ? std::optional(number) : std::nullopt;
}

/// Reads the text of one change.
class ChangeText {
 public:
  ChangeText(const std::string& text, const scenario::Scenario& scenario)
      : text_(text), scenario_(scenario) {
    const std::size_t at = text.find('=');
    key_ = text.substr(0, at);
    if (at != std::string::npos) value_ = text.substr(at + 1);
  }

  [[nodiscard]] Fork::Change read() const {
    if (key_ == "priorities") return priorities();
    if (key_ == "coordination") return coordination();
    if (key_ == "criteria") return labels();
    if (key_ == "speed") return max_speed();
    if (key_ == "without") return Fork::Without{vehicle(value_)};
    if (key_ == "lost") return lost();
    if (key_ == "obstacle") return obstacle();
    if (key_ == "route") return route();
    refuse("priorities=, coordination=, criteria=, speed=, without=, lost=, obstacle= or route=");
  }

 private:
  [[noreturn]] void refuse(const std::string& allowed) const {
    throw std::invalid_argument(
        fmt::format("--set: '{}', must be {}", one_line(text_, 80), allowed));
  }

  [[nodiscard]] VehicleId vehicle(const std::string& text) const {
    const auto id = number_in<std::uint8_t>(text);
    const auto has_id = [&](const scenario::ScenarioVehicle& one) { return one.id.value == *id; };
    const bool is_canonical = id && std::to_string(*id) == text;  // not "03"
    if (is_canonical && std::ranges::any_of(scenario_.vehicles, has_id)) return {*id};
    std::vector<int> ids;
    for (const scenario::ScenarioVehicle& one : scenario_.vehicles) ids.push_back(one.id.value);
    refuse(fmt::format("of vehicles of the run: {}", fmt::join(ids, ", ")));
  }

  /// The parts of the value before and after a letter.
  [[nodiscard]] std::pair<std::string, std::string> halves(char at,
                                                           const std::string& allowed) const {
    const std::size_t place = value_.find(at);
    if (place == std::string::npos) refuse(allowed);
    return {value_.substr(0, place), value_.substr(place + 1)};
  }

  [[nodiscard]] Fork::Priorities priorities() const {
    Fork::Priorities result;
    for (const std::string& id : split(value_, ',')) {
      result.first.push_back(vehicle(id));
      if (std::ranges::count(result.first, result.first.back()) > 1) {
        refuse("an order in which no vehicle stands twice");
      }
    }
    return result;
  }

  [[nodiscard]] Fork::Coordination coordination() const {
    const auto found = controller::coordination_rules().find(value_);
    if (found != controller::coordination_rules().end()) return {found->second};
    refuse("coordination=cooperative, strict or agreed");
  }

  [[nodiscard]] Fork::Labels labels() const {
    const auto [id, labels] = halves(':', "criteria=VEHICLE:CRITERION, several joined by +");
    Fork::Labels result{.vehicle = vehicle(id), .labels = split(labels, '+')};
    if (std::ranges::count(result.labels, "") > 0) refuse("criteria=VEHICLE:CRITERION+CRITERION");
    return result;
  }

  [[nodiscard]] Fork::MaxSpeed max_speed() const {
    const std::string allowed = "speed=VEHICLE:SPEED with a speed above 0 in m/s";
    const auto [id, speed] = halves(':', allowed);
    const auto mps = number_in<double>(speed);
    if (!mps || !(*mps > 0.0) || *mps > 100.0) refuse(allowed);
    return {.vehicle = vehicle(id), .max_speed_mps = *mps};
  }

  [[nodiscard]] Fork::Lost lost() const {
    const auto [from, rest] = halves('>', "lost=VEHICLE>VEHICLE or lost=VEHICLE>VEHICLE:STEPS");
    const std::vector<std::string> to_and_steps = split(rest, ':');
    Fork::Lost result{.from = vehicle(from), .to = vehicle(to_and_steps.front())};
    if (result.from == result.to) refuse("of two vehicles");
    if (to_and_steps.size() == 1) return result;
    const auto steps = number_in<std::uint64_t>(to_and_steps[1]);
    if (to_and_steps.size() > 2 || !steps || *steps == 0 || *steps > kMostLostSteps) {
      refuse(fmt::format("lost for 1 ... {} steps", kMostLostSteps));
    }
    result.steps = *steps;
    return result;
  }

  [[nodiscard]] Fork::Obstacle obstacle() const {
    const std::vector<std::string> texts = split(value_, ',');
    if (texts.size() != 4 && texts.size() != 5) {
      refuse("obstacle=X,Y,LENGTH,WIDTH or obstacle=X,Y,LENGTH,WIDTH,HEADING in m and rad");
    }
    std::vector<double> numbers;
    for (const std::string& text : texts) {
      numbers.push_back(number_in<double>(text).value_or(kNoNumber));
      if (std::abs(numbers.back()) <= kLargestObstacle) continue;  // not so if it is no number
      refuse(fmt::format("an obstacle with numbers of at most {}", kLargestObstacle));
    }
    if (numbers[2] <= 0.0 || numbers[3] <= 0.0) refuse("an obstacle with length and width above 0");
    return {.pose = {numbers[0], numbers[1], texts.size() == 5 ? numbers[4] : 0.0},
            .length_m = numbers[2],
            .width_m = numbers[3]};
  }

  [[nodiscard]] Fork::Route route() const {
    const auto [id, name] = halves(':', "route=VEHICLE:ROUTE");
    Fork::Route result{.vehicle = vehicle(id), .name = name};
    std::vector<std::string> names;
    for (const road::DrivableRoute& one : scenario_.routes) names.push_back(one.name);
    if (std::ranges::count(names, name) > 0) return result;
    refuse(fmt::format("a route of the scenario: {}", fmt::join(names, ", ")));
  }

  const std::string& text_;
  const scenario::Scenario& scenario_;
  std::string key_;
  std::string value_;
};

/// The vehicle that a change is for.
std::optional<VehicleId> vehicle_of(const Fork::Change& change) {
  if (const auto* const one = std::get_if<Fork::Labels>(&change)) return one->vehicle;
  if (const auto* const one = std::get_if<Fork::MaxSpeed>(&change)) return one->vehicle;
  if (const auto* const one = std::get_if<Fork::Without>(&change)) return one->vehicle;
  if (const auto* const one = std::get_if<Fork::Route>(&change)) return one->vehicle;
  return std::nullopt;
}

void check_is_there(const Fork::Change& change, const std::set<VehicleId>& gone) {
  const std::optional<VehicleId> vehicle = vehicle_of(change);
  if (!vehicle || !gone.contains(*vehicle)) return;
  throw std::invalid_argument(
      fmt::format("--set: vehicle {}, must be one that is still there", vehicle->value));
}

void check_coordination(const Fork::Change& change, const scenario::Scenario& scenario) {
  const auto* const one = std::get_if<Fork::Coordination>(&change);
  if (one == nullptr || !one->rule.commit.needs_votes) return;
  if (scenario.rounds == controller::Rounds::kTwo) {
    throw std::invalid_argument(
        "--set: coordination=agreed, must be cooperative or strict in a run of two rounds");
  }
  if (scenario.profile.strategies.priorities.max_levels != 0) {
    throw std::invalid_argument(
        "--set: coordination=agreed, must be cooperative or strict with max_levels");
  }
}

void check_without(const Fork& fork, std::size_t num_gone, std::size_t num_vehicles) {
  if (fork.from == 0) {
    throw std::invalid_argument(
        "--from_step = 0, must be at least 1 with --set without=: a scenario without the vehicle "
        "is "
        "another one");
  }
  if (num_gone == num_vehicles) {
    throw std::invalid_argument("--set: without=, must leave at least one vehicle");
  }
}

}  // namespace

Fork::Change change_from_text(const std::string& text, const scenario::Scenario& scenario) {
  return ChangeText(text, scenario).read();
}

void check_forks(const std::vector<Fork>& forks, const scenario::Scenario& scenario,
                 std::uint64_t steps) {
  std::vector<Fork> in_order = forks;
  std::ranges::stable_sort(in_order, {}, &Fork::from);
  std::set<VehicleId> gone;
  for (const Fork& fork : in_order) {
    if (fork.from >= steps) {
      throw std::invalid_argument(
          fmt::format("--from_step = {}, must be less than the run's {} steps", fork.from, steps));
    }
    for (const Fork::Change& change : fork.changes) {
      check_is_there(change, gone);
      check_coordination(change, scenario);
      const auto* const without = std::get_if<Fork::Without>(&change);
      if (without == nullptr) continue;
      gone.insert(without->vehicle);
      check_without(fork, gone.size(), scenario.vehicles.size());
    }
  }
}

}  // namespace hlc::closed_loop

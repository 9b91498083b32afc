#include "planner/road/planning_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <initializer_list>
#include <set>
#include <utility>

#include "planner/common/text_file.hpp"
#include "planner/road/commonroad_shapes.hpp"

namespace hlc::road {
namespace {

using tinyxml2::XMLElement;

class ProblemReader {
 public:
  ProblemReader(std::string_view xml, const std::string& name)
      : file_(xml, name), step_s_(read_step_s()) {}

  [[nodiscard]] std::vector<PlanningProblem> read() const {
    std::vector<PlanningProblem> problems;
    std::set<int> ids;
    CommonRoadDocument::for_each_child(
        file_.root(), "planningProblem", [&](const XMLElement& element) {
          problems.push_back(read_problem(element));
          if (!ids.insert(problems.back().id).second) {
            file_.fail(element, fmt::format("<planningProblem> id {} is taken already, must be "
                                            "unique",
                                            problems.back().id));
          }
        });
    if (problems.empty()) file_.fail(file_.root(), "no <planningProblem>, at least one is needed");
    return problems;
  }

 private:
  [[nodiscard]] double read_step_s() const {
    const std::string_view text = file_.attribute(file_.root(), "timeStepSize");
    double step_s = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), step_s);
    if (error != std::errc{} || end != text.data() + text.size() || !(step_s > 0.0) ||
        !(step_s <= kLongestStep_s)) {
      file_.fail(file_.root(), fmt::format("timeStepSize is {}, must be > 0 and <= {} [s]",
                                           CommonRoadDocument::quoted(text), kLongestStep_s));
    }
    return step_s;
  }

  /// Every child has one of the names, each of which but `repeated` is there at most once.
  void check_children(const XMLElement& element, std::initializer_list<const char*> names,
                      std::string_view repeated = {}) const {
    std::set<std::string_view> found;
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (std::ranges::find(names, name) == names.end()) {
        file_.fail(*child, fmt::format("<{}> in <{}> is not regarded, must be absent; allowed: {}",
                                       name, element.Name(), fmt::join(names, ", ")));
      }
      if (!found.insert(name).second && name != repeated) {
        file_.fail(*child, fmt::format("<{}> twice in <{}>, must be once", name, element.Name()));
      }
    }
  }

  [[nodiscard]] double exact(const XMLElement& state, const char* name, const char* unit) const {
    const XMLElement& element = file_.child(state, name);
    check_children(element, {"exact"});
    return file_.number(element, "exact", unit);
  }

  [[nodiscard]] double exact_or_0(const XMLElement& state, const char* name,
                                  const char* unit) const {
    return state.FirstChildElement(name) == nullptr ? 0.0 : exact(state, name, unit);
  }

  [[nodiscard]] Interval interval(const XMLElement& state, const char* name,
                                  const char* unit) const {
    const XMLElement& element = file_.child(state, name);
    if (element.FirstChildElement("exact") != nullptr) {
      const double value = exact(state, name, unit);
      return {value, value};
    }
    check_children(element, {"intervalStart", "intervalEnd"});
    const Interval read{file_.number(element, "intervalStart", unit),
                        file_.number(element, "intervalEnd", unit)};
    if (read.from > read.to) {
      file_.fail(element, fmt::format("<{}> is from {} to {}, must be from the smaller number",
                                      name, read.from, read.to));
    }
    return read;
  }

  [[nodiscard]] std::optional<Interval> interval_if(const XMLElement& state, const char* name,
                                                    const char* unit) const {
    if (state.FirstChildElement(name) == nullptr) return std::nullopt;
    return interval(state, name, unit);
  }

  void read_regions(const XMLElement& position, GoalState& goal) const {
    for (const XMLElement* one = position.FirstChildElement(); one != nullptr;
         one = one->NextSiblingElement()) {
      if (std::strcmp(one->Name(), "lanelet") == 0) {
        goal.lanelets.push_back(file_.id_attribute(*one, "ref"));
      } else {
        goal.areas_m.push_back(region_of(file_, *one));
      }
    }
    if (goal.areas_m.empty() && goal.lanelets.empty()) {
      file_.fail(position,
                 "<position> is empty, must have a <rectangle>, <circle>, <polygon> or "
                 "<lanelet>");
    }
  }

  [[nodiscard]] GoalState read_goal(const XMLElement& state) const {
    check_children(state, {"position", "time", "velocity", "orientation"});
    const Interval steps = interval(state, "time", "time steps");
    GoalState goal{.areas_m = {},
                   .lanelets = {},
                   .time_s = {steps.from * step_s_, steps.to * step_s_},
                   .speed_mps = interval_if(state, "velocity", "m/s"),
                   .heading_rad = interval_if(state, "orientation", "rad")};
    read_regions(file_.child(state, "position"), goal);
    return goal;
  }

  [[nodiscard]] PlanningProblem read_problem(const XMLElement& element) const {
    check_children(element, {"initialState", "goalState"}, "goalState");
    const XMLElement& state = file_.child(element, "initialState");
    check_children(state, {"position", "orientation", "time", "velocity", "yawRate", "slipAngle",
                           "acceleration"});
    if (const double time = exact(state, "time", "time steps"); time != 0.0) {
      file_.fail(state, fmt::format("<time> of <initialState> is {}, must be 0", time));
    }
    PlanningProblem problem{.id = file_.id_attribute(element, "id"),
                            .start = pose_of(file_, state),
                            .speed_mps = exact(state, "velocity", "m/s"),
                            .yaw_rate_radps = exact_or_0(state, "yawRate", "rad/s"),
                            .slip_angle_rad = exact_or_0(state, "slipAngle", "rad"),
                            .acceleration_mps2 = exact_or_0(state, "acceleration", "m/s^2"),
                            .goals = {}};
    CommonRoadDocument::for_each_child(element, "goalState", [&](const XMLElement& goal) {
      problem.goals.push_back(read_goal(goal));
    });
    if (problem.goals.empty()) file_.fail(element, "<planningProblem> needs a <goalState>");
    return problem;
  }

  static constexpr double kLongestStep_s = 100.0;

  CommonRoadDocument file_;
  double step_s_;
};

}  // namespace

std::vector<PlanningProblem> parse_planning_problems(std::string_view xml,
                                                     const std::string& name) {
  return ProblemReader(xml, name).read();
}

std::vector<PlanningProblem> read_planning_problems(const std::filesystem::path& file) {
  return parse_planning_problems(read_file(file, kMostInputBytes), file.string());
}

}  // namespace hlc::road

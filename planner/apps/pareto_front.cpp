// The Pareto front of the maneuvers between two trims, as a table and as a plot in the style of the
// paper's Fig. 1:
//
//     pareto_front launch_scripts/automata/pareto_example.yaml --from 0 0 --to 2.3 0.62
//         --points 31 --out front.csv --plot front.svg
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/pareto_table.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/plot/drawing.hpp"
#include "planner/plot/pareto_data.hpp"

namespace {

struct Flags {
  std::string configuration;
  std::vector<double> from;
  std::vector<double> to;
  std::vector<std::string> criteria{"J1", "J2"};
  std::size_t points{31};
  double duration_s{};                  ///< 0: the configuration's
  std::vector<double> free_duration_s;  ///< empty: the duration is fixed
  std::size_t intervals{};              ///< 0: the configuration's
  std::string spacing{"front"};
  hlc::apps::OutputFile table{"--out", {}};
  hlc::apps::OutputFile plot{"--plot", {}};
};

constexpr double kShortest_s = 1e-3;
constexpr double kLongest_s = 100.0;

void declare(CLI::App& app, Flags& flags) {
  app.add_option("CONFIGURATION", flags.configuration, "automaton configuration (YAML)")
      ->required()
      ->type_name("FILE");
  app.add_option("--from", flags.from, "speed [m/s] and steering [rad] at the start")
      ->expected(2)
      ->check(hlc::apps::finite())
      ->required();
  app.add_option("--to", flags.to, "speed [m/s] and steering [rad] at the end")
      ->expected(2)
      ->check(hlc::apps::finite())
      ->required();
  app.add_option("--points", flags.points, "number of points of the front")
      ->check(hlc::apps::whole(2, 1000))
      ->capture_default_str();
  CLI::Option* const duration =
      app.add_option("--duration_s", flags.duration_s,
                     "of every maneuver [s], instead of the configuration's step_s")
          ->check(hlc::apps::within(kShortest_s, kLongest_s));
  app.add_option(
         "--free_duration_s", flags.free_duration_s,
         "MIN MAX [s]: each maneuver has its own best duration within these bounds, for "
         "criteria such as travel_time; the table has a column `duration` then; default: as "
         "--duration_s")
      ->expected(2)
      ->check(hlc::apps::within(kShortest_s, kLongest_s))
      ->excludes(duration);
  app.add_option("--intervals", flags.intervals,
                 "intervals of constant input, instead of the configuration's")
      ->check(hlc::apps::whole(2, 1000));
  app.add_option("--criteria", flags.criteria,
                 "two criteria; the first is minimised, the second "
                 "bounded")
      ->expected(2)
      ->check(hlc::apps::among(hlc::maneuver_design::criterion_names()))
      ->capture_default_str();
  app.add_option("--spacing", flags.spacing,
                 "front: equal distances along it; second: equal steps of the second criterion")
      ->check(hlc::apps::among({"front", "second"}))
      ->capture_default_str();
  hlc::apps::declare_output(app, flags.table, "table to write (CSV)")->required();
  hlc::apps::declare_output(app, flags.plot, "plot to write (SVG, PDF)");
  hlc::apps::declare_help_end(
      app,
      {.examples =
           {"pareto_front launch_scripts/automata/paper.yaml --from 0 0 --to 0.7 0 --out front.csv",
            "pareto_front launch_scripts/automata/paper.yaml --from 0.7 0 --to 0 0 --criteria J1 "
            "energy --points 60 --out front.csv --plot front.svg"},
       .exit_codes = "0 success, 1 a point was not found, 2 invalid input or an output that cannot "
                     "be written, 3 all but the drawing, 130 interrupted"});
}

std::string printed(const std::vector<double>& numbers) {
  return hlc::shortest_text(numbers[0]) + " " + hlc::shortest_text(numbers[1]);
}

void check_trim(const char* flag, const std::vector<double>& trim,
                const hlc::vehicle::VehicleLimits& limits) {
  if (trim[0] >= limits.speed_min_mps && trim[0] <= limits.speed_max_mps &&
      std::abs(trim[1]) <= limits.steering_max_rad) {
    return;
  }
  const std::string steering = hlc::shortest_text(limits.steering_max_rad);
  throw std::invalid_argument(std::string(flag) + " = " + printed(trim) + ", must be in " +
                              hlc::shortest_text(limits.speed_min_mps) + " ... " +
                              hlc::shortest_text(limits.speed_max_mps) + " m/s and -" + steering +
                              " ... " + steering + " rad");
}

/// Durations are free within the bounds; the search starts at the duration nearest to step_s.
void free_duration(const std::vector<double>& bounds_s,
                   hlc::maneuver_design::ManeuverProblem& problem) {
  if (bounds_s[0] > bounds_s[1]) {
    throw std::invalid_argument("--free_duration_s = " + printed(bounds_s) +
                                ", must be MIN <= MAX");
  }
  problem.free_duration = {bounds_s[0], bounds_s[1]};
  problem.duration_s = std::clamp(problem.duration_s, bounds_s[0], bounds_s[1]);
}

hlc::maneuver_design::ParetoProblem problem_of(const Flags& flags) {
  if (flags.criteria[0] == flags.criteria[1]) {
    throw std::invalid_argument("--criteria = " + flags.criteria[0] + " " + flags.criteria[1] +
                                ", must be two different ones");
  }
  const hlc::maneuver_design::AutomatonConfiguration c =
      hlc::maneuver_design::read_automaton_configuration(flags.configuration);
  check_trim("--from", flags.from, c.limits);
  check_trim("--to", flags.to, c.limits);
  hlc::maneuver_design::ParetoProblem problem;
  problem.maneuver = hlc::maneuver_design::problem_between({flags.from[0], flags.from[1]},
                                                           {flags.to[0], flags.to[1]}, c);
  if (flags.duration_s > 0.0) problem.maneuver.duration_s = flags.duration_s;
  if (!flags.free_duration_s.empty()) free_duration(flags.free_duration_s, problem.maneuver);
  if (flags.intervals > 0) problem.maneuver.intervals = flags.intervals;
  for (const std::string& name : flags.criteria) {
    problem.criteria.push_back(hlc::maneuver_design::make_criterion(name, c.vehicle));
  }
  return problem;
}

/// Dominated share of the rectangle between the ends.
double dominated_share(const hlc::maneuver_design::ParetoFront& front,
                       const hlc::maneuver_design::ObjectiveRange& range) {
  const double area = (range.worst - range.best).prod();
  return area > 0.0 ? hlc::maneuver_design::hypervolume(front.objectives(), range.worst) / area
                    : 0.0;
}

void print(const char* name, const hlc::maneuver_design::ParetoPoint& point) {
  std::printf("%-18s %14.6g %14.6g\n", name, point.objectives(0), point.objectives(1));
}

void print_summary(const Flags& flags, const hlc::maneuver_design::ParetoFront& front,
                   const hlc::maneuver_design::ParetoFront& weighted_sums) {
  std::printf("%-18s %14s %14s\n", "", flags.criteria[0].c_str(), flags.criteria[1].c_str());
  print(("optimum of " + flags.criteria[1]).c_str(), front.points.front());
  print("knee", front.points[hlc::maneuver_design::knee_point(front.objectives())]);
  print(("optimum of " + flags.criteria[0]).c_str(), front.points.back());
  if (front.points.size() == 1) {
    std::printf("the front is one point: here the criteria do not contradict each other\n");
    return;
  }
  const hlc::maneuver_design::ObjectiveRange range =
      hlc::maneuver_design::range_of(front.objectives());
  std::printf("hypervolume %.4f, of weighted sums %.4f (share of the rectangle between the ends)\n",
              dominated_share(front, range), dominated_share(weighted_sums, range));
  if (weighted_sums.status != hlc::maneuver_design::ManeuverStatus::kOptimal) {
    std::printf("not all weighted sums were found: %s\n", weighted_sums.reason.c_str());
  }
}

int run(const Flags& flags) {
  const hlc::maneuver_design::ParetoProblem problem = problem_of(flags);
  hlc::apps::check_output_files({flags.table, flags.plot}, {flags.configuration});
  hlc::maneuver_design::ParetoOptions options;
  options.points = flags.points;
  options.spacing = flags.spacing == "front" ? hlc::maneuver_design::Spacing::kAlongFront
                                             : hlc::maneuver_design::Spacing::kSecondCriterion;
  const hlc::apps::Interruption interruption(
      "pareto_front", "nothing is written yet: the same command begins from the start");
  std::optional<hlc::apps::ProgressLine> progress;
  options.progress = [&progress](std::size_t done, std::size_t at_most) {
    if (!progress) progress.emplace("maneuver", at_most);
    if (done > 0) progress->show(done);
  };
  const hlc::maneuver_design::ParetoFront front =
      hlc::maneuver_design::epsilon_constraint_front(problem, options);
  progress.reset();
  const hlc::maneuver_design::ParetoFront weighted_sums =
      hlc::maneuver_design::weighted_sum_front(problem, options);
  progress.reset();
  if (front.status == hlc::maneuver_design::ManeuverStatus::kInfeasible) {
    throw std::invalid_argument(flags.configuration + ": " + front.reason);
  }
  if (front.status != hlc::maneuver_design::ManeuverStatus::kOptimal) {
    throw std::runtime_error(flags.configuration + ": " + front.reason);
  }
  const hlc::plot::ParetoDescription description{problem.maneuver.from, problem.maneuver.to,
                                                 problem.maneuver.duration_s, flags.criteria,
                                                 problem.maneuver.free_duration};
  hlc::write_file(*flags.table.file, hlc::apps::pareto_table(front, description));
  print_summary(flags, front, weighted_sums);
  const auto& plot = flags.plot.file;
  if (!plot) return 0;
  return hlc::plot::draw("pareto", hlc::plot::pareto_data(front, weighted_sums, description),
                         *plot);
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Pareto front of the maneuvers between two trims, as a table and a plot.", "pareto_front"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(
          app, argc, argv,
          {{"--duration", "--duration_s"}, {"--free_duration", "--free_duration_s"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("pareto_front", [&flags] { return run(flags); });
}

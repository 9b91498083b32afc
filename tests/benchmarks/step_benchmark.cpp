// How long one step of all cars takes within one process, planning and coordination, and how it
// grows with their number.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "hlc_bridge/result/statistics.hpp"
#include "hlc_bridge/time/thread_clock.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/common/text_file.hpp"
#include "planner/plot/svg_plot.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

struct Sample {
  std::size_t draws{3};
  std::size_t repeats{5};
};

/// Processor time of each step of a rollout [ms].
std::vector<double> rollout_ms(const hlc::scenario::Scenario& scenario) {
  hlc::rollout::Rollout rollout = hlc::rollout::make_rollout(scenario);
  std::vector<double> times_ms;
  for (std::size_t i = 0; i < scenario.steps; ++i) {
    const hlc::Nanoseconds from = hlc::time::thread_time_now();
    static_cast<void>(rollout.step());
    times_ms.push_back(1e-6 * static_cast<double>(hlc::time::thread_time_now() - from));
  }
  return times_ms;
}

/// Of the steps of all draws. Every repeat computes the same, and other processes can only add to
/// its time: of each step the least counts.
std::vector<double> step_times_ms(hlc::scenario::ScenarioChoices choices, const Sample& sample) {
  std::vector<double> all_ms;
  for (std::size_t draw = 1; draw <= sample.draws; ++draw) {
    choices.seed = draw;
    const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(choices);
    std::vector<double> least_ms = rollout_ms(scenario);
    for (std::size_t i = 1; i < sample.repeats; ++i) {
      std::ranges::transform(least_ms, rollout_ms(scenario), least_ms.begin(),
                             [](double a, double b) { return std::min(a, b); });
    }
    all_ms.insert(all_ms.end(), least_ms.begin(), least_ms.end());
  }
  return all_ms;
}

void run(const hlc::scenario::ScenarioChoices& choices, const std::vector<std::size_t>& numbers,
         const Sample& sample, const hlc::apps::OutputFile& plot) {
  hlc::apps::check_output_files({plot}, {choices.file});
  hlc::plot::PlotPanel panel{.title = "A step of all cars in one process",
                             .x_label = "cars",
                             .y_label = "processor time of a step [ms]",
                             .legend_corner = hlc::plot::Corner::kTopLeft};
  for (std::size_t i = 0; i < 2; ++i) {
    panel.lines.push_back({.points = {}, .colour = hlc::plot::series_colour(i)});
    panel.legend.push_back(
        {.text = i == 0 ? "mean" : "p99", .colour = hlc::plot::series_colour(i), .radius_px = 0.0});
  }
  std::printf(
      "| cars | mean [ms] | p99 [ms] | max [ms] | mean per car [ms] |\n|---|---|---|---|---|\n");
  for (const std::size_t cars : numbers) {
    hlc::scenario::ScenarioChoices chosen = choices;
    chosen.cars = cars;
    const auto times = hlc::result::statistics(step_times_ms(chosen, sample)).value();
    const auto number = static_cast<double>(cars);
    std::printf("| %zu | %.2f | %.2f | %.2f | %.3f |\n", cars, times.mean, times.p99, times.max,
                times.mean / number);
    std::fflush(stdout);
    panel.lines[0].points.emplace_back(number, times.mean);
    panel.lines[1].points.emplace_back(number, times.p99);
  }
  if (plot.file) hlc::write_file(*plot.file, hlc::plot::svg_of("", {panel}, 1));
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Times a step of all cars within this process, for several numbers of cars.",
      "step_benchmark"};
  hlc::scenario::ScenarioChoices choices;
  std::vector<std::size_t> numbers{1, 2, 5, 10, 15, 20, 25, 30, 40, 50};
  Sample sample;
  hlc::apps::OutputFile plot{"--plot", {}};
  app.add_option("--cars", numbers, "numbers of cars")
      ->delimiter(',')
      ->check(hlc::apps::whole(1, hlc::kMaxVehicleId))
      ->capture_default_str();
  app.add_option("--steps", choices.steps, "instead of the scenario's")
      ->check(hlc::apps::whole(1, 100000));
  app.add_option("--draws", sample.draws, "of the cars, with seeds 1, 2, ...")
      ->check(hlc::apps::whole(1, 1000))
      ->capture_default_str();
  app.add_option("--repeats", sample.repeats, "how often; of each step the least time counts")
      ->check(hlc::apps::whole(1, 1000))
      ->capture_default_str();
  hlc::apps::declare_scenario(app, "--scenario", choices.file, ", which draws its cars")
      ->run_callback_for_default()
      ->default_val("lab_cars");
  hlc::apps::declare_output(app, plot, "draw the growth (SVG)");
  hlc::apps::declare_help_end(
      app, {.examples = {"step_benchmark",
                         "step_benchmark --cars 10,20,40 --repeats 5 --plot growth.svg"}});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("step_benchmark", [&] { run(choices, numbers, sample, plot); });
}

#include "tests/benchmarks/search_report.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>

namespace hlc::test {
namespace {

EngineReport report_on(const EngineRun& run) {
  EngineReport report{.name = run.engine};
  std::vector<double> times_us;
  const auto count = static_cast<double>(run.solved.size());
  for (const Solved& one : run.solved) {
    times_us.push_back(one.time_us);
    report.mean_us += one.time_us / count;
    report.generated += static_cast<double>(one.generated);
    report.expanded += static_cast<double>(one.expanded);
  }
  // Sums first: an engine that always makes as many vertices has exactly that number as its mean.
  report.generated /= count;
  report.expanded /= count;
  report.per_vertex_ns = 1e3 * report.mean_us / report.generated;
  report.p50_us = percentile(times_us, 0.5);
  report.p99_us = percentile(times_us, 0.99);
  report.max_us = percentile(std::move(times_us), 1.0);
  return report;
}

nlohmann::json or_null(const auto& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json to_json(const EngineReport& engine) {
  return {{"name", engine.name},
          {"mean_us", engine.mean_us},
          {"p50_us", engine.p50_us},
          {"p99_us", engine.p99_us},
          {"max_us", engine.max_us},
          {"generated", engine.generated},
          {"expanded", engine.expanded},
          {"ratio_mean", or_null(engine.ratio_mean)},
          {"ratio_p99", or_null(engine.ratio_p99)},
          {"ratio_max", or_null(engine.ratio_max)},
          {"optimal", or_null(engine.optimal)}};
}

template <class... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

double percentile(std::vector<double> values, double share) {
  assert(!values.empty() && share > 0.0 && share <= 1.0);
  std::ranges::sort(values);
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[rank - 1];
}

bool agrees_with(const Solved& reference, const Solved& solved) {
  if (reference.stopped_early || solved.stopped_early || reference.has_plan != solved.has_plan)
    return false;
  return !reference.has_plan ||
         std::abs(solved.cost - reference.cost) <= 1e-9 * (1.0 + std::abs(reference.cost));
}

SetReport report_on(const std::string& set, const std::vector<EngineRun>& runs,
                    const EngineRun* reference) {
  SetReport report{.name = set, .problems = runs.front().solved.size()};
  for (const EngineRun& run : runs) {
    EngineReport& engine = report.engines.emplace_back(report_on(run));
    if (reference == nullptr) continue;
    const EngineReport of_reference = report_on(*reference);
    engine.ratio_mean = of_reference.mean_us / engine.mean_us;
    engine.ratio_p99 = of_reference.p99_us / engine.p99_us;
    engine.ratio_max = of_reference.max_us / engine.max_us;
    engine.optimal = std::ranges::equal(reference->solved, run.solved, agrees_with);
  }
  return report;
}

void print(const SetReport& report, std::ostream& out) {
  out << report.name << ", " << report.problems << " problems\n"
      << line("%-26s %10s %10s %10s %10s %11s %11s %10s %8s %8s %8s %8s\n", "", "mean [us]", "p50",
              "p99", "max", "generated", "expanded", "ns/vertex", "x mean", "x p99", "x max",
              "optimal");
  for (const EngineReport& engine : report.engines) {
    out << line("%-26s %10.2f %10.2f %10.2f %10.2f %11.1f %11.1f %10.1f", engine.name.c_str(),
                engine.mean_us, engine.p50_us, engine.p99_us, engine.max_us, engine.generated,
                engine.expanded, engine.per_vertex_ns);
    if (engine.optimal) {
      out << line(" %8.2f %8.2f %8.2f %8s", *engine.ratio_mean, *engine.ratio_p99,
                  *engine.ratio_max, *engine.optimal ? "yes" : "NO");
    }
    out << '\n';
  }
  out << '\n';
}

void print_legend(std::ostream& out) {
  out << "p50, p99, max: time per problem (nearest rank); generated, expanded: vertices per "
         "problem, "
         "mean\n"
         "ns/vertex: mean time / generated vertices\n"
         "x mean, x p99, x max: times faster than plain: its mean, p99, max / this row's\n"
         "optimal: every plan costs what that of plain does\n";
}

nlohmann::json to_json(const std::vector<SetReport>& reports) {
  nlohmann::json sets = nlohmann::json::array();
  for (const SetReport& report : reports) {
    nlohmann::json engines = nlohmann::json::array();
    for (const EngineReport& engine : report.engines) engines.push_back(to_json(engine));
    sets.push_back({{"name", report.name}, {"problems", report.problems}, {"engines", engines}});
  }
  return {{"sets", sets}};
}

}  // namespace hlc::test

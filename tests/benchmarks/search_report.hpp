#pragma once

#include <cstddef>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hlc::test {

/// One problem solved by one engine.
struct Solved {
  double time_us{};
  bool has_plan{};
  bool stopped_early{};  ///< neither a best plan nor a proof that there is none
  double cost{};         ///< [m^2]; only with a plan
  std::size_t generated{};
  std::size_t expanded{};
};

/// All problems of a set solved by one engine, in their order.
struct EngineRun {
  std::string engine;
  std::vector<Solved> solved;
};

/// Results of one engine on one set. Ratios are its speed-up over the
/// reference: reference's value / this engine's.
struct EngineReport {
  std::string name;
  double mean_us{};
  double p50_us{};
  double p99_us{};
  double max_us{};
  double generated{};  ///< mean per problem
  double expanded{};   ///< mean per problem
  double per_vertex_ns{};
  /// Without a reference: nothing.
  std::optional<double> ratio_mean;
  std::optional<double> ratio_p99;
  std::optional<double> ratio_max;
  std::optional<bool> optimal;  ///< agrees_with the reference on every problem
};

struct SetReport {
  std::string name;
  std::size_t problems{};
  std::vector<EngineReport> engines;
};

/// The smallest of the values that at least the share `share` of all does not exceed (nearest
/// rank). @pre values is not empty, 0 < share <= 1
[[nodiscard]] double percentile(std::vector<double> values, double share);

/// True if neither stopped early and both have no plan, or both one and
/// | cost - cost' | <= 1e-9 (1 + | cost' |).
[[nodiscard]] bool agrees_with(const Solved& reference, const Solved& solved);

/// @param reference  nullptr: none was run
/// @pre every run has as many problems, at least one
[[nodiscard]] SetReport report_on(const std::string& set, const std::vector<EngineRun>& runs,
                                  const EngineRun* reference);

/// A table, one line per engine.
void print(const SetReport& report, std::ostream& out);
/// What the columns of those tables are.
void print_legend(std::ostream& out);

/// {sets: [{name, problems, engines: [{name, mean_us, p50_us, p99_us, max_us, generated, expanded,
/// ratio_mean, ratio_p99, ratio_max, optimal}]}]}; null for what there is not without a reference.
[[nodiscard]] nlohmann::json to_json(const std::vector<SetReport>& reports);

}  // namespace hlc::test

// How much more the plans of several vehicles cost that plan one after the other than those that
// are planned jointly: on problems drawn on a scenario's roads, for several rules of ordering.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "planner/apps/fitted_table.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/common/csv.hpp"
#include "planner/common/text_file.hpp"
#include "planner/joint_search/conflict_based_search.hpp"
#include "planner/joint_search/prioritized.hpp"
#include "planner/rollout/joint_draws.hpp"
#include "planner/scenario/joint_problem_file.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/search_options.hpp"

namespace {

using hlc::joint_search::JointPlan;
using hlc::joint_search::JointProblem;
using hlc::joint_search::JointSearchResult;

constexpr double kSameCost = 1e-6;
/// The budget of a single vehicle's search: large, so that its result is its optimum.
constexpr std::size_t kVehicleExpansions = 1'000'000;

struct Flags {
  hlc::scenario::ScenarioChoices scenario;
  std::size_t cars{2};
  std::size_t problems{100};
  std::uint64_t seed{1};
  std::size_t max_expansions{5'000'000};
  std::vector<std::size_t> budgets{1'000, 10'000};
  hlc::apps::OutputFile rows{"--table", {}};
  std::optional<std::filesystem::path> dump;
};

/// A way to plan for all; empty: no plan.
struct Rule {
  std::string name;
  std::function<JointPlan(const JointProblem&, const JointPlan& alone)> plan;
};

/// A rule's costs in relation to the joint optimum.
struct Tally {
  std::vector<double> ratios;
  std::size_t without_plan{};
};

struct Totals {
  std::size_t infeasible{};
  std::size_t unknown{};   ///< not proven, and no plan
  std::size_t unproven{};  ///< a plan, not proven to be the optimum
  std::vector<double> ratios_alone;
  std::vector<double> seconds;
};

void declare(CLI::App& app, Flags& flags) {
  hlc::apps::declare_scenario(app, "SCENARIO,--scenario", flags.scenario.file,
                              ", on whose routes the cars are drawn")
      ->required();
  app.add_option("--cars", flags.cars, "number of cars in each problem")
      ->check(hlc::apps::whole(2, 4))
      ->capture_default_str();
  app.add_option("--problems", flags.problems, "number of problems with a conflict")
      ->check(hlc::apps::whole(1, 100'000))
      ->capture_default_str();
  app.add_option("--seed", flags.seed, "of the draw")
      ->check(hlc::apps::whole(0, hlc::scenario::kMaxSeed))
      ->capture_default_str();
  app.add_option("--max_expansions", flags.max_expansions,
                 "most expansions of the search for the joint optimum, in each problem")
      ->check(hlc::apps::whole(1, hlc::search::SearchOptions::kMostExpansions))
      ->capture_default_str();
  app.add_option("--budgets", flags.budgets,
                 "rules that start from the best order and search jointly for so many "
                 "expansions: N,N,...; default: none")
      ->delimiter(',')
      ->check(hlc::apps::whole(1, hlc::search::SearchOptions::kMostExpansions));
  hlc::apps::declare_profile_flag(app, flags.scenario.profile);
  app.add_option("--subgraph", flags.scenario.subgraph, "instead of the scenario's");
  hlc::apps::declare_output(app, flags.rows,
                            "write a row per problem and rule (CSV): problem, rule, cost [m^2], "
                            "optimum [m^2], is_proven");
  app.add_option("--dump_problems", flags.dump,
                 "a new or an empty folder: write each problem to a file there (plan_problem "
                 "solves it)")
      ->type_name("DIR");
  hlc::apps::declare_help_end(
      app, {.examples = {"price_of_priority paper_three_cars --cars 3",
                         "price_of_priority lab_cars --problems 200 --table prices.csv "
                         "--dump_problems problems"},
            .exit_codes =
                "0 success, 2 invalid input or an output that cannot be written, 130 interrupted"});
}

std::vector<Rule> rules_of(const Flags& flags) {
  namespace joint = hlc::joint_search;
  std::vector<Rule> rules{
      {"constant",
       [](const JointProblem& problem, const JointPlan& /*alone*/) {
         return joint::plan_in_order(problem, joint::constant_order(problem.size()));
       }},
      {"most collisions first",
       [](const JointProblem& problem, const JointPlan& alone) {
         return joint::plan_in_order(problem, joint::most_collisions_first(problem, alone));
       }},
      {"best of all orders", [](const JointProblem& problem, const JointPlan& /*alone*/) {
         return joint::plan_in_best_order(problem);
       }}};
  for (const std::size_t budget : flags.budgets) {
    rules.push_back({fmt::format("and {} joint expansions", budget),
                     [budget](const JointProblem& problem, const JointPlan& /*alone*/) {
                       return joint::search_jointly(problem, {.max_expansions = budget},
                                                    joint::plan_in_best_order(problem))
                           .plans;
                     }});
  }
  return rules;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Half the width of the mean's 95 % interval, from the values' standard deviation.
double half_width(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto n = static_cast<double>(values.size());
  return n < 2.0 ? 0.0 : 1.96 * std::sqrt(squares / (n - 1.0) / n);
}

std::string mean_text(const std::vector<double>& values) {
  if (values.empty()) return "-";
  return fmt::format("{:.3f} +- {:.3f}", mean_of(values), half_width(values));
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::string table_of(const std::vector<Rule>& rules, const std::vector<Tally>& tallies) {
  std::string table =
      fmt::format("{:<26} {:>12} {:>9} {:>18} {:>8} {:>8}\n", "", "", "", "cost / optimum", "", "");
  table += fmt::format("{:<26} {:>12} {:>9} {:>18} {:>8} {:>8}\n", "rule", "without plan",
                       "optimal", "mean", "p90", "max");
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const auto& [ratios, without_plan] = tallies[i];
    const std::size_t all = ratios.size() + without_plan;
    const auto optimal =
        std::ranges::count_if(ratios, [](double ratio) { return ratio <= 1.0 + kSameCost; });
    const bool has_any = !ratios.empty();
    table += fmt::format(
        "{:<26} {:>12} {:>8.1f}% {:>18} {:>8} {:>8}\n", rules[i].name, without_plan,
        100.0 * static_cast<double>(optimal) / static_cast<double>(std::max<std::size_t>(all, 1)),
        mean_text(ratios), has_any ? fmt::format("{:.3f}", quantile(ratios, 0.9)) : "-",
        has_any ? fmt::format("{:.3f}", quantile(ratios, 1.0)) : "-");
  }
  return table;
}

std::string text_of(const Totals& totals) {
  std::string text = fmt::format(
      "\n{} problems: {} without any joint plan, {} of which neither a plan nor a proof was found, "
      "{} whose best plan is not proven to be the optimum; the table counts the other {}.\n",
      totals.seconds.size(), totals.infeasible, totals.unknown, totals.unproven,
      totals.ratios_alone.size());
  text += fmt::format("sum of the optima without each other / joint optimum: {}\n",
                      mean_text(totals.ratios_alone));
  text += fmt::format("search for the joint optimum: median {:.4f} s, p90 {:.3f} s, max {:.2f} s\n",
                      quantile(totals.seconds, 0.5), quantile(totals.seconds, 0.9),
                      quantile(totals.seconds, 1.0));
  return text;
}

void check_dump(const std::optional<std::filesystem::path>& folder) {
  if (!folder) return;
  std::error_code error;
  std::filesystem::create_directory(*folder, error);
  if (!std::filesystem::is_directory(*folder) || !std::filesystem::is_empty(*folder)) {
    throw std::invalid_argument(
        fmt::format("--dump_problems = {}, must be a new or an empty folder", folder->string()));
  }
}

void dump(const Flags& flags, const hlc::scenario::Scenario& scenario,
          const hlc::rollout::JointDraws& draws, const JointProblem& problem, std::size_t number) {
  if (!flags.dump) return;
  hlc::scenario::JointProblemFile file{
      .automaton_file = std::filesystem::absolute(scenario.automaton_file),
      .subgraph = draws.on().subgraph,
      .search = scenario.search};
  file.search.max_expansions = kVehicleExpansions;
  for (const auto& vehicle : problem) file.problems.push_back(vehicle.problem);
  hlc::scenario::write_joint_problem_file(file,
                                          *flags.dump / fmt::format("problem_{:04}.json", number));
}

/// Counts the problem. False: there is no proven optimum to compare with.
bool count(const JointSearchResult& optimum, const JointPlan& alone, Totals& totals) {
  const bool is_proven = optimum.status == hlc::search::SearchStatus::kOptimal;
  if (is_proven) {
    totals.ratios_alone.push_back(hlc::joint_search::cost_of(alone) / optimum.cost);
  } else if (!optimum.plans.empty()) {
    ++totals.unproven;
  } else if (optimum.reason == hlc::search::NoPath::kBudget) {
    ++totals.unknown;
  } else {
    ++totals.infeasible;
  }
  return is_proven;
}

std::optional<double> cost_if_any(const JointPlan& plans) {
  if (plans.empty()) return std::nullopt;
  return hlc::joint_search::cost_of(plans);
}

/// Solves problems jointly and by each rule.
class Comparison {
 public:
  explicit Comparison(const Flags& flags)
      : max_expansions_(flags.max_expansions), rules_(rules_of(flags)), tallies_(rules_.size()) {}

  void add(std::size_t number, const JointProblem& problem) {
    const JointPlan alone = hlc::joint_search::plan_alone(problem);
    const auto begin = Clock::now();
    const JointSearchResult optimum =
        hlc::joint_search::search_jointly(problem, {.max_expansions = max_expansions_},
                                          hlc::joint_search::plan_in_best_order(problem));
    totals_.seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    const bool is_proven = count(optimum, alone, totals_);
    for (std::size_t i = 0; i < rules_.size(); ++i) {
      const std::optional<double> cost_m2 = cost_if_any(rules_[i].plan(problem, alone));
      rows_ += hlc::CsvLine(number, rules_[i].name, cost_m2, cost_if_any(optimum.plans), is_proven)
                   .text();
      if (!is_proven) continue;
      if (cost_m2) {
        tallies_[i].ratios.push_back(*cost_m2 / optimum.cost);
      } else {
        ++tallies_[i].without_plan;
      }
    }
  }

  [[nodiscard]] std::string result() const { return table_of(rules_, tallies_) + text_of(totals_); }
  [[nodiscard]] const std::string& rows() const { return rows_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::size_t max_expansions_;
  std::vector<Rule> rules_;
  std::vector<Tally> tallies_;
  Totals totals_;
  std::string rows_{"problem,rule,cost_m2,optimum_m2,is_proven\n"};
};

int run(const Flags& flags) {
  hlc::apps::check_output_files({flags.rows}, {flags.scenario.file});
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(flags.scenario);
  check_dump(flags.dump);
  hlc::search::SearchOptions search = scenario.search;
  if (!hlc::search::is_admissible(search.cost_to_go)) {
    throw std::invalid_argument(fmt::format(
        "--profile = {}, must be one with an admissible cost-to-go: its plans have no bound",
        flags.scenario.profile));
  }
  search.max_expansions = kVehicleExpansions;
  hlc::rollout::JointDraws draws(scenario, search, flags.seed);
  Comparison comparison(flags);
  const hlc::apps::Interruption interruption(
      "price_of_priority",
      "no table is written yet: the same command begins from the start, --problems shortens it");
  const hlc::apps::ProgressLine progress("problem", flags.problems);
  for (std::size_t number = 1; number <= flags.problems; ++number) {
    const std::optional<JointProblem> problem = draws.draw(flags.cars);
    if (!problem) {
      throw std::invalid_argument(fmt::format(
          "{}: no {} cars conflict in {} draws, must be a scenario whose routes meet",
          flags.scenario.file.string(), flags.cars, hlc::rollout::JointDraws::kMostDraws));
    }
    dump(flags, scenario, draws, *problem, number);
    comparison.add(number, *problem);
    progress.show(number);
  }
  const std::string heading =
      fmt::format("{}: {} cars, horizon {}, subgraph {} of {} trims, seed {}\n\n", scenario.name,
                  flags.cars, scenario.horizon_steps, scenario.subgraph->spec().name,
                  scenario.subgraph->spec().trims.size(), flags.seed);
  fmt::print("{}", hlc::apps::fitted_table(heading + comparison.result()));
  if (flags.rows.file) hlc::write_file(*flags.rows.file, comparison.rows());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Measures what prioritised planning costs: draws planning problems of several cars in "
      "conflict, plans one after the other by several rules, and compares with the joint optimum.",
      "price_of_priority"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(
          app, argc, argv, {{"--dump", "--dump_problems"}, {"--rows", "--table"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("price_of_priority", [&flags] { return run(flags); });
}

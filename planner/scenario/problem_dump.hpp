#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "planner/automaton/automaton_file.hpp"
#include "planner/controller/controller.hpp"

namespace hlc::scenario {

/// Writes the planning problems of a controller, one file each (problem_file.hpp), so that every
/// planning step can be replayed alone.
///
/// Files are named vehicle_<id>_step_<k>_search_<i>.json: k the step, with ten digits, i counts the
/// searches of that step from 1 (there is a second one if the first plan would drift into
/// something). Steps without a search write nothing. Replays of a step's files have together the
/// vertices counted in the step's report. The problems by which a standing vehicle determines where
/// it may drive off to, without other vehicles (lane_entry.hpp), are in
/// vehicle_<id>_step_<k>_lane_entry_<i>.json; their vertices are not counted.
///
/// A problem needs another automaton file than the scenario's if its subgraph was requested on the
/// way, or if the plan in force still has maneuvers of a subgraph before it. That file is
/// automaton_<hash of its text>.yaml in the same folder: several dumps may write there.
class ProblemDump {
 public:
  /// Makes the folder if necessary.
  /// @param automaton_file  for the files; written as absolute path
  /// @param declared        the subgraph of that file which the scenario names
  /// @throws std::invalid_argument if the folder cannot be made or is not writable
  ProblemDump(std::filesystem::path folder, const std::filesystem::path& automaton_file,
              automaton::SubgraphSpec declared);

  /// The problems of the controller's last step. Reads the controller only.
  /// @throws std::runtime_error naming the file if it cannot be written; std::invalid_argument if
  /// the scenario's automaton file can no longer be read when another one is to be written
  void write(const controller::Controller& controller);

 private:
  using Foreign = std::vector<const automaton::Maneuver*>;

  /// The automaton file for a problem: the scenario's, or one written here.
  [[nodiscard]] std::filesystem::path automaton_file_for(
      const controller::SearchedProblem& searched);
  [[nodiscard]] std::filesystem::path write_automaton(const automaton::Subgraph& subgraph,
                                                      const Foreign& foreign);

  std::filesystem::path folder_;
  std::filesystem::path automaton_file_;
  automaton::SubgraphSpec declared_;
  std::optional<automaton::AutomatonFile> origin_;  ///< the scenario's, once needed
  /// Those written without foreign maneuvers.
  std::vector<std::pair<std::shared_ptr<const automaton::Subgraph>, std::filesystem::path>>
      written_;
};

}  // namespace hlc::scenario

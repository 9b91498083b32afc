#pragma once

#include <filesystem>

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
class ProblemDump {
 public:
  /// Makes the folder if necessary.
  /// @param automaton_file  for the files; written as absolute path
  /// @param declared        the subgraph of that file which is planned on
  /// @throws std::invalid_argument if the folder cannot be made or is not writable
  ProblemDump(std::filesystem::path folder, const std::filesystem::path& automaton_file,
              automaton::SubgraphSpec declared);

  /// The problems of the controller's last step. Reads the controller only.
  /// @throws std::runtime_error naming the file if it cannot be written, or the subgraph if another
  /// one was requested meanwhile: a problem can only name one that the automaton's file declares
  void write(const controller::Controller& controller) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path automaton_file_;
  automaton::SubgraphSpec declared_;
};

}  // namespace hlc::scenario

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vehicle_sim/closed_loop/fault_run.hpp"
#include "vehicle_sim/closed_loop/matrix_cell.hpp"
#include "vehicle_sim/closed_loop/run_diary.hpp"

namespace hlc::closed_loop {

struct MatrixRun {
  std::string culprit;        ///< name of the process
  std::vector<Fault> faults;  ///< of the culprit, all with the same begin
  FaultRunResult result;
  RunDiary diary;
};

/// Runs of the paper's three cars, from random starts, each with the fault of one cell. Until the
/// fault a run is the undisturbed one of its setup and seed, from which the phases are known.
class FaultMatrix {
 public:
  /// @param scenario_folder  holds paper_three_cars
  /// @throws std::invalid_argument, std::runtime_error if the scenario cannot be read
  explicit FaultMatrix(const std::filesystem::path& scenario_folder);

  /// Without a fault: no culprit.
  [[nodiscard]] MatrixRun undisturbed(const MatrixSetup& setup, std::uint64_t seed) const;
  /// @param before  the undisturbed run of the same setup and seed
  /// @pre the cell is run (`not_run`)
  [[nodiscard]] MatrixRun run(const MatrixCell& cell, std::uint64_t seed, const RunDiary& before,
                              const Trace& trace = {}) const;

 private:
  [[nodiscard]] FaultRunSettings settings_of(const MatrixSetup& setup, std::uint64_t seed) const;
  [[nodiscard]] scenario::Scenario scenario_of(const MatrixSetup& setup, std::uint64_t seed) const;

  scenario::Scenario scenario_;
  controller::PreparedSubgraph prepared_;
};

}  // namespace hlc::closed_loop

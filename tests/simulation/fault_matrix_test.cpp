#include "vehicle_sim/closed_loop/fault_matrix.hpp"

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>
#include <utility>

#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "vehicle_sim/closed_loop/matrix_table.hpp"

namespace hlc::closed_loop::fault_matrix_test {
namespace {

const FaultMatrix& matrix() {
  static const FaultMatrix kMatrix(test::source_folder() + "/launch_scripts/scenarios");
  return kMatrix;
}

const MatrixRun& undisturbed(const MatrixSetup& setup, std::uint64_t seed) {
  static std::map<std::pair<std::string, std::uint64_t>, MatrixRun> runs;
  const auto [found, is_new] = runs.try_emplace({to_string(setup), seed});
  if (is_new) found->second = matrix().undisturbed(setup, seed);
  return found->second;
}

MatrixVerdict verdict(const MatrixCell& cell, std::uint64_t seed) {
  const MatrixRun& before = undisturbed(cell.setup, seed);
  return verdict_of(cell, matrix().run(cell, seed, before.diary), before);
}

std::vector<MatrixCell> cells_of(Role role) {
  std::vector<MatrixCell> cells;
  for (const MatrixCell& cell : matrix_cells()) {
    if (cell.role == role && !not_run(cell)) cells.push_back(cell);
  }
  return cells;
}

class FaultMatrixOf : public testing::TestWithParam<Role> {};

TEST_P(FaultMatrixOf, EveryFaultInEveryPhaseHurtsNobodyIsNamedAndLeavesNothing) {
  const std::vector<MatrixCell> cells = cells_of(GetParam());
  for (std::size_t i = 0; i < cells.size(); i += test::kThinning) {
    CellResult result{.cell = cells[i]};
    for (std::uint64_t seed = 1; seed <= test::num_seeds(1); ++seed) {
      result.add(seed, verdict(cells[i], seed));
    }
    EXPECT_TRUE(result.failed == 0 || result.is_known) << describe_failure(result);
  }
}

INSTANTIATE_TEST_SUITE_P(Roles, FaultMatrixOf,
                         testing::Values(Role::kController, Role::kVehicle, Role::kMiddleware,
                                         Role::kLabControl),
                         [](const auto& tested) {
                           std::string name = to_string(tested.param);
                           std::erase(name, ' ');
                           return name;
                         });

TEST(FaultMatrixCells, MoreThan300AreRunAndOfEachOtherOneThereIsAReason) {
  const std::vector<MatrixCell> all = matrix_cells();
  EXPECT_EQ(all.size(), 4U * 9U * 3U * 6U);
  std::size_t run = 0;
  for (const MatrixCell& cell : all) {
    const std::optional<NotRun> reason = not_run(cell);
    if (!reason) ++run;
    EXPECT_TRUE(!reason || !reason->text.empty()) << to_string(cell);
  }
  EXPECT_GE(run, 300U);
}

TEST(FaultMatrixCells, NothingIsViolatedWithoutAFault) {
  for (const MatrixSetup& setup : matrix_setups()) {
    const MatrixRun& run = undisturbed(setup, 1);
    EXPECT_TRUE(run.result.violations.empty()) << to_string(setup);
    EXPECT_TRUE(run.diary.begin_of_drive && run.diary.stop) << to_string(setup);
  }
}

}  // namespace
}  // namespace hlc::closed_loop::fault_matrix_test

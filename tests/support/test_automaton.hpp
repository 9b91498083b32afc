#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/automaton/subgraph.hpp"

namespace hlc::test {

/// Label of the maneuvers of `make_test_automaton`.
inline constexpr char kTestLabel[] = "test";

/// An automaton for tests, made without an optimiser: the twelve trims of the paper's Table 1, a
/// maneuver between every two of them, and each trim's self-loop.
///
/// The steering of a maneuver ramps linearly. The speed too, if `surge_mps2` is 0 (the optimum of
/// J2). Otherwise that acceleration is added in the first half and taken away in the second, so
/// that maneuvers outrun both their trims, as those of J1 do.
///
/// The areas are hulls of footprints at some times; they need not contain the whole motion.
[[nodiscard]] std::shared_ptr<const automaton::UniversalAutomaton> make_test_automaton(
    double surge_mps2 = 0.0);

/// A label of a test automaton, and the surge of its maneuvers.
struct LabelledSurge {
  std::string label;
  double surge_mps2{};
};

inline const LabelledSurge kSlow{"slow", 0.0};
inline const LabelledSurge kFast{"fast", 8.0};
/// Of the paper, numbered from 1.
inline const std::vector<std::size_t> kAllTrims{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

/// The same with other trims and with one maneuver per label between every two of them.
[[nodiscard]] std::shared_ptr<automaton::UniversalAutomaton> make_test_automaton(
    const std::vector<automaton::Trim>& trims, const std::vector<LabelledSurge>& labels);

/// The twelve trims of the paper's Table 1.
[[nodiscard]] std::vector<automaton::Trim> paper_trims();

/// A subgraph with these trims, numbered from 1 as in the paper.
[[nodiscard]] automaton::Subgraph make_test_subgraph(
    std::shared_ptr<const automaton::UniversalAutomaton> automaton,
    const std::vector<std::size_t>& trims);

/// The same with these labels, all on.
[[nodiscard]] automaton::Subgraph make_test_subgraph(const std::vector<LabelledSurge>& labels,
                                                     const std::vector<std::size_t>& trims,
                                                     std::optional<double> max_speed_mps = {});

/// All twelve trims.
[[nodiscard]] automaton::Subgraph make_test_subgraph(double surge_mps2 = 0.0);

}  // namespace hlc::test

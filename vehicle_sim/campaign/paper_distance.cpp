#include "vehicle_sim/campaign/paper_distance.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::campaign {
namespace {

std::vector<PapersCell> compared_cells() {
  std::vector<PapersCell> cells = papers_cells();
  std::vector<PapersCell> alone;
  for (PapersCell cell : cells) {
    if (cell.scenario != kPaperSimulation || cell.subgraph != "A") continue;
    if (cell.quantity == "generated_sum_max") continue;  // of three cars
    cell.scenario = kPaperLab;
    alone.push_back(cell);
  }
  cells.insert(cells.end(), alone.begin(), alone.end());
  return cells;
}

double log_ratio(const std::optional<double>& ours, double paper) {
  const double most = std::log(kMaxCellFactor);
  if (!ours || *ours <= 0.0) return most;
  return std::clamp(std::log(*ours / paper), -most, most);
}

}  // namespace

double PaperDistance::factor() const { return std::exp(std::sqrt(mean_square)); }

std::optional<PaperDistance> paper_distance(const std::vector<RunFigures>& runs) {
  PaperDistance distance;
  for (const PapersCell& cell : compared_cells()) {
    std::size_t count = 0;
    std::size_t filled = 0;
    double sum = 0.0;
    for (const RunFigures& run : runs) {
      if (run.scenario != cell.scenario || run.subgraph != cell.subgraph) continue;
      ++count;
      const std::optional<double> value = is_well_driven(run) ? cell.of(run) : std::nullopt;
      if (!value) continue;
      ++filled;
      sum += *value;
    }
    if (count == 0) continue;
    ComparedCell compared{.paper = cell};
    if (filled == count) compared.ours = sum / static_cast<double>(count);
    compared.log_ratio = log_ratio(compared.ours, cell.value);
    distance.mean_square += compared.log_ratio * compared.log_ratio;
    distance.cells.push_back(std::move(compared));
  }
  if (distance.cells.empty()) return std::nullopt;
  distance.mean_square /= static_cast<double>(distance.cells.size());
  return distance;
}

}  // namespace hlc::campaign

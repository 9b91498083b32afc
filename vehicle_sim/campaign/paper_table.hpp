#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

/// The paper's Table 2 and the corresponding figures of our runs. Source: paper, Table 2.
namespace hlc::campaign {

inline constexpr char kPaperSimulation[] = "paper_three_cars";  ///< scenario of its simulation
inline constexpr char kPaperLab[] = "paper_red_alone";          ///< and of its lab

/// A row of the table.
struct TableQuantity {
  std::string name;  ///< with its unit
  std::string key;   ///< in comma-separated values
  int decimals;
  std::optional<double> (*of)(const RunFigures&);              ///< ours
  std::map<std::string, std::map<std::string, double>> paper;  ///< by scenario and subgraph
  bool depends_on_machine{};
};

/// In the order of the table; the paper's and additional ones.
[[nodiscard]] const std::vector<TableQuantity>& table_quantities();

/// None where the paper has none.
[[nodiscard]] std::optional<double> papers_value(const TableQuantity& quantity,
                                                 const std::string& scenario,
                                                 const std::string& subgraph);

/// A cell of the paper's Table 2 that does not depend on the machine: reference error, lap,
/// vertices.
struct PapersCell {
  std::string scenario;  ///< kPaperSimulation or kPaperLab
  std::string subgraph;
  std::string quantity;  ///< its key in the table as comma-separated values
  double value{};
  std::optional<double> (*of)(const RunFigures&){};  ///< ours
};

/// All of them, by scenario, subgraph, quantity.
[[nodiscard]] std::vector<PapersCell> papers_cells();

}  // namespace hlc::campaign

#include "vehicle_sim/campaign/tradeoff.hpp"
namespace hlc {
std::string tradeoff_markdown(const std::vector<RunFigures>&) { return ""; }
std::string tradeoff_csv(const std::vector<RunFigures>&) { return ""; }
std::string tradeoff_fronts_csv(const std::vector<RunFigures>&) { return ""; }
}  // namespace hlc

#include "tests/integration/run_reports.hpp"

#include <algorithm>

namespace hlc::test {

std::optional<coordination::Report> last_report(const std::vector<ReportRecord>& records,
                                                VehicleId vehicle) {
  std::optional<coordination::Report> last;
  for (const ReportRecord& record : records) {
    if (record.report.vehicle == vehicle && (!last || record.report.step > last->step)) {
      last = record.report;
    }
  }
  return last;
}

std::size_t planned_steps(const std::vector<ReportRecord>& records, VehicleId vehicle,
                          StepIndex first) {
  return static_cast<std::size_t>(std::ranges::count_if(records, [&](const ReportRecord& record) {
    const coordination::Report& report = record.report;
    return report.vehicle == vehicle && report.step >= first &&
           report.status == coordination::StepStatus::kPlanned;
  }));
}

bool is_among(VehicleId vehicle, const std::vector<VehicleId>& vehicles) {
  return std::ranges::find(vehicles, vehicle) != vehicles.end();
}

}  // namespace hlc::test

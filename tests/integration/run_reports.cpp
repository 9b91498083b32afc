#include "tests/integration/run_reports.hpp"

#include <algorithm>
#include <string>

#include "hlc_bridge/record/report_file.hpp"
#include "tests/support/child_process.hpp"

namespace hlc::test {

std::vector<ReportRecord> reports_so_far(const std::filesystem::path& run_folder) {
  const std::filesystem::path file = run_folder / "reports.csv";
  if (read_text(file).find('\n') == std::string::npos) return {};
  return record::read_reports(file);
}

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

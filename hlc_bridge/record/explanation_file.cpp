#include "hlc_bridge/record/explanation_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "planner/common/csv.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::record {
namespace {

constexpr std::string_view kExplanationHeading = "step,vehicle,text";
enum Column : std::size_t { kStep, kVehicle, kText };

}  // namespace

std::filesystem::path explanations_file(const std::filesystem::path& run) {
  return run / "explanations.csv";
}

std::string explanations_csv(std::span<const result::Explanation> explanations) {
  std::string csv = std::string{kExplanationHeading} + "\n";
  for (const result::Explanation& one : explanations) {
    csv += CsvLine(one.step, one.vehicle.value, one.text).text();
  }
  return csv;
}

std::vector<result::Explanation> read_explanations(const std::filesystem::path& run,
                                                   std::span<const result::StepRecord> rows) {
  if (!std::filesystem::exists(explanations_file(run))) return {};
  const CsvTable table(explanations_file(run), kExplanationHeading);
  const std::vector<result::Explanation> expected = result::steps_to_explain(rows);
  std::vector<result::Explanation> explanations;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const std::uint64_t vehicle = table.unsigned_number(row, kVehicle);
    const std::uint64_t step = table.unsigned_number(row, kStep);
    const auto is_of = [&](const result::Explanation& one) { return one.vehicle.value == vehicle; };
    if (std::ranges::none_of(expected, is_of)) {
      table.refuse(
          row, kVehicle,
          "a vehicle of the run that was hindered or braked to a stand: the file of another run?");
    }
    const auto found = std::ranges::find_if(
        expected, [&](const result::Explanation& one) { return is_of(one) && one.step == step; });
    if (found == expected.end()) {
      table.refuse(
          row, kStep,
          "one in which the vehicle begins to keep its plan, to wait or to miss others, or brakes "
          "to a stand: the file of another run?");
    }
    explanations.push_back({.step = step,
                            .last = found->last,
                            .vehicle = found->vehicle,
                            .text = table.text(row, kText)});
  }
  return explanations;
}

std::filesystem::path search_page_file(const std::filesystem::path& run, VehicleId vehicle,
                                       std::uint64_t step) {
  return run / "searches" / fmt::format("vehicle_{}_step_{}.html", vehicle.value, step);
}

std::vector<result::SearchPage> read_search_pages(const std::filesystem::path& run,
                                                  std::span<const result::StepRecord> rows) {
  std::vector<result::SearchPage> pages;
  for (const result::StepRecord& row : rows) {
    const VehicleId vehicle = row.record.report.vehicle;
    const std::filesystem::path file = search_page_file(run, vehicle, row.step);
    if (!std::filesystem::exists(file)) continue;
    pages.push_back({.step = row.step, .vehicle = vehicle, .html = read_file(file)});
  }
  return pages;
}

}  // namespace hlc::record

#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/messages/run_messages.hpp"
#include "hlc_bridge/view/page_json.hpp"

/// What controllers did in a step, in JSON with words for states, for viewers that show or plot
/// the members of a message.
namespace hlc::view {

inline constexpr const char* kReportsType = "hlc.Reports";

/// @param speed_mps  driven; nothing: not known, and no member
[[nodiscard]] Json report_json(const ReportRecord& record, std::optional<double> speed_mps);
/// An hlc.Reports.
/// @param reports  an array
[[nodiscard]] std::string reports_message(Json reports);
[[nodiscard]] std::string reports_schema();

}  // namespace hlc::view

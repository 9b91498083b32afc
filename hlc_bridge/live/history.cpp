#include "hlc_bridge/live/history.hpp"

#include <charconv>
#include <system_error>

#include "planner/common/demand.hpp"

namespace hlc::live {

void History::append(const std::string& messages) {
  HLC_DEMAND(!has_ended_, events_.size());
  events_.push_back("id: " + session_ + '-' + std::to_string(events_.size()) +
                    "\ndata: " + messages + "\n\n");
  num_bytes_ += events_.back().size();
}

std::size_t History::position_after(std::string_view event_id) const {
  const std::string before = session_ + '-';
  if (!event_id.starts_with(before)) return 0;
  event_id.remove_prefix(before.size());
  std::size_t position{};
  const char* const end = event_id.data() + event_id.size();
  const auto [parsed_until, error] = std::from_chars(event_id.data(), end, position);
  const bool is_sound = error == std::errc{} && parsed_until == end && position < events_.size();
  return is_sound ? position + 1 : 0;
}

}  // namespace hlc::live

#include "hlc_bridge/dds/drop_log.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace hlc::dds {

DropLog::DropLog(std::shared_ptr<const ParticipantCore> core, std::string topic)
    : core_{std::move(core)}, topic_{std::move(topic)} {}

void DropLog::log(const frtps::GUID_t& writer, const std::string& reason) {
  const auto& on_loss = core_->options().on_loss;
  if (!on_loss || logged_.size() >= kMostLogged || !logged_.insert(writer.guidPrefix).second)
    return;
  const std::string names = core_->with_presence([&](const Presence& presence) {
    const auto* last = presence.last_names_of(key_of(writer.guidPrefix));
    return last == nullptr ? std::string{} : fmt::format("{}", fmt::join(*last, ","));
  });
  on_loss(fmt::format("topic {}: messages of participant \"{}\" ({:02x}) dropped (logged once): {}",
                      topic_, name_in_log(names), fmt::join(writer.guidPrefix.value, ""), reason));
}

}  // namespace hlc::dds

#include "hlc_bridge/dds/sender_check.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace hlc::dds {

bool counts(const Presence& presence, const ParticipantKey& publisher, const std::string& sender,
            bool is_among_others) {
  const std::vector<std::string>* names = presence.last_names_of(publisher);
  // Another thread of the library is about to report the participant that it has matched.
  if (names == nullptr || std::ranges::count(*names, sender) > 0) return true;
  return is_among_others && !presence.alive().contains(sender);
}

SenderCheck::SenderCheck(std::shared_ptr<const ParticipantCore> core, const std::string& topic)
    : core_{std::move(core)}, log_{core_, topic} {}

bool SenderCheck::accepts(const frtps::GUID_t& writer, const std::string& sender) {
  const bool is_among_others = core_->options().transport == Transport::kLab &&
                               core_->options().role != DomainRole::kController;
  const bool is_accepted = core_->with_presence([&](const Presence& presence) {
    return counts(presence, key_of(writer.guidPrefix), sender, is_among_others);
  });
  if (!is_accepted) log_.log(writer, "only " + sender + " may publish them");
  return is_accepted;
}

}  // namespace hlc::dds

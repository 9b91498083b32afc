#include "hlc_bridge/dds/sender_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace hlc::dds {
namespace {

/// A participant may have any bytes as its name.
std::string in_log(std::string name) {
  constexpr std::size_t kLongest = 64;
  if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
  std::ranges::replace_if(
      name, [](char c) { return c < ' ' || c > '~'; }, '?');
  return name;
}

}  // namespace

bool counts(const Presence& presence, const ParticipantKey& publisher, const std::string& sender,
            bool is_among_others) {
  const std::vector<std::string>* names = presence.last_names_of(publisher);
  // Another thread of the library is about to report the participant that it has matched.
  if (names == nullptr || std::ranges::count(*names, sender) > 0) return true;
  return is_among_others && !presence.alive().contains(sender);
}

SenderCheck::SenderCheck(std::shared_ptr<const ParticipantCore> core, std::string topic)
    : core_{std::move(core)}, topic_{std::move(topic)} {}

bool SenderCheck::accepts(const frtps::GUID_t& writer, const std::string& sender) {
  const ParticipantKey publisher = key_of(writer.guidPrefix);
  const bool is_among_others = core_->options().transport == Transport::kLab &&
                               core_->options().role != DomainRole::kController;
  std::string names;
  const bool is_accepted = core_->with_presence([&](const Presence& presence) {
    if (counts(presence, publisher, sender, is_among_others)) return true;
    names = fmt::format("{}", fmt::join(*presence.last_names_of(publisher), ","));
    return false;
  });
  if (!is_accepted) log(writer, names, sender);
  return is_accepted;
}

void SenderCheck::log(const frtps::GUID_t& writer, const std::string& names,
                      const std::string& sender) {
  const auto& on_loss = core_->options().on_loss;
  if (!on_loss || logged_.size() >= kMostLogged || !logged_.insert(writer.guidPrefix).second)
    return;
  on_loss(
      fmt::format("topic {}: messages of participant \"{}\" ({:02x}) dropped (logged once): only "
                  "{} may publish them",
                  topic_, in_log(names), fmt::join(writer.guidPrefix.value, ""), sender));
}

}  // namespace hlc::dds

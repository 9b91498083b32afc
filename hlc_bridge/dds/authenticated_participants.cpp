#include "hlc_bridge/dds/authenticated_participants.hpp"

#include <algorithm>
#include <utility>

#include "hlc_bridge/dds/security.hpp"

namespace hlc::dds {
namespace {

AnnouncedParticipant by_its_identity(AnnouncedParticipant participant) {
  const auto key = key_of_identity(identity_of(participant.name));
  if (!key || !std::equal(key->begin(), key->end(), participant.key.begin())) {
    participant.name += " with another's identity";
  }
  return participant;
}

}  // namespace

std::optional<AnnouncedParticipant> AuthenticatedParticipants::announced(
    AnnouncedParticipant participant) {
  if (authenticated_.contains(participant.key)) return by_its_identity(std::move(participant));
  waiting_[participant.key] = std::move(participant);
  return std::nullopt;
}

std::optional<AnnouncedParticipant> AuthenticatedParticipants::authenticated(
    const ParticipantKey& key) {
  authenticated_.insert(key);
  const auto found = waiting_.find(key);
  if (found == waiting_.end()) return std::nullopt;
  AnnouncedParticipant participant = std::move(found->second);
  waiting_.erase(found);
  return by_its_identity(std::move(participant));
}

std::optional<std::string> AuthenticatedParticipants::refused(const ParticipantKey& key) {
  if (named_.size() >= kMostNamed || !named_.insert(key).second) return std::nullopt;
  const auto found = waiting_.find(key);
  return found == waiting_.end() ? std::string{} : found->second.name;
}

void AuthenticatedParticipants::left(const ParticipantKey& key) {
  waiting_.erase(key);
  authenticated_.erase(key);
}

}  // namespace hlc::dds

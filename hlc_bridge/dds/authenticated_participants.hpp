#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "hlc_bridge/dds/presence.hpp"

namespace hlc::dds {

/// A participant as it announces itself.
struct AnnouncedParticipant {
  ParticipantKey key{};
  std::string name;
  std::string user_data;
};

/// With DDS security: which of the announced participants are present. Announcements are readable
/// and can be forged; a participant is present once it has proven its identity, and under its name
/// only if that is the identity's. Not thread-safe.
class AuthenticatedParticipants {
 public:
  /// Returns the participant if it is present now.
  [[nodiscard]] std::optional<AnnouncedParticipant> announced(AnnouncedParticipant participant);
  [[nodiscard]] std::optional<AnnouncedParticipant> authenticated(const ParticipantKey& key);
  /// Its proof has failed, or it has none. Returns the name that it announces, empty if it has not
  /// yet, to be logged; none if it was refused before, or if kMostNamed others were.
  [[nodiscard]] std::optional<std::string> refused(const ParticipantKey& key);
  void left(const ParticipantKey& key);

  static constexpr std::size_t kMostNamed = 100;

 private:
  std::map<ParticipantKey, AnnouncedParticipant> waiting_;
  std::set<ParticipantKey> authenticated_;
  std::set<ParticipantKey> named_;  ///< who was refused
};

}  // namespace hlc::dds

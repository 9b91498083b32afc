#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace hlc::dds {

/// What identifies a participant on the wire (the first 12 bytes of a GUID).
using ParticipantKey = std::array<std::uint8_t, 12>;

/// A participant's name, which may be any bytes, for a log line: printable, its first 64
/// characters.
[[nodiscard]] std::string name_in_log(std::string name);

/// The participants on a domain. Several of them can have one name: the name is alive as long as
/// one of them is. A participant that stands for several processes (process_names) has all their
/// names. Not thread-safe.
class Presence {
 public:
  /// @param version  empty: not published
  void appeared(const ParticipantKey& key, const std::string& name,
                const std::string& version = "");
  void left(const ParticipantKey& key);

  /// Names of the present participants.
  [[nodiscard]] const std::set<std::string>& alive() const { return alive_; }
  /// Names of participants that were present, without those that are.
  [[nodiscard]] const std::set<std::string>& lost() const { return lost_; }
  /// By name, of the present participants that publish one.
  [[nodiscard]] std::map<std::string, std::string> versions() const;
  /// None if that participant is not present.
  [[nodiscard]] std::vector<std::string> names_of(const ParticipantKey& key) const;
  /// Also of a participant that has left, since its last messages may be read later; none if it
  /// never was present, or if more than kMostFormer have left since.
  [[nodiscard]] const std::vector<std::string>* last_names_of(const ParticipantKey& key) const;

  static constexpr std::size_t kMostFormer = 1000;

 private:
  std::map<ParticipantKey, std::vector<std::string>> names_;
  std::map<ParticipantKey, std::vector<std::string>> former_names_;
  std::deque<ParticipantKey> former_;  ///< of former_names_, in the order in which they left
  std::map<ParticipantKey, std::string> versions_;
  std::set<std::string> alive_;
  std::set<std::string> lost_;
};

}  // namespace hlc::dds

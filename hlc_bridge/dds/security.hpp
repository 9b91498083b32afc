#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

/// DDS security with the library's own plugins: X.509 identities, signed rights, AES-GCM.
///
/// A folder made by launch_scripts/make_security.sh holds the authority's certificate, the rules of
/// all domains (governance), and of each process a key, a certificate and its rights, in a folder
/// named after its identity.
namespace hlc::dds {

/// Of a process, by the name of its participants: the name itself; of one that serves several
/// vehicles its role, "middleware" for "middleware_1,2,3".
[[nodiscard]] std::string identity_of(const std::string& participant_name);

/// The first bytes of the GUIDs of participants with an identity. The library derives them from the
/// subject of the certificate (47 bits of SHA-256 after a 1, DDS Security 1.1, 9.3.3), and refuses
/// a participant whose certificate has another one. None if no certificate can have the subject.
using IdentityKey = std::array<std::uint8_t, 6>;
[[nodiscard]] std::optional<IdentityKey> key_of_identity(const std::string& identity);

struct SecurityFiles {
  std::filesystem::path authority;    ///< certificate of the authority
  std::filesystem::path governance;   ///< signed
  std::filesystem::path certificate;  ///< of the identity
  std::filesystem::path key;
  std::filesystem::path permissions;  ///< signed
};

/// The files of an identity, which are there and belong together: the certificate is the
/// identity's, signed by the authority and valid now, the key is the certificate's and for its
/// owner only, rules and rights are signed by the authority.
/// @throws std::invalid_argument naming --security, the file, and what it must be
[[nodiscard]] SecurityFiles security_files(const std::filesystem::path& folder,
                                           const std::string& identity);

}  // namespace hlc::dds

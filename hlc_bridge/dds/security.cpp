#include "hlc_bridge/dds/security.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509_vfy.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>

namespace hlc::dds {
namespace {

namespace fs = std::filesystem;

template <class Object>
using Owned = std::unique_ptr<Object, void (*)(Object*)>;

void free_bio(BIO* bio) { BIO_free(bio); }

[[noreturn]] void refuse_file(const fs::path& file, const std::string& what) {
  throw std::invalid_argument(fmt::format("--security: {}: {}", file.string(), what));
}

Owned<BIO> open(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) refuse_file(file, "no such file");
  Owned<BIO> bio(BIO_new_file(file.c_str(), "r"), free_bio);
  if (!bio) refuse_file(file, "cannot be read");
  return bio;
}

Owned<X509> read_certificate(const fs::path& file) {
  const Owned<BIO> bio = open(file);
  Owned<X509> certificate(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr), X509_free);
  if (!certificate) refuse_file(file, "must be a certificate (PEM)");
  return certificate;
}

/// Null: no certificate can have it.
Owned<X509_NAME> subject_of(const std::string& identity) {
  Owned<X509_NAME> name(X509_NAME_new(), X509_NAME_free);
  const auto* text = reinterpret_cast<const unsigned char*>(identity.data());
  if (X509_NAME_add_entry_by_txt(name.get(), "CN", MBSTRING_UTF8, text,
                                 static_cast<int>(identity.size()), -1, 0) != 1) {
    name.reset();
  }
  return name;
}

/// The certificates that are trusted: the authority's.
Owned<X509_STORE> trusted(const fs::path& authority) {
  const Owned<X509> certificate = read_certificate(authority);
  Owned<X509_STORE> store(X509_STORE_new(), X509_STORE_free);
  X509_STORE_add_cert(store.get(), certificate.get());
  return store;
}

void check_certificate(X509_STORE* store, X509* certificate, const fs::path& file) {
  const Owned<X509_STORE_CTX> context(X509_STORE_CTX_new(), X509_STORE_CTX_free);
  X509_STORE_CTX_init(context.get(), store, certificate, nullptr);
  if (X509_verify_cert(context.get()) == 1) return;
  refuse_file(file,
              fmt::format("{}; must be valid now and signed by the authority.pem beside it",
                          X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get()))));
}

void check_subject(X509* certificate, const std::string& identity, const fs::path& file) {
  const Owned<X509_NAME> subject = subject_of(identity);
  if (subject && X509_NAME_cmp(X509_get_subject_name(certificate), subject.get()) == 0) return;
  refuse_file(file, "the subject must be CN=" + identity);
}

void check_key(X509* certificate, const fs::path& file) {
  const Owned<BIO> bio = open(file);
  const auto others = fs::perms::group_all | fs::perms::others_all;
  if ((fs::status(file).permissions() & others) != fs::perms::none) {
    refuse_file(file, "others than its owner may read it, must be of mode 0600");
  }
  const Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(bio.get(), nullptr, nullptr, nullptr),
                            EVP_PKEY_free);
  if (!key) refuse_file(file, "must be a private key (PEM)");
  if (X509_check_private_key(certificate, key.get()) != 1) {
    refuse_file(file, "must be the key of the certificate.pem beside it");
  }
}

void check_signature(X509_STORE* store, const fs::path& file) {
  const Owned<BIO> bio = open(file);
  BIO* content = nullptr;
  const Owned<PKCS7> signature(SMIME_read_PKCS7(bio.get(), &content), PKCS7_free);
  const Owned<BIO> signed_text(content, free_bio);
  if (!signature || !signed_text ||
      PKCS7_verify(signature.get(), nullptr, store, signed_text.get(), nullptr, PKCS7_TEXT) != 1) {
    refuse_file(file, "must be signed by the authority.pem of the folder, and unchanged since");
  }
}

}  // namespace

std::string identity_of(const std::string& participant_name) {
  if (participant_name.find(',') == std::string::npos) return participant_name;
  return participant_name.substr(0, participant_name.find_last_of('_'));
}

std::optional<IdentityKey> key_of_identity(const std::string& identity) {
  const Owned<X509_NAME> subject = subject_of(identity);
  if (!subject) return std::nullopt;
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned int size = 0;
  if (X509_NAME_digest(subject.get(), EVP_sha256(), hash.data(), &size) != 1) return std::nullopt;
  IdentityKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) {
    const unsigned before = i == 0 ? 1U : hash.at(i - 1);
    key.at(i) = static_cast<std::uint8_t>(before << 7U | static_cast<unsigned>(hash.at(i)) >> 1U);
  }
  return key;
}

SecurityFiles security_files(const std::filesystem::path& folder, const std::string& identity) {
  const fs::path root = fs::absolute(folder);
  SecurityFiles files{.authority = root / "authority.pem",
                      .governance = root / "governance.p7s",
                      .certificate = root / identity / "certificate.pem",
                      .key = root / identity / "key.pem",
                      .permissions = root / identity / "permissions.p7s"};
  const Owned<X509_STORE> store = trusted(files.authority);
  const Owned<X509> certificate = read_certificate(files.certificate);
  check_subject(certificate.get(), identity, files.certificate);
  check_certificate(store.get(), certificate.get(), files.certificate);
  check_key(certificate.get(), files.key);
  check_signature(store.get(), files.governance);
  check_signature(store.get(), files.permissions);
  return files;
}

}  // namespace hlc::dds

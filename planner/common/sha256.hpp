#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace hlc {

/// SHA-256 of bytes added piece by piece (OpenSSL's libcrypto). Equal pieces in equal order give
/// equal hashes; how the bytes are split makes no difference.
/// @throws std::runtime_error if the library refuses
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void add(std::string_view bytes);
  /// 64 hexadecimal digits, over all added bytes. @pre called once, nothing is added afterwards
  [[nodiscard]] std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

[[nodiscard]] std::string sha256_of(std::string_view bytes);

}  // namespace hlc

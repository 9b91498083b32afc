#pragma once

#include <cstdint>

#include "planner/coordination/messages.hpp"

/// Digests (WordHash) with which controllers find out whether they have the same.
namespace hlc::coordination {

/// Of the whole message. Equal digests stand for equal messages: two that differ have the same one
/// with a probability of about 2^-64.
[[nodiscard]] std::uint64_t digest_of(const Traffic& traffic);
[[nodiscard]] std::uint64_t digest_of(const Prediction& prediction);

}  // namespace hlc::coordination

#pragma once

#include <cstddef>

#include "hlc_bridge/dds/fast_dds.hpp"
#include "hlc_bridge/dds/participant.hpp"

namespace hlc::dds {

inline constexpr std::size_t kMaxParticipantName = 255;

/// Transports, lease and discovery of a participant:
///
/// | | lab domain | local domain | controller domain |
/// | --- | --- | --- | --- |
/// | loopback | UDP on 127.0.0.1 | the same | the same |
/// | lab | UDP | shared memory only | UDP |
///
/// The lab's own processes have shared memory beside UDP on the lab domain. Ours do without: a
/// process that dies while it holds a lock there blocks all others on that machine. All of them use
/// UDP with participants that have nothing else.
///
/// Throws std::invalid_argument for a discovery server on the local domain (shared memory needs
/// none). Only sources of this folder include this file.
[[nodiscard]] fdds::DomainParticipantQos participant_qos(const ParticipantOptions& options);

}  // namespace hlc::dds

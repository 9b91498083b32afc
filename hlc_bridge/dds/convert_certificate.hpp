#pragma once

#include <CertificateMessage.h>

#include "planner/coordination/report.hpp"

/// Certificates in our own types. Only sources of this folder include this file.
namespace hlc::dds {

[[nodiscard]] CertificateMessage certificate_to_wire(const coordination::Certificate& certificate);
[[nodiscard]] bool is_valid(const CertificateMessage& wire);
/// @pre is_valid
[[nodiscard]] coordination::Certificate certificate_from_wire(const CertificateMessage& wire);

}  // namespace hlc::dds

#include "hlc_bridge/dds/convert_certificate.hpp"

#include <algorithm>

#include "hlc_bridge/dds/convert_areas.hpp"

namespace hlc::dds {
namespace {

// Without a default case: a new enumerator does not compile until it is known here.
bool is_known(coordination::KnownMotion known) {
  switch (known) {
    case coordination::KnownMotion::kRunning:
    case coordination::KnownMotion::kNew:
    case coordination::KnownMotion::kReachable:
    case coordination::KnownMotion::kMissing:
      return true;
  }
  return false;
}

SeparationMessage separation_to_wire(const coordination::Separation& separation) {
  const auto& [from, known, lines] = separation;
  SeparationMessage result;
  result.from(from.value);
  result.known(static_cast<std::uint8_t>(known));
  result.lines().reserve(lines.size());
  for (const auto& [direction_rad, offset_m] : lines) {
    SeparatingLineMessage line;
    line.direction_rad(direction_rad);
    line.offset_m(offset_m);
    result.lines().push_back(line);
  }
  return result;
}

bool is_valid_separation(const SeparationMessage& wire) {
  return is_valid(VehicleId{wire.from()}) &&
         is_known(static_cast<coordination::KnownMotion>(wire.known())) &&
         wire.lines().size() <= kMaxEntries &&
         std::ranges::all_of(wire.lines(), [](const SeparatingLineMessage& line) {
           return is_near(line.direction_rad()) && is_near(line.offset_m());
         });
}

coordination::Separation separation_from_wire(const SeparationMessage& wire) {
  coordination::Separation result{.from = {wire.from()},
                                  .known = static_cast<coordination::KnownMotion>(wire.known()),
                                  .lines = {}};
  for (const SeparatingLineMessage& line : wire.lines()) {
    result.lines.push_back({.direction_rad = line.direction_rad(), .offset_m = line.offset_m()});
  }
  return result;
}

}  // namespace

CertificateMessage certificate_to_wire(const coordination::Certificate& certificate) {
  const auto& [footprint, areas, is_agreed, separations] = certificate;
  CertificateMessage result;
  result.length_m(footprint.length_m);
  result.width_m(footprint.width_m);
  result.areas(areas_to_wire(areas));
  result.is_agreed(is_agreed);
  for (const coordination::Separation& separation : separations) {
    result.separations().push_back(separation_to_wire(separation));
  }
  return result;
}

bool is_valid(const CertificateMessage& wire) {
  return is_near(wire.length_m()) && is_near(wire.width_m()) && is_valid(wire.areas()) &&
         wire.separations().size() <= kMaxEntries &&
         std::ranges::all_of(wire.separations(), is_valid_separation);
}

coordination::Certificate certificate_from_wire(const CertificateMessage& wire) {
  coordination::Certificate result{
      .footprint = {.length_m = wire.length_m(), .width_m = wire.width_m()},
      .areas = areas_from_wire(wire.areas()),
      .is_agreed = wire.is_agreed(),
      .separations = {}};
  for (const SeparationMessage& separation : wire.separations()) {
    result.separations.push_back(separation_from_wire(separation));
  }
  return result;
}

}  // namespace hlc::dds

#include "hlc_bridge/result/guest_encounters.hpp"

#include <algorithm>
#include <cmath>

#include "planner/coordination/missing.hpp"
#include "planner/geometry/polygon.hpp"

namespace hlc::result {
namespace {

enum class Contact { kNone, kStanding, kMoving };

/// What a touch has become by this instant, counted.
Contact next_contact(Contact before, bool touches, bool moves, GuestEncounters& result) {
  if (!touches) return Contact::kNone;
  if (moves) {
    if (before == Contact::kStanding) --result.touched;
    if (before != Contact::kMoving) ++result.collisions;
    return Contact::kMoving;
  }
  if (before == Contact::kNone) ++result.touched;
  return before == Contact::kNone ? Contact::kStanding : before;
}

void measure_pair(const VehicleDescription& vehicle, const Drive& drive,
                  const VehicleDescription& guest, const Drive& guest_drive, Nanoseconds from,
                  Nanoseconds to, GuestEncounters& result) {
  constexpr double kStanding_mps = coordination::MissingVehicleRules{}.standing_speed_mps;
  Contact contact = Contact::kNone;
  for (const DrivenSample& sample : drive) {
    if (sample.t < from || sample.t > to) continue;
    const std::optional<Pose> guest_pose = driven_pose_at(guest_drive, sample.t);
    if (!guest_pose) continue;
    const double apart_m = distance_m(footprint_area(vehicle.footprint, sample.pose),
                                      footprint_area(guest.footprint, *guest_pose));
    result.min_distance_m = std::min(result.min_distance_m.value_or(apart_m), apart_m);
    contact =
        next_contact(contact, apart_m == 0.0, std::abs(sample.speed_mps) > kStanding_mps, result);
  }
}

}  // namespace

GuestEncounters guest_encounters(std::span<const VehicleDescription> vehicles,
                                 std::span<const VehicleDescription> guests, const Drives& drives,
                                 Nanoseconds from, Nanoseconds to) {
  GuestEncounters result;
  for (const VehicleDescription& vehicle : vehicles) {
    const auto drive = drives.find(vehicle.id.value);
    if (drive == drives.end()) continue;
    for (const VehicleDescription& guest : guests) {
      const auto guest_drive = drives.find(guest.id.value);
      if (guest_drive == drives.end()) continue;
      measure_pair(vehicle, drive->second, guest, guest_drive->second, from, to, result);
    }
  }
  return result;
}

}  // namespace hlc::result

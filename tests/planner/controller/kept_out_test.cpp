// What a vehicle waits for whose road is reserved for one that has waited longer.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "planner/controller/authority.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/right_of_way/reservation.hpp"
#include "tests/planner/right_of_way/random_traffic.hpp"
#include "tests/planner/right_of_way/routes.hpp"

namespace hlc::controller::kept_out_test {
namespace {

using right_of_way::Holder;

constexpr std::uint64_t kSeed = 1;
constexpr double kLookAhead_m = 1.0;
constexpr double kReach_m = 2.0;

/// The authority of one that has just come to stand, after a step in which it received all others.
class Stopped {
 public:
  Stopped(const scenario::Scenario& scenario, const std::vector<Holder>& holders, std::size_t who)
      : authority_(scenario.conflicts) {
    const coordination::LaneClaim& claim = holders[who].claim;
    RouteTracker tracker(std::make_shared<const std::vector<road::DrivableRoute>>(scenario.routes));
    tracker.resume(claim.route, claim.place_m);
    const road::ReferencePath& path = tracker.route().path;
    const Point at_m = path.at(claim.place_m);
    const automaton::UniversalAutomaton& automaton = scenario.subgraph->automaton();
    const coordination::Plan standing({1}, {at_m.x(), at_m.y(), path.heading_rad_at(claim.place_m)},
                                      self_loop(automaton, scenario.subgraph->standstill()));
    authority_.begin_step(standing, {1}, tracker, kReach_m);
    std::vector<coordination::Traffic> traffic;
    for (const Holder& one : holders) {
      traffic.push_back({.vehicle = one.vehicle, .claim = one.claim});
    }
    std::vector<const coordination::Traffic*> others;
    for (const coordination::Traffic& one : traffic) {
      if (one.vehicle != holders[who].vehicle) others.push_back(&one);
    }
    SharedStep shared;
    authority_.extend(holders[who].vehicle, others, {}, {}, 0.0, shared);
  }

  [[nodiscard]] std::vector<VehicleId> waits_for() const { return authority_.withheld_by(); }

 private:
  Authority authority_;
};

TEST(KeptOut, AVehicleWaitsForTheOneForWhichItsRoadIsReserved) {
  const scenario::Scenario& drawn = right_of_way::lab_cars_on_tours();
  right_of_way::RandomTraffic traffic(drawn, kSeed, kLookAhead_m);
  std::size_t num_kept_out = 0;
  for (int step = 0; step < 400; ++step) {
    static_cast<void>(traffic.step());
    for (std::size_t who = 0; who < traffic.before().size(); ++who) {
      std::vector<Holder> holders = traffic.before();
      if (holders[who].claim.waiting_steps == 0 || holders[who].claim.ahead_m > 0.0) continue;
      holders[who].claim.waiting_steps = 0;
      const std::vector<double> granted =
          right_of_way::grant(*drawn.conflicts, holders, {}, kLookAhead_m);
      const right_of_way::Reserved reserved =
          right_of_way::reserve(*drawn.conflicts, holders, granted, {}, right_of_way::kLongestWait);
      if (std::ranges::find(reserved.kept_out, who) == reserved.kept_out.end()) continue;
      EXPECT_EQ(Stopped(drawn, holders, who).waits_for(), std::vector{reserved.vehicle.value()})
          << "step " << step << ", vehicle " << who;
      ++num_kept_out;
    }
  }
  EXPECT_GT(num_kept_out, 0U) << "nothing was tried";
}

}  // namespace
}  // namespace hlc::controller::kept_out_test

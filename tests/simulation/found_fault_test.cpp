#include <gtest/gtest.h>

#include "hlc_bridge/messages/node_names.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "vehicle_sim/closed_loop/fault_campaign.hpp"

/// Faults that the fault simulator has found, each with the fewest of its seed's faults that it
/// needed. Each failed before it was mended.
namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kMs = kNanosecondsPerMillisecond;

scenario::Scenario circle(std::size_t cars) {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/circle.yaml", .cars = cars});
}

scenario::Scenario paper(std::size_t cars, std::uint64_t starts) {
  const std::string file =
      test::source_folder() + "/launch_scripts/scenarios/paper_three_cars.yaml";
  return scenario::with_random_starts(with_cars(scenario::read_scenario({.file = file}), cars),
                                      starts);
}

FaultRunResult run(const scenario::Scenario& scenario, const LabSettings& lab,
                   std::vector<Fault> faults, bool keeps_records = false) {
  const FaultCase the_case{
      .seed = lab.seed,
      .scenario = scenario,
      .run = {.lab = lab, .faults = std::move(faults), .keeps_records = keeps_records}};
  FaultRunResult result = FaultCampaign::run(the_case);
  EXPECT_GT(result.planned, 0U);
  for (const Violation& violation : result.violations) {
    ADD_FAILURE() << describe(the_case) << violation.check << ": " << violation.text;
  }
  return result;
}

/// Its plan of the last step before the cut never reaches the vehicle. Only that plan was
/// announced, and when the cut ended the vehicle changed over to it.
TEST(FoundFault, Seed6000AVehicleThatIsCutOffDrivesThePlanBeforeTheLast) {
  run(circle(6), {.seed = 6000, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kCut,
        .begin = 4449 * kMs,
        .end = 7670 * kMs,
        .process = vehicle_name(5)},
       {.kind = FaultKind::kCut, .begin = 4449 * kMs, .end = 7670 * kMs, .peer = vehicle_name(5)}});
}

/// The same where the middleware receives neither commands nor states.
TEST(FoundFault, Seed1018AMiddlewareThatReceivesNothing) {
  run(paper(3, 0x2897050d40e4877e), {.seed = 1018, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kWithhold,
        .begin = 4450 * kMs,
        .end = 7312 * kMs,
        .peer = middleware_name(2),
        .share = 1.0}});
}

/// Commands alone are lost, two in a row, while states come: beyond what a controller can know
/// (the limit in plan_in_force.hpp). The cars touch; it is counted, and not held against anybody.
TEST(FoundFault, Seed5515AVehicleThatMissesCommandsButIsSeenIsOutOfReach) {
  const FaultRunResult result =
      run(paper(3, 0x756778557e27f247), {.seed = 5515, .transport = Transport::kLab},
          {{.kind = FaultKind::kWithhold, .begin = 1604 * kMs, .end = 2378 * kMs, .share = 0.94},
           {.kind = FaultKind::kFreeze,
            .begin = 11176 * kMs,
            .end = 13531 * kMs,
            .process = controller_name(3)},
           {.kind = FaultKind::kLose,
            .begin = 11355 * kMs,
            .end = 16834 * kMs,
            .peer = vehicle_name(3),
            .share = 0.55}});
  EXPECT_GT(result.unreachable, 0U);
}

/// One command is lost and the next one arrives: the vehicle changes over to the plan late, on a
/// way that nobody knew, overshoots, and touches one that stands beside the plan (the same limit).
TEST(FoundFault, Seed101734AVehicleThatChangesOverLateIsOutOfReach) {
  const FaultRunResult result =
      run(paper(7, 0x71cd2f5d733d0ce6), {.seed = 101734, .transport = Transport::kLoopback},
          {{.kind = FaultKind::kWithhold, .end = 14'000 * kMs, .share = 0.20152936719888187}});
  EXPECT_GT(result.unreachable, 0U);
}

/// A vehicle that stands beside its plan is anchored there and plans again in the same step. The
/// others keep clear of where it stands, not of where it was to stand.
TEST(FoundFault, Seed101508AVehicleThatStandsBesideItsPlanIsWhereItsControllerSays) {
  run(circle(7), {.seed = 101508, .transport = Transport::kLab},
      {{.kind = FaultKind::kWithhold, .end = 7'000 * kMs, .share = 0.25177121723015788}});
}

/// A vehicle is anchored where it stands, in the margin of another one: nobody has agreed to that.
TEST(FoundFault, Seed100975AVehicleThatIsAnchoredHasAgreedToNothing) {
  run(circle(7), {.seed = 100975, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kReorder,
        .begin = 3'445'834'753,
        .end = 5'845'236'446,
        .process = middleware_name(4),
        .share = 1.0,
        .amount = 213'832'250},
       {.kind = FaultKind::kReorder,
        .begin = 4'080'687'930,
        .end = 5'284'683'608,
        .process = controller_name(1),
        .share = 0.92571817902456266,
        .amount = 180'539'902}});
}

/// Vehicle 4 did not receive vehicle 2, which waited for a step in which it was to drive off, and
/// took it for a standing obstacle although others received it. They touched.
TEST(FoundFault, Seed7331AVehicleThatOthersReceiveDoesNotStandForGood) {
  run(paper(7, 0xdd3d6053fc973b22), {.seed = 7331, .transport = Transport::kLab},
      {{.kind = FaultKind::kCut,
        .begin = 874'339'965,
        .end = 14'000 * kMs,
        .process = controller_name(2),
        .peer = controller_name(4)},
       {.kind = FaultKind::kStep,
        .begin = 3'087'523'214,
        .end = 5'939'864'600,
        .process = middleware_name(1),
        .amount = -212'633'438},
       {.kind = FaultKind::kCut,
        .begin = 3'661'907'073,
        .end = 14'000 * kMs,
        .process = controller_name(3),
        .peer = controller_name(2)}});
}

/// The controller dies between a command and its copy, and again before it has sent anything: the
/// vehicle drops its plan.
TEST(FoundFault, Seed7576AControllerThatDiesTwiceHasNotSentTheCopy) {
  run(circle(3), {.seed = 7576, .transport = Transport::kLab},
      {{.kind = FaultKind::kWithhold,
        .begin = 2'939'954'561,
        .end = 5'248'500'102,
        .peer = controller_name(2),
        .share = 1.0},
       {.kind = FaultKind::kKill,
        .begin = 3'612'097'985,
        .end = 3'671'090'040,
        .process = controller_name(2)},
       {.kind = FaultKind::kCut,
        .begin = 3'831'807'209,
        .end = 7'000 * kMs,
        .process = middleware_name(1),
        .peer = controller_name(3)},
       {.kind = FaultKind::kWithhold,
        .begin = 3'875'095'250,
        .end = 5'894'072'972,
        .process = controller_name(2),
        .peer = controller_name(3),
        .share = 1.0},
       {.kind = FaultKind::kKill,
        .begin = 4'044'430'120,
        .end = 4'644'332'095,
        .process = controller_name(3)},
       {.kind = FaultKind::kKill,
        .begin = 4'644'873'212,
        .end = 4'887'789'316,
        .process = controller_name(3)}});
}

/// A controller that starts in the middle of a run in logical time commanded its vehicle to stand
/// where it drove.
TEST(FoundFault, Seed1178InLogicalTimeARestartedControllerLeavesAMovingVehicleAlone) {
  run(paper(4, 0xb8dce3bc18d8e17),
      {.seed = 1178, .is_logical = true, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kWithhold,
        .begin = 1172 * kMs,
        .end = 6000 * kMs,
        .process = controller_name(2),
        .peer = controller_name(4),
        .share = 1.0},
       {.kind = FaultKind::kKill,
        .begin = 1511 * kMs,
        .end = 3761 * kMs,
        .process = controller_name(4)}});
}

/// The same for a vehicle that rolls slowly at the end of its plan: it was commanded to stand
/// beside it, and another one touched it.
TEST(FoundFault, Seed9026InLogicalTimeARestartedControllerLeavesASlowVehicleAlone) {
  run(paper(7, 0x9827360e0125d397),
      {.seed = 9026, .is_logical = true, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kKill,
        .begin = 664'469'338,
        .end = 5'739'808'986,
        .process = controller_name(1)}});
}

/// The same for a vehicle that is not seen, since its middleware was restarted, too, and begins
/// with the lists of the past.
TEST(FoundFault, Seed8097InLogicalTimeARestartedControllerLeavesAnUnseenVehicleAlone) {
  run(paper(4, 0x40815f0559f4f99a),
      {.seed = 8097, .is_logical = true, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kCut,
        .begin = 1'152'790'205,
        .end = 3'875'277'671,
        .process = middleware_name(4),
        .peer = controller_name(4),
        .share = 1.0},
       {.kind = FaultKind::kKill,
        .begin = 1'775'975'617,
        .end = 1'812'411'379,
        .process = controller_name(4)},
       {.kind = FaultKind::kKill,
        .begin = 1'778'010'174,
        .end = 1'874'278'622,
        .process = middleware_name(4)},
       {.kind = FaultKind::kKill,
        .begin = 3'258'111'992,
        .end = 3'296'948'501,
        .process = kLabControlName}});
}

/// Seed 101734 with two commands: the late one brings the missed plan, already continued by the
/// next one. The first list afterwards shows a state of 20 ms later, on the plan; two are lost.
TEST(FoundFault, Seed17395AVehicleThatChangesOverLateToALaterPlanIsOutOfReach) {
  const FaultRunResult result =
      run(paper(5, 0x96a803918bfeca28), {.seed = 17395, .transport = Transport::kLab},
          {{.kind = FaultKind::kLose, .end = 14'000 * kMs, .share = 0.26621008556306713}});
  EXPECT_GT(result.unreachable, 0U);
}

/// Commands come up to 0.8 s late, are dropped and followed again, and the vehicle comes to rest 40
/// mm beside its plan. For 2.8 s its controller does not see where.
TEST(FoundFault, Seed22554WhereAVehicleIsAfterwardsNobodyKnowsUntilItIsSeen) {
  const FaultRunResult result =
      run(paper(5, 0xa5dbc44e09efcd0b), {.seed = 22554, .transport = Transport::kLoopback},
          {{.kind = FaultKind::kReorder,
            .begin = 3'827'713'350,
            .end = 5'517'396'588,
            .share = 1.0,
            .amount = 407'527'249},
           {.kind = FaultKind::kDelay,
            .begin = 4'008'626'028,
            .end = 7'985'105'260,
            .share = 0.54683554917355637,
            .amount = 406'470'976}});
  EXPECT_GT(result.unreachable, 0U);
}

/// A controller that stood still for 4 s took another vehicle, which it had last seen standing and
/// saw standing again, for one that stood for good, and planned without its traffic.
TEST(FoundFault, Seed2667WhileAControllerStandsStillItSeesNobodyStanding) {
  const auto cut = [](std::uint8_t from, std::uint8_t to, Nanoseconds begin) {
    return Fault{.kind = FaultKind::kCut,
                 .begin = begin,
                 .end = 7'000 * kMs,
                 .process = controller_name(from),
                 .peer = controller_name(to)};
  };
  run(circle(3), {.seed = 2667, .transport = Transport::kLoopback},
      {cut(1, 3, 707'228'114),
       {.kind = FaultKind::kFreeze,
        .begin = 2'774'210'893,
        .end = 7'000 * kMs,
        .process = controller_name(2)},
       cut(2, 1, 2'774'210'893),
       cut(2, 3, 2'774'210'893)});
}

/// A controller that was started again joined the others while the lab control was dead. It had
/// never seen one, so it missed none, and drove on when all others had stopped.
TEST(FoundFault, Seed3148NobodyJoinsWithoutALabControl) {
  run(paper(5, 0x77bac0cead8ce0c4), {.seed = 3148, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kKill,
        .begin = 6'084'265'189,
        .end = 11'496'666'568,
        .process = kLabControlName},
       {.kind = FaultKind::kKill,
        .begin = 6'182'317'613,
        .end = 6'789'574'218,
        .process = controller_name(2)}});
}

/// A controller died between a command and its report: its vehicle drives the new plan, and nobody
/// has learned that it came into force.
TEST(FoundFault, Seed4412APlanMayBeDrivenWithoutAReport) {
  run(paper(4, 0x4a5b96c37bf6c527), {.seed = 4412, .transport = Transport::kLoopback},
      {{.kind = FaultKind::kWithhold,
        .begin = 5'974'917'108,
        .end = 9'379'567'598,
        .process = controller_name(2),
        .peer = controller_name(1),
        .share = 1.0},
       {.kind = FaultKind::kKill,
        .begin = 6'841'370'936,
        .end = 6'968'980'098,
        .process = controller_name(1)}});
}

/// No controller received vehicle 2's, which stood still until its lease had ended and then
/// received none either. They took it for one that stands for good, and it drove off.
TEST(FoundFault, Seed8592WhoIsCutOffFromAllOthersDoesNotDriveOff) {
  const auto cut = [](std::uint8_t to, Nanoseconds begin) {
    return Fault{.kind = FaultKind::kCut,
                 .begin = begin,
                 .end = 14'000 * kMs,
                 .process = controller_name(2),
                 .peer = controller_name(to)};
  };
  run(paper(4, 0x9b47d0f569543efd), {.seed = 8592, .transport = Transport::kLoopback},
      {cut(3, 579'345'047),
       {.kind = FaultKind::kFreeze,
        .begin = 4'266'679'954,
        .end = 9'716'774'924,
        .process = controller_name(2)},
       cut(1, 4'266'679'954),
       cut(4, 4'266'679'954)});
}

/// The same from before the first step on: it had never received anybody, so it missed nobody, and
/// drove off while the others took it for one that stands for good.
TEST(FoundFault, Seed20923WhoHasReceivedNobodyYetDoesNotDriveOffEither) {
  std::vector<Fault> faults{{.kind = FaultKind::kFreeze,
                             .begin = 2'829 * kMs,
                             .end = 8'213 * kMs,
                             .process = controller_name(2)}};
  for (const std::uint8_t other : std::initializer_list<std::uint8_t>{1, 3, 4, 5, 6, 7}) {
    faults.push_back({.kind = FaultKind::kCut,
                      .begin = 2'829 * kMs,
                      .end = 14'000 * kMs,
                      .process = controller_name(2),
                      .peer = controller_name(other)});
  }
  const FaultRunResult result =
      run(paper(7, 0xe593cdb42229edc), {.seed = 20923, .transport = Transport::kLab}, faults, true);
  std::size_t seen = 0;
  for (const ReportRecord& record : result.records->reports) {
    const coordination::Report& report = record.report;
    if (report.vehicle != VehicleId{2} || report.missing.size() < 6) continue;
    ++seen;
    EXPECT_NE(report.status, coordination::StepStatus::kPlanned) << report.step.value;
  }
  EXPECT_GT(seen, 0U) << "steps in which it receives nobody";
}

}  // namespace
}  // namespace hlc::closed_loop

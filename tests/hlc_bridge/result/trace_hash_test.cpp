#include "hlc_bridge/result/trace_hash.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <set>

namespace hlc::result::trace_hash_test {
namespace {

std::vector<StepRecord> run(unsigned seed) {
  std::mt19937 random{seed};
  std::uniform_real_distribution<double> value{-5.0, 5.0};
  std::vector<StepRecord> rows;
  for (std::uint64_t step = 0; step < 4; ++step) {
    for (std::uint8_t id = 1; id <= 3; ++id) {
      StepRecord row;
      row.step = step;
      row.record.report.vehicle = VehicleId{id};
      row.record.report.planned_pose = {value(random), value(random), value(random)};
      row.driven = Pose{value(random), value(random), value(random)};
      rows.push_back(row);
    }
  }
  return rows;
}

double with_bit_flipped(double value, unsigned bit) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ (std::uint64_t{1} << bit));
}

TEST(TraceHash, NothingHasTheKnownHashOfNothing) {
  EXPECT_EQ(trace_sha256({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(TraceHash, IsThatOfTheLittleEndianBytes) {
  // printf of the six doubles 1, 2, 3, 4, 5, 6 as bytes | sha256sum
  StepRecord row;
  row.record.report.planned_pose = {1, 2, 3};
  row.driven = Pose{4, 5, 6};
  const std::vector<StepRecord> rows{row};
  EXPECT_EQ(trace_sha256(rows), "d73f023a3f852bf2e5c6d836cd36cd930d0091dcba7f778161c707e1c58222b0");
}

TEST(TraceHash, EqualRunsHaveEqualHashes) { EXPECT_EQ(trace_sha256(run(1)), trace_sha256(run(1))); }

TEST(TraceHash, EveryFlippedBitOfAnyPoseChangesIt) {
  const std::string original = trace_sha256(run(1));
  std::set<std::string> hashes{original};
  std::mt19937 random{2};
  std::size_t changes = 0;
  for (std::size_t i = 0; i < run(1).size(); ++i) {
    for (double Pose::*field : {&Pose::x_m, &Pose::y_m, &Pose::heading_rad}) {
      const unsigned bit = random() % 64;
      std::vector<StepRecord> planned = run(1);
      Pose& pose = planned[i].record.report.planned_pose;
      pose.*field = with_bit_flipped(pose.*field, bit);
      std::vector<StepRecord> driven = run(1);
      (*driven[i].driven).*field = with_bit_flipped((*driven[i].driven).*field, bit);
      hashes.insert(trace_sha256(planned));
      hashes.insert(trace_sha256(driven));
      changes += 2;
    }
  }
  EXPECT_EQ(hashes.size(), changes + 1);
}

TEST(TraceHash, MissingDrivenPoseIsNotTheOrigin) {
  std::vector<StepRecord> missing = run(1);
  missing[0].driven.reset();
  std::vector<StepRecord> origin = run(1);
  origin[0].driven = Pose{};
  EXPECT_NE(trace_sha256(missing), trace_sha256(origin));
}

TEST(TraceHash, NothingOfTheClockCounts) {
  std::vector<StepRecord> slower = run(1);
  for (StepRecord& row : slower) {
    row.record.planning_ns = 12345;
    row.record.deadline_missed = true;
    row.record.late_ns = 1;
  }
  EXPECT_EQ(trace_sha256(slower), trace_sha256(run(1)));
}

}  // namespace
}  // namespace hlc::result::trace_hash_test

#include "hlc_bridge/record/summary_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace hlc::record {
namespace {

using testing::ElementsAre;

std::vector<std::string> keys(const nlohmann::ordered_json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) {
    keys.push_back(key);
  }
  return keys;
}

result::RunSummary some_summary() {
  result::RunSummary summary;
  summary.description.scenario = "circle";
  summary.steps = 60;
  result::VehicleSummary vehicle;
  vehicle.id = VehicleId{4};
  vehicle.name = "four";
  vehicle.lap_s = 15.5;
  vehicle.reference_error_m = result::Statistics{
      .count = 9, .mean = 0.02, .std = 0.01, .p99 = 0.04, .min = 0.0, .max = 0.05};
  vehicle.planning_s = result::Statistics{
      .count = 9, .mean = 0.001, .std = 0.002, .p99 = 0.003, .min = 0.0, .max = 0.004};
  vehicle.generated =
      result::Statistics{.count = 9, .mean = 20.5, .std = 1, .p99 = 30, .min = 1, .max = 40};
  vehicle.driven_speed_mps =
      result::Statistics{.count = 9, .mean = 0.5, .std = 0.2, .p99 = 0.7, .min = 0, .max = 0.75};
  vehicle.plan_cost_m2 =
      result::Statistics{.count = 9, .mean = 0.125, .std = 0.2, .p99 = 1.5, .min = 0, .max = 2.0};
  vehicle.fallback_steps = 3;
  summary.vehicles.push_back(vehicle);
  summary.trace_sha256 = "abc";
  return summary;
}

TEST(SummaryFile, HasTheAgreedKeysInOrder) {
  const auto json = nlohmann::ordered_json::parse(summary_json(some_summary()));
  EXPECT_THAT(keys(json),
              ElementsAre("scenario", "profile", "map", "seed", "subgraph", "horizon_steps",
                          "step_s", "steps", "vehicles", "generated_vertices_sum_max",
                          "min_footprint_distance_m", "collisions", "wall_s", "realtime_factor",
                          "response_time_ms", "trace_sha256", "revision", "host", "engine",
                          "expanded_vertices_sum_max", "policy", "longest_wait_s", "stuck_vehicles",
                          "joint_gap", "priorities", "rounds", "min_obstacle_distance_m",
                          "obstacles", "guests", "min_guest_distance_m", "touched_by_guests"));
  const auto& vehicle = json["vehicles"][0];
  EXPECT_THAT(keys(vehicle),
              ElementsAre("id", "name", "lap_s", "reference_error_mm", "tracking_error_mm",
                          "generated_vertices", "expanded_vertices", "planning_time_ms",
                          "fallback_steps", "deadline_misses", "budget_share",
                          "plans_exceeding_step", "undrivable_steps", "driven_error_mm",
                          "longest_wait", "arrived_s", "driven_speed_mps", "plan_cost_m2"));
  EXPECT_THAT(keys(vehicle["reference_error_mm"]), ElementsAre("mean", "std", "max"));
  EXPECT_THAT(keys(vehicle["driven_error_mm"]), ElementsAre("mean", "std", "max"));
  EXPECT_THAT(keys(vehicle["tracking_error_mm"]), ElementsAre("mean", "max"));
  EXPECT_THAT(keys(vehicle["generated_vertices"]), ElementsAre("max", "mean"));
  EXPECT_THAT(keys(vehicle["expanded_vertices"]), ElementsAre("max", "mean"));
  EXPECT_THAT(keys(vehicle["planning_time_ms"]), ElementsAre("mean", "std", "p99", "max"));
  EXPECT_THAT(keys(json["host"]), ElementsAre("cpu", "cores", "kernel"));
}

TEST(SummaryFile, NamesTheRoundsOfMessages) {
  result::RunSummary summary = some_summary();
  EXPECT_EQ(nlohmann::json::parse(summary_json(summary))["rounds"], "sequential");
  summary.description.has_two_rounds = true;
  EXPECT_EQ(nlohmann::json::parse(summary_json(summary))["rounds"], "two");
}

TEST(SummaryFile, HasTheObstaclesAndHowCloseTheyWere) {
  result::RunSummary summary = some_summary();
  summary.min_obstacle_distance_m = 0.25;
  summary.description.obstacles = {{.name = "van", .area_m = {{{1, 2}, {3, 2}, {3, 4}}}},
                                   {.name = {}, .from = 7, .area_m = {}}};
  const auto json = nlohmann::ordered_json::parse(summary_json(summary));
  EXPECT_EQ(json["min_obstacle_distance_m"].get<double>(), 0.25);
  EXPECT_EQ(json["obstacles"].dump(),
            R"([{"name":"van","from_step":0,"corners_m":[[1.0,2.0],[3.0,2.0],[3.0,4.0]]},)"
            R"({"name":null,"from_step":7,"corners_m":[]}])");
}

TEST(SummaryFile, UnitsAreThoseOfTheKeys) {
  const auto json = nlohmann::ordered_json::parse(summary_json(some_summary()));
  const auto& vehicle = json["vehicles"][0];
  EXPECT_NEAR(vehicle["reference_error_mm"]["mean"].get<double>(), 20.0, 1e-9);
  EXPECT_NEAR(vehicle["reference_error_mm"]["max"].get<double>(), 50.0, 1e-9);
  EXPECT_NEAR(vehicle["planning_time_ms"]["p99"].get<double>(), 3.0, 1e-9);
  EXPECT_EQ(vehicle["generated_vertices"]["max"].get<double>(), 40.0);
  EXPECT_EQ(vehicle["lap_s"].get<double>(), 15.5);
  EXPECT_EQ(vehicle["fallback_steps"].get<int>(), 3);
  EXPECT_EQ(vehicle["driven_speed_mps"].dump(), R"({"mean":0.5,"max":0.75})");
  EXPECT_EQ(vehicle["plan_cost_m2"].dump(), R"({"mean":0.125,"max":2.0})");
}

TEST(SummaryFile, NamesWhoWaitedForWhomAndWhoIsStuck) {
  result::RunSummary summary = some_summary();
  summary.vehicles.push_back(summary.vehicles.front());
  summary.vehicles.back().id = VehicleId{5};
  summary.vehicles.back().wait = {.duration_s = 22.4, .since_step = 12, .vehicles = {{4}, {6}}};
  summary.vehicles.back().is_stuck = true;
  const auto json = nlohmann::ordered_json::parse(summary_json(summary));
  EXPECT_TRUE(json["vehicles"][0]["longest_wait"].is_null());
  EXPECT_EQ(json["vehicles"][1]["longest_wait"].dump(),
            R"({"duration_s":22.4,"since_step":12,"waits_for":[4,6]})");
  EXPECT_EQ(json["longest_wait_s"].get<double>(), 22.4);
  EXPECT_EQ(json["stuck_vehicles"].dump(), "[5]");
  const auto without = nlohmann::ordered_json::parse(summary_json(some_summary()));
  EXPECT_EQ(without["longest_wait_s"].get<double>(), 0.0);
  EXPECT_EQ(without["stuck_vehicles"].dump(), "[]");
}

TEST(SummaryFile, WhatIsUnknownIsNull) {
  const auto json = nlohmann::ordered_json::parse(summary_json(some_summary()));
  EXPECT_TRUE(json["map"].is_null());
  EXPECT_TRUE(json["min_footprint_distance_m"].is_null());
  EXPECT_TRUE(json["vehicles"][0]["tracking_error_mm"]["mean"].is_null());
}

}  // namespace
}  // namespace hlc::record

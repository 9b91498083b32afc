#include "tests/benchmarks/search_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace hlc::test::search_report_test {
namespace {

TEST(Percentile, IsTheValueOfTheNearestRank) {
  std::vector<double> values;
  for (int i = 150; i > 0; --i) values.push_back(i);
  EXPECT_EQ(percentile(values, 0.5), 75.0);
  EXPECT_EQ(percentile(values, 0.99), 149.0);
  EXPECT_EQ(percentile(values, 1.0), 150.0);
  EXPECT_EQ(percentile({3.0}, 0.5), 3.0);
}

TEST(AgreesWith, AllowsForRoundingOnly) {
  const Solved reference{.has_plan = true, .cost = 2.0};
  EXPECT_TRUE(agrees_with(reference, {.has_plan = true, .cost = 2.0 + 2.9e-9}));
  EXPECT_FALSE(agrees_with(reference, {.has_plan = true, .cost = 2.0 + 3.1e-9}));
  EXPECT_FALSE(agrees_with(reference, {.has_plan = true, .cost = 2.0 - 3.1e-9}));
  EXPECT_FALSE(agrees_with(reference, {.has_plan = false}));
  EXPECT_FALSE(agrees_with(reference, {.has_plan = true, .stopped_early = true, .cost = 2.0}));
  EXPECT_TRUE(agrees_with({.has_plan = false}, {.has_plan = false}));
  EXPECT_FALSE(agrees_with({.has_plan = false}, {.has_plan = true}));
}

const EngineRun kReference{"plain",
                           {{.time_us = 30.0, .has_plan = true, .generated = 9, .expanded = 3},
                            {.time_us = 90.0, .has_plan = true, .generated = 21, .expanded = 8}}};
const EngineRun kFast{"fast",
                      {{.time_us = 2.0, .has_plan = true, .generated = 3, .expanded = 1},
                       {.time_us = 4.0, .has_plan = true, .cost = 1e-3, .generated = 6}}};

TEST(SearchReport, RatiosSayHowManyTimesFasterThanTheReference) {
  const SetReport report = report_on("set", {kReference, kFast}, &kReference);
  ASSERT_EQ(report.engines.size(), 2U);
  EXPECT_EQ(report.problems, 2U);
  const EngineReport& fast = report.engines[1];
  EXPECT_EQ(fast.mean_us, 3.0);
  EXPECT_EQ(fast.p50_us, 2.0);
  EXPECT_EQ(fast.generated, 4.5);
  EXPECT_EQ(fast.expanded, 0.5);
  EXPECT_NEAR(fast.per_vertex_ns, 3e3 / 4.5, 1e-9);
  EXPECT_EQ(fast.ratio_mean, 20.0);
  EXPECT_EQ(fast.ratio_p99, 22.5);
  EXPECT_EQ(fast.ratio_max, 22.5);
}

TEST(SearchReport, OnePlanThatCostsMoreMakesAnEngineNotOptimal) {
  EngineRun agreeing = kFast;
  agreeing.solved[1].cost = 0.0;
  const SetReport report = report_on("set", {kReference, kFast, agreeing}, &kReference);
  EXPECT_EQ(report.engines[0].optimal, true);
  EXPECT_EQ(report.engines[1].optimal, false);
  EXPECT_EQ(report.engines[2].optimal, true);
}

TEST(SearchReport, JsonHasTheDocumentedFieldsAndNoOthers) {
  const nlohmann::json json = to_json({report_on("set", {kReference}, &kReference)});
  EXPECT_EQ(json, nlohmann::json::parse(R"({"sets": [{"name": "set", "problems": 2, "engines": [
              {"name": "plain", "mean_us": 60.0, "p50_us": 30.0, "p99_us": 90.0, "max_us": 90.0,
               "generated": 15.0, "expanded": 5.5, "ratio_mean": 1.0, "ratio_p99": 1.0,
               "ratio_max": 1.0, "optimal": true}]}]})"));
}

TEST(SearchReport, WithoutAReferenceThereAreNoRatios) {
  const nlohmann::json json = to_json({report_on("set", {kFast}, nullptr)});
  const nlohmann::json& engine = json["sets"][0]["engines"][0];
  EXPECT_EQ(engine["mean_us"], 3.0);
  for (const char* name : {"ratio_mean", "ratio_p99", "ratio_max", "optimal"}) {
    EXPECT_TRUE(engine.at(name).is_null()) << name;
  }
}

}  // namespace
}  // namespace hlc::test::search_report_test

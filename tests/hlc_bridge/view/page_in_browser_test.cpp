// What the page of a run shows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hlc_bridge/view/page_in_browser.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"
#include "tests/planner/right_of_way/routes.hpp"

namespace hlc::view {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(PageInBrowser, ShowsEveryCarWithItsStateInWords) {
  const json result = result_of(sample_run(3, 20, "[script]"), R"(
    at(2.4);
    result.cars = [...by_id("cars").rows].map((row) => row.textContent);
    result.fault = text("fault");
    const { data } = by_id("map").getContext("2d").getImageData(0, 0, 1000, 500);
    result.colours = new Set(new Uint32Array(data.buffer)).size;
  )");
  ASSERT_EQ(result.at("cars").size(), 3U);
  EXPECT_THAT(result.at("cars").at(0), HasSubstr("[script]drives, "));
  EXPECT_THAT(result.at("cars").at(1), HasSubstr("waits for car 1 since 1.0 s (for 1.4 s)"));
  EXPECT_EQ(result.at("fault"), "");
  EXPECT_GT(result.at("colours"), 20) << "the map is empty";
}

TEST_F(PageInBrowser, NamesAndMessagesAreText) {
  const std::string name = "</script><script>window.is_harmed = true;</script><b>&amp;\u2028'\"`";
  FinishedRun run = sample_run(2, 20, name);
  run.description.scenario = name;
  run.facts.reason = name;
  run.fault = name;
  run.log.push_back({.process = name, .stamp = {}, .level = name, .text = name, .run_s = {}});
  for (result::StepRecord& row : run.rows) row.record.report.subgraph = name;
  const json result = result_of(run, R"(
    page.select(1);
    page.draw();
    result.is_harmed = Boolean(window.is_harmed);
    result.num_scripts = document.scripts.length;
    result.num_bold = document.querySelectorAll("aside td b, h1 b, dd b").length;
    result.name = page.run.vehicles[0].name;
    result.shown = [text("title"), text("fault"), text("cars"), text("log"), row("subgraph")]
      .map((shown) => shown.includes(result.name));
  )");
  EXPECT_EQ(result.at("is_harmed"), false);
  EXPECT_EQ(result.at("num_scripts"), 3) << "the data, the page's and this test's";
  EXPECT_EQ(result.at("num_bold"), 0);
  EXPECT_EQ(result.at("name"), name);
  EXPECT_EQ(result.at("shown"), json({true, true, true, true, true}));
}

TEST_F(PageInBrowser, DataOfAnotherVersionIsRefusedInOneLine) {
  const auto with_format = [](std::string page) {
    const std::string format = R"("kind":"run","format":)";
    return page.replace(page.find(format) + format.size(), 1, "999");
  };
  const json result = result_of(with_format(run_page(sample_run(2, 20))), R"(
    result.fault = text("fault");
    result.is_running = page !== undefined;
  )");
  EXPECT_EQ(result.at("fault"),
            "This run cannot be shown: data of format 999, must be 2, that of this page");
  EXPECT_EQ(result.at("is_running"), false);
}

TEST_F(PageInBrowser, AnIncompleteFileIsReportedInOneLine) {
  const auto without_end = [](const std::string& page) {
    const std::string data = R"("kind":"steps")";
    return page.substr(0, page.find(data)) + "]</script></body>";
  };
  const json result = result_of(without_end(run_page(sample_run(2, 20))), R"(
    result.fault = text("fault");
  )");
  EXPECT_THAT(result.at("fault"), HasSubstr("the file is incomplete"));
}

TEST_F(PageInBrowser, ThePlanIsThatOfTheReportWhateverTheNextOneHas) {
  FinishedRun run = sample_run(1, 20);
  for (result::StepRecord& row : run.rows) {
    if (row.step >= 10) row.record.report.planned_pose.x_m += 1.0;
  }
  const json result = result_of(run, R"(
    const { run } = page;
    const [car] = run.vehicles;
    const { path, areas } = run.plan_points(car, 9);
    result.longest_m = Math.max(...path.slice(1).map(
      ([x, y], i) => Math.hypot(x - path[i][0], y - path[i][1])));
    result.num_points = path.length;
    result.num_areas = areas.length;
    result.apart_m = Math.abs(path.at(-1)[0] - path[0][0] -
                              3 * (car.steps[9].pose.x - car.steps[8].pose.x));
    result.within_m = run.planned_at(car, 9.5 * run.step_s).x - car.steps[9].pose.x;
    result.step_m = car.steps[9].pose.x - car.steps[8].pose.x;
  )");
  EXPECT_LT(result.at("longest_m"), 0.1);
  EXPECT_EQ(result.at("num_points"), 3 * 11) << "three maneuvers are ahead";
  EXPECT_EQ(result.at("num_areas"), 3);
  EXPECT_LT(result.at("apart_m"), 0.001);
  EXPECT_NEAR(result.at("within_m"), 0.5 * result.at("step_m").get<double>(), 0.001);
}

TEST_F(PageInBrowser, ARunWithRightOfWayShowsConflictZonesAndWhoHoldsThem) {
  FinishedRun run = sample_run(2, 20);
  const std::vector<road::DrivableRoute> routes{right_of_way::circle({1.0, 2.0}, 1.0),
                                                right_of_way::circle({2.2, 2.0}, 1.0)};
  run.description.conflicts =
      std::make_shared<right_of_way::ConflictMap>(routes, right_of_way::kCar);
  for (result::StepRecord& row : run.rows) {
    coordination::Report& report = row.record.report;
    const bool holds_all = report.vehicle.value == 1;
    report.held = {holds_all ? 0U : 1U, 0.0,
                   holds_all ? run.description.conflicts->length_m(0) : 0.4};
  }
  const json result = result_of(run, R"(
    result.is_offered = !by_id("zones").parentElement.hidden;
    page.select(1);
    at(1);
    result.held = row("zones held");
    page.select(2);
    at(1);
    result.held_by_second = row("zones held");
    const cells = page.run.held_in(page.run.vehicles[1], 5);
    result.num_places = cells.places.length;
    const { zones } = page.run.roads[1];
    result.first_conflict = zones.findIndex((zone) => zone > 0);
    page.run.vehicles[1].steps[5].held = [1, 0, result.first_conflict];
    page.draw();
    result.next = row(`parts of zone ${zones[result.first_conflict]}, next, held by`);
  )");
  EXPECT_EQ(result.at("is_offered"), true);
  EXPECT_EQ(result.at("held"), "zone 1, zone 2");
  EXPECT_EQ(result.at("held_by_second"), "none");
  EXPECT_EQ(result.at("num_places"), 11) << "0.4 m of 40 mm each, and the first";
  EXPECT_GT(result.at("first_conflict"), 11);
  EXPECT_THAT(result.at("next"),
              testing::AllOf(HasSubstr("car 1"), testing::Not(HasSubstr("car 2"))));
}

TEST_F(PageInBrowser, ARunWithoutRightOfWayOffersNoZones) {
  const json result = result_of(sample_run(2, 20), R"(
    result.is_offered = !by_id("zones").parentElement.hidden;
  )");
  EXPECT_EQ(result.at("is_offered"), false);
}

TEST_F(PageInBrowser, AReportOfLogicalTimeHasItsExplanationOrTheCommandThatFindsIt) {
  FinishedRun run = sample_run(2, 20);
  run.how_explained = "explain RUN --vehicle_id VEHICLE --step STEP";
  const json result = result_of(run, R"(
    page.run.take({ kind: "why", vehicle: 2, steps: [[5, 6, "did\n<b>stood</b>"]] });
    page.select(2);
    at(1.2);
    result.explained = row("why");
    at(1.4);
    result.other = row("why");
  )");
  EXPECT_EQ(result.at("explained"), "did\n<b>stood</b>");
  EXPECT_EQ(result.at("other"), "explain RUN --vehicle_id 2 --step 7");
}

TEST_F(PageInBrowser, WhatWasSearchedInAStepIsShownOverThePage) {
  FinishedRun run = sample_run(2, 20);
  run.searches = {{.step = 5, .vehicle = {2}, .html = "<p>tree</p><script>top.x = 1</script>"}};
  const json result = result_of(run, R"(
    page.select(2);
    at(0.8);
    result.is_offered = Boolean(document.querySelector("[data-row=searched]"));
    at(1);
    document.querySelector("[data-row=searched] button").click();
    const dialog = document.querySelector("dialog");
    result.is_open = dialog.open;
    const frame = dialog.querySelector("iframe");
    result.page = frame.srcdoc;
    result.sandbox = frame.getAttribute("sandbox");
    dialog.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
    result.t = page.player.t;
    const escape = new KeyboardEvent("keydown", { key: "Escape", bubbles: true, cancelable: true });
    result.is_left_to_the_browser = dialog.dispatchEvent(escape);
    result.selected = page.selected;
    const closed = new Promise((done) => dialog.addEventListener("close", done));
    dialog.querySelector("button").click();
    await closed;
    result.is_gone = !document.querySelector("dialog");
  )");
  EXPECT_EQ(result.at("is_offered"), false);
  EXPECT_EQ(result.at("is_open"), true);
  EXPECT_EQ(result.at("page"), run.searches.front().html);
  EXPECT_EQ(result.at("sandbox"), "") << "scripts are off";
  EXPECT_EQ(result.at("t"), 1) << "keys are not those of the page below";
  EXPECT_EQ(result.at("is_left_to_the_browser"), true) << "Escape closes the dialog";
  EXPECT_EQ(result.at("selected"), 2);
  EXPECT_EQ(result.at("is_gone"), true);
}

TEST_F(PageInBrowser, AnObstacleThatAForkAddedIsDrawnFromItsStepOn) {
  FinishedRun run = sample_run(2, 20);
  run.fork = "a fork: from step 5 on obstacle=1,2,0.4,0.3";
  run.description.obstacles = {
      {.name = {}, .from = 5, .area_m = footprint_area({0.4, 0.3}, {1.0, 2.0, 0.0})}};
  const json result = result_of(run, R"(
    const colours = () => {
      const drawn = [];
      const { fill } = page.map;
      page.map.fill = (path, name) => drawn.push(name);
      page.map.draw(page.shown);
      page.map.fill = fill;
      return drawn.includes("alarm");
    };
    at(0.9);
    result.before = colours();
    at(1);
    result.after = colours();
    result.about = by_id("about").textContent;
  )");
  EXPECT_EQ(result.at("before"), false);
  EXPECT_EQ(result.at("after"), true);
  EXPECT_THAT(result.at("about"), HasSubstr(run.fork));
}

TEST_F(PageInBrowser, ACarThatHasArrivedStandsAtItsGoal) {
  FinishedRun run = sample_run(1, 20);
  for (result::StepRecord& row : run.rows) row.record.report.waiting = {};
  for (result::DrivenSample& sample : run.drives.begin()->second) sample.speed_mps = 0.0;
  result::StepRecord& last = run.rows.back();
  last.record.report.status = coordination::StepStatus::kPlanned;
  last.record.report.arrived_since = last.record.report.step;
  const json result = result_of(run, R"(
    const words_at = (t) => {
      at(t);
      page.select(1);
      page.draw();
      return row("state");
    };
    result.before = words_at(1);
    result.at_the_end = words_at(3.9);
  )");
  EXPECT_THAT(result.at("at_the_end").get<std::string>(), HasSubstr("at its goal"));
  EXPECT_THAT(result.at("before").get<std::string>(), testing::Not(HasSubstr("at its goal")));
}

TEST_F(PageInBrowser, ATimeThatCannotBeIsCorrectedAndAfterEnterTheKeysPlay) {
  const json result = result_of(sample_run(2, 20), R"(
    const field = by_id("time");
    field.focus();
    field.value = "99";
    field.dispatchEvent(new Event("change"));
    result.has_focus = document.activeElement === field;
    field.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
    result.shown = Number(field.value);
    result.end = page.run.end_s;
    result.is_left = document.activeElement !== field;
  )");
  EXPECT_EQ(result.at("shown"), result.at("end"));
  EXPECT_EQ(result.at("has_focus"), true) << "it can be stepped again";
  EXPECT_EQ(result.at("is_left"), true);
}

TEST_F(PageInBrowser, TheLastMomentShowsThePlannedPoseToo) {
  const json result = result_of(sample_run(3, 20), R"(
    page.select(1);
    at(page.run.end_s - 0.1);
    result.rows = [...document.querySelectorAll("#report dt")].map((row) => row.textContent);
  )");
  EXPECT_THAT(result.at("rows").get<std::vector<std::string>>(),
              testing::IsSupersetOf({"driven", "planned"}));
}

TEST_F(PageInBrowser, ACarWithoutARecordIsNotShownAsStanding) {
  FinishedRun run = sample_run(3, 20);
  result::Drive& cut_off = run.drives.at(1);
  cut_off.resize(cut_off.size() / 2);
  run.drives.erase(3);
  const json result = result_of(run, R"(
    at(3);
    result.states = [...by_id("cars").rows].map((row) => row.cells[2].textContent);
    result.legend = text("legend");
  )");
  EXPECT_EQ(result.at("states").at(0), "no driven path recorded");
  EXPECT_EQ(result.at("states").at(2), "no driven path recorded");
  EXPECT_THAT(result.at("legend"), HasSubstr("no driven path recorded"));
}

TEST_F(PageInBrowser, TheDrivenPathEndsAtTheMomentShownEvenBeforeAGap) {
  FinishedRun run = sample_run(1, 20);
  result::Drive& drive = run.drives.at(1);
  drive.erase(drive.begin() + 75, drive.begin() + 100);  // from 1.5 s to 2 s, at states every 20 ms
  const json result = result_of(run, R"(
    const [car] = page.run.vehicles;
    result.num_points = [1, 1.7, 2.1].map((t) => page.run.driven_path(car, 0.5, t).length);
  )");
  EXPECT_EQ(result.at("num_points"), json({26, 50, 56}));
}

TEST_F(PageInBrowser, ACarThatWaitsForLongIsStuck) {
  const json result = result_of(sample_run(3, 120), R"(
    page.select(2);
    at(20.9);
    result.before = row("state");
    at(21.1);
    result.after = row("state");
    result.legend = text("legend");
  )");
  EXPECT_THAT(result.at("before"), StartsWith("waits for car 1"));
  EXPECT_THAT(result.at("after"), StartsWith("stuck: waits for car 1"));
  EXPECT_THAT(result.at("legend"), HasSubstr("stuck"));
}

TEST_F(PageInBrowser, TheLegendNamesMissedDeadlinesIfThereAreAny) {
  const char* const script = "result.legend = text('legend');";
  FinishedRun run = sample_run(3, 20);
  EXPECT_THAT(result_of(run, script).at("legend"), testing::Not(HasSubstr("deadline missed")));
  run.rows.at(5).record.deadline_missed = true;
  EXPECT_THAT(result_of(run, script).at("legend"), HasSubstr("deadline missed (lowest strip)"));
}

TEST_F(PageInBrowser, LegendAndCaptionDoNotOverlapOnANarrowPage) {
  const json result = result_of(sample_run(3, 20), R"(
    document.body.style.width = "900px";
    page.draw_static();
    const [a, b] = ["legend", "planning_title"].map((id) => by_id(id).getBoundingClientRect());
    result.apart = a.bottom <= b.top || a.right <= b.left;
  )");
  EXPECT_EQ(result.at("apart"), true);
}

TEST_F(PageInBrowser, LabelsOfCarsCloseTogetherDoNotOverlap) {
  const json result = result_of(sample_run(3, 20), R"(
    const taken = [{ x: 200, y: 214, half: 8 }];
    for (const x of [200, 220, 240]) page.map.draw_label("waits for 1", x, 210, taken);
    result.apart = taken.every((a, i) => taken.slice(i + 1).every(
      (b) => Math.abs(a.y - b.y) >= 13 || Math.abs(a.x - b.x) >= a.half + b.half));
  )");
  EXPECT_EQ(result.at("apart"), true);
}

TEST_F(PageInBrowser, TermsOfTheReportAreExplained) {
  const json result = result_of(sample_run(3, 20), R"(
    page.select(1);
    page.draw();
    for (const term of document.querySelectorAll("#report dt")) result[term.textContent] = term.title;
  )");
  EXPECT_THAT(result.at("state"), HasSubstr("stuck"));
  EXPECT_THAT(result.at("status"), HasSubstr("fallback: the former plan stays in force"));
  EXPECT_THAT(result.at("subgraph"), HasSubstr("trims and maneuvers"));
  EXPECT_THAT(result.at("maneuver"), HasSubstr("criterion"));
}

TEST_F(PageInBrowser, TheHeaderNamesADeathOnceAndTwoRounds) {
  FinishedRun run = sample_run(3, 20);
  run.description.has_two_rounds = true;
  run.facts.exit_code = 4;
  run.facts.reason = "died: middleware_2";
  run.facts.died = {{"middleware_2", "it left"}};
  run.fault = "vehicle_2.csv ends early";
  const json result = result_of(run, R"(
    result.about = text("about");
    result.fault = text("fault");
  )");
  EXPECT_THAT(result.at("about"), HasSubstr("two rounds of messages"));
  EXPECT_EQ(result.at("fault"),
            "middleware_2 died (it left); vehicle_2.csv ends early; exit code 4");
}

TEST_F(PageInBrowser, NoRequestLeaves) {
  const json result = result_of(sample_run(3, 20), R"(
    at(1);
    result.requests = performance.getEntriesByType("resource").map(({ name }) => name);
    const refused = new Promise((done) => document.addEventListener(
      "securitypolicyviolation", ({ effectiveDirective }) => done(effectiveDirective)));
    fetch("http://127.0.0.1:8000/").catch(() => {});
    result.refused = await Promise.race([refused, new Promise((done) => setTimeout(done, 1000))]);
  )");
  EXPECT_EQ(result.at("requests"), json::array());
  EXPECT_EQ(result.at("refused"), "connect-src") << "by the page's policy";
}

TEST_F(PageInBrowser, ARunWithoutStepsIsShown) {
  const json result = result_of(sample_run(2, 0), R"(
    at(1);
    press(" ");
    result.fault = text("fault");
    result.cars = [...by_id("cars").rows].map((row) => row.textContent);
  )");
  EXPECT_THAT(result.at("fault"), HasSubstr("No step was reported"));
  EXPECT_THAT(result.at("cars").at(0), HasSubstr("no report in this step"));
}

}  // namespace
}  // namespace hlc::view

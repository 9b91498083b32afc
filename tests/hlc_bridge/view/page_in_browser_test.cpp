// The page of a run in a browser, opened from disk. Skipped on a machine without Chromium.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "hlc_bridge/view/run_page.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"
#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::view {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

std::string output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::string output;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) output += buffer.data();
  pclose(pipe);
  return output;
}

std::string browser() {
  const std::string path = output_of("command -v chromium");
  return path.substr(0, path.find('\n'));
}

/// What a test's script uses: `page`, text and clicks.
constexpr const char* kHelpers = R"(
  const page = window.page;
  const by_id = (id) => document.getElementById(id);
  const text = (id) => by_id(id).textContent;
  const row = (name) => document.querySelector(`[data-row="${name}"]`).textContent;
  const at = (t) => { page.player.seek(t); page.draw(); };
  const press = (key) => {
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
    page.draw();
  };
  const click = (element, x, y) => {
    const { left, top } = element.getBoundingClientRect();
    for (const type of ["pointerdown", "pointerup"]) {
      const place = { clientX: left + x, clientY: top + y, pointerId: 1, bubbles: true };
      element.dispatchEvent(new PointerEvent(type, place));
    }
    page.draw();
  };
)";

/// As JSON without characters that the printed page would escape.
constexpr const char* kPutResult = R"(
  by_id("result").textContent = JSON.stringify(result).replace(
    /[<>&]/g, (c) => "\\u00" + c.charCodeAt(0).toString(16));
</script>
)";

class PageInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (browser().empty()) GTEST_SKIP() << "no chromium on this machine";
  }

  [[nodiscard]] json result_of(const FinishedRun& run, const std::string& script,
                               const std::string& address = "") const {
    return result_of(run_page(run), script, address);
  }

  /// Opens the page and runs a script after it. @return what it has put into `result`
  [[nodiscard]] json result_of(std::string page, const std::string& script,
                               const std::string& address = "") const {
    const std::string end = "</body>";
    page.insert(page.find(end),
                std::string("<pre id=\"result\"></pre><script type=\"module\">const result = {};") +
                    kHelpers + script + kPutResult);
    const std::filesystem::path file = folder_ / "run.html";
    test::put(file, page);
    const std::string dom = output_of(
        "HOME=" + folder_.path().string() + " timeout 60 " + browser() +
        " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --window-size=1200,800" +
        " --user-data-dir=" + (folder_ / "profile").string() + " --virtual-time-budget=3000" +
        " --dump-dom 'file://" + file.string() + address + "' 2>" + (folder_ / "log").string());
    const std::string begin = "<pre id=\"result\">";
    const std::size_t from = dom.find(begin);
    const std::size_t to = dom.find("</pre>", from);
    if (from == std::string::npos || to == from + begin.size()) {
      ADD_FAILURE() << "the script has no result: " << dom.substr(0, 2000);
      return json::object();
    }
    return json::parse(dom.substr(from + begin.size(), to - from - begin.size()));
  }

 private:
  test::TemporaryFolder folder_;
};

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
  EXPECT_EQ(result.at("held"), "1, 2");
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
  run.can_be_explained = true;
  const json result = result_of(run, R"(
    page.run.take({ kind: "why", vehicle: 2, steps: [[5, "did\n<b>stood</b>"]] });
    page.select(2);
    at(1);
    result.explained = row("why");
    at(1.2);
    result.other = row("why");
  )");
  EXPECT_EQ(result.at("explained"), "did\n<b>stood</b>");
  EXPECT_THAT(result.at("other"), HasSubstr("explain RUN --vehicle N --step K"));
}

TEST_F(PageInBrowser, ASelectedCarScrollsItsListOnly) {
  const json result = result_of(sample_run(20, 20), R"(
    const list = by_id("list");
    list.style.marginTop = "3000px";
    const aside = document.querySelector("aside");
    result.scrolled = [];
    for (const id of [20, 1]) {
      page.select(id);
      page.draw();
      result.scrolled.push(list.scrollTop > by_id("car_1").offsetTop, aside.scrollTop + window.scrollY);
    }
  )");
  EXPECT_EQ(result.at("scrolled"), json({true, 0, false, 0}));
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

TEST_F(PageInBrowser, TwentyCarsAreDrawnTwentyTimesASecond) {
  const json result = result_of(sample_run(20, 250), R"(
    at(1);
    const begin_ms = performance.now();
    for (let i = 0; i < 40; ++i) {
      at(0.2 * i + 20);
      by_id("map").getContext("2d").getImageData(0, 0, 1, 1); // waits for the drawing
    }
    result.frame_ms = (performance.now() - begin_ms) / 40;
  )");
  EXPECT_LT(result.at("frame_ms"), 50);
  RecordProperty("frame_ms", result.at("frame_ms").dump());
}

TEST_F(PageInBrowser, TheTimeLineScrubsBothWays) {
  const json result = result_of(sample_run(3, 20), R"(
    const x = () => page.map.place(page.run.vehicles[0], page.player.t).x;
    result.places = [];
    const line = by_id("time_line");
    for (const part of [0.5, 0.25]) {
      click(line, page.time_line.x_of(part * page.run.end_s), 5);
      result.places.push([page.player.t, x(), text("step")]);
    }
    by_id("scrub").value = "3";
    by_id("scrub").dispatchEvent(new Event("input"));
    page.draw();
    result.places.push([page.player.t, x(), text("step")]);
    press("ArrowRight");
    result.right = page.player.t;
    press("ArrowLeft");
    press("ArrowLeft");
    result.left = page.player.t;
    at(3.05);
    press("ArrowLeft");
    result.left_of_step = page.player.t;
    at(3.05);
    press("ArrowRight");
    result.right_of_step = page.player.t;
    press("End");
    press("ArrowRight");
    result.end = page.player.t;
    press("Home");
    press("ArrowLeft");
    result.begin = page.player.t;
  )");
  const json& places = result.at("places");
  EXPECT_NEAR(places.at(0).at(0), 2.0, 0.02);
  EXPECT_NEAR(places.at(1).at(0), 1.0, 0.02);
  EXPECT_NEAR(places.at(2).at(0), 3.0, 1e-9);
  EXPECT_NE(places.at(0).at(1), places.at(1).at(1));
  EXPECT_NE(places.at(0).at(1), places.at(2).at(1));
  EXPECT_EQ(places.at(2).at(2), "step 15 (0 to 19)");
  EXPECT_NEAR(result.at("right"), 3.2, 1e-9);
  EXPECT_NEAR(result.at("left"), 2.8, 1e-9);
  EXPECT_NEAR(result.at("left_of_step"), 3.0, 1e-9);
  EXPECT_NEAR(result.at("right_of_step"), 3.2, 1e-9);
  EXPECT_NEAR(result.at("end"), 4.0, 1e-9);
  EXPECT_EQ(result.at("begin"), 0.0);
}

TEST_F(PageInBrowser, AClickOnACarOfAStepShowsItsReportAndThePartner) {
  const json result = result_of(sample_run(3, 20), R"(
    at(0.2 * 8 + 0.1);
    const { x, y } = page.map.place(page.run.vehicles[1], page.player.t);
    click(by_id("map"), ...page.map.to_canvas([x, y]));
    result.title = text("report_title");
    result.state = row("state");
    result.waits = row("waits for");
    result.coupled = row("coupled with");
    result.missing = row("missing");
    document.querySelector('[data-row="coupled with"] button').click();
    page.draw();
    result.partner = text("report_title");
  )");
  EXPECT_EQ(result.at("title"), "Car 2 (car 2) in step 8");
  EXPECT_THAT(result.at("state"), StartsWith("keeps its plan: conflict with car 3"));
  EXPECT_THAT(result.at("waits"), HasSubstr("car 1"));
  EXPECT_THAT(result.at("coupled"), HasSubstr("car 1"));
  EXPECT_EQ(result.at("missing"), "none");
  EXPECT_THAT(result.at("partner"), StartsWith("Car 1 (red)"));
}

TEST_F(PageInBrowser, PlaysForwardsAndBackwardsAtAnySpeed) {
  const json result = result_of(sample_run(3, 20), R"(
    const { player } = page;
    const play = (direction, speed) => {
      Object.assign(player, { speed });
      player.play(direction);
      for (const now_ms of [1000, 1100, 1300]) player.advance(now_ms);
      player.play(0);
      return player.t;
    };
    result.times = [play(1, 1), play(1, 10), play(-1, 2)];
  )");
  EXPECT_NEAR(result.at("times").at(0), 0.3, 1e-9);
  EXPECT_NEAR(result.at("times").at(1), 3.3, 1e-9);
  EXPECT_NEAR(result.at("times").at(2), 2.7, 1e-9);
}

TEST_F(PageInBrowser, TwoFingersZoomAndAFollowedCarStaysInTheMiddle) {
  const json result = result_of(sample_run(3, 20), R"(
    const map = by_id("map");
    const { left, top } = map.getBoundingClientRect();
    const touch = (type, pointerId, x) => map.dispatchEvent(new PointerEvent(
      type, { clientX: left + x, clientY: top + 100, pointerId, bubbles: true }));
    const scale = page.map.scale;
    touch("pointerdown", 1, 100);
    touch("pointerdown", 2, 200);
    touch("pointermove", 2, 300);
    for (const finger of [1, 2]) touch("pointerup", finger, 100);
    result.zoom = page.map.scale / scale;
    result.selected = page.selected;
    page.select(3);
    page.set_follow(true);
    at(2);
    const { x, y } = page.map.place(page.run.vehicles[2], 2);
    const [on_x, on_y] = page.map.to_canvas([x, y]);
    result.aside = Math.hypot(on_x - map.clientWidth / 2, on_y - map.clientHeight / 2);
  )");
  EXPECT_NEAR(result.at("zoom"), 2.0, 1e-6);
  EXPECT_EQ(result.at("selected"), nullptr) << "it was no click";
  EXPECT_NEAR(result.at("aside"), 0.0, 1e-6);
}

TEST_F(PageInBrowser, AnAddressLeadsToAMomentAndACar) {
  const json result = result_of(sample_run(3, 20), R"(
    page.draw();
    result.t = page.player.t;
    result.title = text("report_title");
    result.theme = document.documentElement.dataset.theme;
  )",
                                "#t=1.4&car=3&theme=dark");
  EXPECT_NEAR(result.at("t"), 1.4, 1e-9);
  EXPECT_THAT(result.at("title"), StartsWith("Car 3"));
  EXPECT_EQ(result.at("theme"), "dark");
}

TEST_F(PageInBrowser, TheAddressFollowsTheMoment) {
  const json result = result_of(sample_run(3, 20), R"(
    page.select(3);
    at(2.4);
    await new Promise((done) => setTimeout(done, 1000));
    result.address = location.hash;
  )");
  EXPECT_EQ(result.at("address"), "#t=2.40&car=3");
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

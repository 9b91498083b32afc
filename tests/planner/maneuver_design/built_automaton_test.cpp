#include "planner/maneuver_design/built_automaton.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "planner/automaton/maneuver_check.hpp"
#include "planner/common/sha256.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::maneuver_design {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, with a copy of the shipped configuration reduced to J2.
class BuiltAutomaton : public testing::Test {
 protected:
  BuiltAutomaton() {
    write("car.yaml", configuration_text_);
    const AutomatonConfiguration configuration = read_automaton_configuration(folder_ / "car.yaml");
    file_ = file_of(configuration, build_automaton(configuration));
    automaton::write_automaton_file(file_, path_);
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string text() const {
    std::ifstream stream(path_, std::ios::binary);
    std::stringstream content;
    content << stream.rdbuf();
    return content.str();
  }

  /// What is error_text to the file with one piece replaced; with `forged`, the hash is made to
  /// fit.
  [[nodiscard]] std::string refusal(const std::string& piece, const std::string& replacement,
                                    bool forged) const {
    std::string edited = text();
    const std::size_t at = edited.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    edited.replace(at, piece.size(), replacement);
    if (forged) {
      const std::size_t first = edited.find('\n') + 1;
      const std::size_t second = edited.find('\n', first) + 1;
      const std::string rest = edited.substr(0, first) + edited.substr(second);
      edited =
          edited.substr(0, first) + "sha256: " + sha256_of(rest) + "\n" + edited.substr(second);
    }
    write("automaton.yaml", edited);
    return refusal();
  }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)read_current_automaton_file(path_);
    } catch (const std::invalid_argument& error) {
      std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos);
      for (std::size_t at; (at = message.find(folder_.path().string())) != std::string::npos;) {
        message.replace(at, folder_.path().string().size(), "DIR");
      }
      return message;
    }
    return "accepted";
  }

  const std::string configuration_text_ =
      R"(vehicle: {wheelbase_m: 0.15, rear_axle_to_cg_m: 0.075, length_m: 0.22, width_m: 0.107}
limits: {acceleration_mps2: 12, steering_rate_radps: 6.2, speed_min_mps: 0, speed_max_mps: 3.7, steering_max_rad: 0.62}
trims:
  - {speed_mps: 0, steering_rad: 0}
  - {speed_mps: 0.8, steering_rad: 0.12}
  - {speed_mps: 0.6, steering_rad: 0.36}
step_s: 0.2
criteria: [J2, {name: "half \"and\" half", weights: {J1: 1, J2: 1}, normalised: true}]
subgraphs:
  - {name: B, label: J2, trims: all}
  - {name: both, labels: [J2, "half \"and\" half"], trims: [1, 3, 2], max_speed_mps: 2.5, disabled_edges: [{from: 2, to: 3, label: J2}]}
)";
  const test::TemporaryFolder folder_;
  fs::path path_{folder_ / "automaton.yaml"};
  automaton::AutomatonFile file_;
};

TEST_F(BuiltAutomaton, WithOptimisedSelfLoopsReadsBackOnTheSameSubgraph) {
  for (const bool is_standstill_too : {false, true}) {
    SCOPED_TRACE(is_standstill_too);
    write("car.yaml", configuration_text_ + (is_standstill_too ? "own_steps: optimised_all\n"
                                                               : "own_steps: optimised\n"));
    const AutomatonConfiguration configuration = read_automaton_configuration(folder_ / "car.yaml");
    write_automaton_file(file_of(configuration, build_automaton(configuration)), path_);
    const automaton::AutomatonFile read = read_current_automaton_file(path_);
    const automaton::Subgraph subgraph(read.automaton, read.subgraphs.front());
    for (const TrimId trim : subgraph.trims()) {
      SCOPED_TRACE(trim.index + 1);
      const bool stands = !is_standstill_too && read.automaton->trims[trim.index].is_equilibrium();
      const automaton::Maneuver* own = read.automaton->find(trim, trim, "J2");
      EXPECT_EQ(own->label, stands ? automaton::kSelfLoopLabel : "J2");
      EXPECT_TRUE(std::ranges::any_of(subgraph.successors(trim), [own](const automaton::Edge& e) {
        return e.maneuver == own;
      }));
    }
  }
}

TEST_F(BuiltAutomaton, ReadsBackToTheSameBits) {
  const automaton::AutomatonFile read = read_current_automaton_file(path_);
  EXPECT_EQ(read.configuration_file, "car.yaml");
  EXPECT_EQ(read.configuration_sha256, file_.configuration_sha256);
  EXPECT_EQ(read.labels, file_.labels);
  EXPECT_EQ(read.subgraphs, file_.subgraphs);
  const automaton::UniversalAutomaton& a = *read.automaton;
  const automaton::UniversalAutomaton& b = *file_.automaton;
  EXPECT_EQ(a.trims, b.trims);
  EXPECT_EQ(a.unit_costs, b.unit_costs);
  EXPECT_EQ(a.step_s, b.step_s);
  ASSERT_EQ(a.maneuvers.size(), b.maneuvers.size());
  for (std::size_t i = 0; i < a.maneuvers.size(); ++i) {
    EXPECT_EQ(a.maneuvers[i].from, b.maneuvers[i].from);
    EXPECT_EQ(a.maneuvers[i].to, b.maneuvers[i].to);
    EXPECT_EQ(a.maneuvers[i].label, b.maneuvers[i].label);
    EXPECT_EQ(a.maneuvers[i].inputs, b.maneuvers[i].inputs);
    EXPECT_EQ(a.maneuvers[i].states, b.maneuvers[i].states);
    EXPECT_EQ(a.maneuvers[i].displacement, b.maneuvers[i].displacement);
    EXPECT_EQ(a.maneuvers[i].swept_area_m, b.maneuvers[i].swept_area_m);
    EXPECT_EQ(a.maneuvers[i].lane_area_m, b.maneuvers[i].lane_area_m);
    EXPECT_EQ(a.maneuvers[i].criteria, b.maneuvers[i].criteria);
  }
  EXPECT_EQ(automaton::to_text(read), text());
}

TEST_F(BuiltAutomaton, TheSameConfigurationGivesTheSameFileByteForByte) {
  const std::string before = text();
  write("car.yaml", "# A comment, and other spelling, make no difference.\n" + configuration_text_);
  const AutomatonConfiguration again = read_automaton_configuration(folder_ / "car.yaml");
  automaton::write_automaton_file(file_of(again, build_automaton(again)), path_);
  EXPECT_EQ(text(), before);
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(BuiltAutomaton, LeavesNothingBesideTheFile) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"automaton.yaml", "car.yaml"}));
  const std::string before = text();
  EXPECT_THROW(automaton::write_automaton_file(file_, folder_ / "no" / "automaton.yaml"),
               std::runtime_error);
  EXPECT_EQ(text(), before);
}

TEST_F(BuiltAutomaton, AnEditedFileIsRefusedWithTheCommandThatBuildsItAnew) {
  const std::string error_text = refusal("length_m: 0.22", "length_m: 0.21", false);
  EXPECT_EQ(error_text.substr(0, 26), "DIR/automaton.yaml:2: sha2");
  EXPECT_NE(error_text.find("must be the hash of the file's other lines: it was edited or damaged; "
                            "rebuild it: build_automaton DIR/car.yaml --out DIR/automaton.yaml"),
            std::string::npos)
      << error_text;
}

TEST_F(BuiltAutomaton, AStaleFileIsRefusedWithTheCommandThatBuildsItAnew) {
  std::string changed = configuration_text_;
  changed.replace(changed.find("acceleration_mps2: 12"), 21, "acceleration_mps2: 11");
  write("car.yaml", changed);
  EXPECT_EQ(
      refusal(),
      "DIR/automaton.yaml: stale, built from another state of DIR/car.yaml, must be built from its "
      "current state; rebuild it: build_automaton DIR/car.yaml --out DIR/automaton.yaml");
  fs::remove(folder_ / "car.yaml");
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(BuiltAutomaton, AFileThatBearsTheNameOfItsConfigurationIsNotTakenForIt) {
  const fs::path elsewhere = folder_ / "built";
  fs::create_directory(elsewhere);
  fs::copy_file(path_, elsewhere / "car.yaml");
  EXPECT_NO_THROW(static_cast<void>(read_current_automaton_file(elsewhere / "car.yaml")));
}

TEST_F(BuiltAutomaton, TheConfigurationOfWhichItIsLiesBesideIt) {
  const AutomatonConfiguration configuration = read_automaton_configuration(folder_ / "car.yaml");
  const std::string sha256 = configuration_sha256(configuration);
  EXPECT_EQ(configuration_sha256(read_configuration_of(folder_ / "car.yaml")), sha256);
  EXPECT_EQ(configuration_sha256(read_configuration_of(path_)), sha256);
  AutomatonConfiguration coarse = configuration;
  coarse.intervals = 10;
  automaton::write_automaton_file(file_of(configuration, build_automaton(coarse), 10), path_);
  EXPECT_EQ(read_configuration_of(path_).intervals, 10U);
  fs::remove(folder_ / "car.yaml");
  try {
    static_cast<void>(read_configuration_of(path_));
    FAIL() << "there is none";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("configuration car.yaml not found in its folder"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(BuiltAutomaton, TheCommandQuotesPathsThatAShellWouldTakeApart) {
  EXPECT_EQ(automaton::rebuild_command(file_, "my car/a.yaml", "it's $HOME.yaml"),
            "build_automaton 'it'\\''s $HOME.yaml' --out 'my car/a.yaml'");
  EXPECT_EQ(automaton::rebuild_command(file_, "a-b/c_1.yaml", "./d.yaml"),
            "build_automaton ./d.yaml --out a-b/c_1.yaml");
}

TEST_F(BuiltAutomaton, EveryValueOfTheConfigurationCounts) {
  const std::vector<std::pair<std::string, std::string>> changes{
      {"width_m: 0.107", "width_m: 0.108"},
      {"width_m: 0.107", "width_m: 0.107, safety_margin_m: 0.011"},
      {"width_m: 0.107", "width_m: 0.107, identified: {slip_gain_rad: 0.2}"},
      {"steering_max_rad: 0.62", "steering_max_rad: 0.63"},
      {"steering_rad: 0.36", "steering_rad: 0.37"},
      {"step_s: 0.2", "step_s: 0.25"},
      {"step_s: 0.2", "step_s: 0.2\nhorizon_steps: 7"},
      {"step_s: 0.2", "step_s: 0.2\nedges: all"},
      {"step_s: 0.2", "step_s: 0.2\nintervals: 21"},
      {"steering_max_rad: 0.62", "steering_max_rad: 0.62, friction_mps2: 90"},
      {"steering_max_rad: 0.62", "steering_max_rad: 0.62, curvature_max_per_m: 900"},
      {"J1: 1,", "J1: 2,"},
      {"normalised: true", "normalised: false"},
      {"name: B", "name: C"},
      {"max_speed_mps: 2.5", "max_speed_mps: 2.6"},
      {"label: J2}]", "label: J2}], rule: reachable"}};
  for (const auto& [piece, replacement] : changes) {
    std::string changed = configuration_text_;
    ASSERT_NE(changed.find(piece), std::string::npos) << piece;
    changed.replace(changed.find(piece), piece.size(), replacement);
    write("car.yaml", changed);
    EXPECT_NE(refusal().find("stale"), std::string::npos) << replacement << ": " << refusal();
  }
}

TEST_F(BuiltAutomaton, AnotherVersionIsRefusedWhateverItsKeysAre) {
  const std::string message =
      "DIR/automaton.yaml:1: automaton_schema = 2, must be 1; rebuild the file from its "
      "configuration: build_automaton CONFIG.yaml --out DIR/automaton.yaml";
  EXPECT_EQ(refusal("automaton_schema: 1", "automaton_schema: 2", true), message);
  write("automaton.yaml", "automaton_schema: 2\nbuilt_from: another.yaml\n");
  EXPECT_EQ(refusal(), message);
}

TEST_F(BuiltAutomaton, WhatTheVehicleCannotDriveIsRefusedEvenWithAHashThatFits) {
  const auto line_after = [this](const std::string& key) {  // first row of the first table
    const std::string all = text();
    const std::size_t begin = all.find('\n', all.find("label: \"J2\"", all.find("maneuvers:")));
    const std::size_t table = all.find('\n', all.find(key, begin)) + 1;
    return all.substr(table, all.find('\n', table) - table);
  };
  EXPECT_NE(refusal(line_after("inputs: |"), "      13 0", true)
                .find("1 -> 2: acceleration = 13 m/s^2, exceeds the limit"),
            std::string::npos);
}

// Each thing that `validate` promises, spoiled in a maneuver that is good.
TEST_F(BuiltAutomaton, EveryFaultOfAManeuverIsNoticed) {
  const automaton::UniversalAutomaton& automaton = *file_.automaton;
  for (const automaton::Maneuver& good : automaton.maneuvers) {
    ASSERT_EQ(automaton::validate(good, automaton), "");
    const auto fault = [&](auto spoil) {
      automaton::Maneuver spoiled = good;
      spoil(spoiled);
      return automaton::validate(spoiled, automaton);
    };
    EXPECT_EQ(fault([](automaton::Maneuver& m) { m.duration_s = 0.3; }),
              "duration must be the step");
    EXPECT_NE(fault([](automaton::Maneuver& m) { m.states.pop_back(); }), "");
    EXPECT_EQ(fault([](automaton::Maneuver& m) { m.states.front().pose.x_m = 1e-6; }),
              "begin must be the origin");
    EXPECT_EQ(fault([](automaton::Maneuver& m) { m.states.front().speed_mps += 1e-6; }),
              "begin must be its trim");
    EXPECT_EQ(fault([](automaton::Maneuver& m) { m.states.back().steering_rad += 1e-6; }),
              "end must be its trim");
    EXPECT_EQ(fault([](automaton::Maneuver& m) { m.displacement.x_m += 1e-9; }),
              "displacement must be the last pose");
    EXPECT_NE(fault([](automaton::Maneuver& m) { m.inputs[3].steering_rate_radps = 6.3; }), "");
    EXPECT_NE(fault([](automaton::Maneuver& m) { m.states[3].speed_mps = 3.8; }), "");
    EXPECT_NE(fault([](automaton::Maneuver& m) { m.states[3].steering_rad = -0.63; }), "");
    EXPECT_EQ(fault([](automaton::Maneuver& m) { m.states[3].pose.y_m += 1e-5; }),
              "integrated again, does not meet state 4");
    if (good.from != good.to) {
      EXPECT_EQ(fault([](automaton::Maneuver& m) { m.inputs[3].acceleration_mps2 *= 0.98; }),
                "integrated again, does not meet state 5");
    }
    const auto shrink = [](ConvexPolygon& area) {
      Point middle = Point::Zero();
      for (const Point& p : area.vertices_m) {
        middle += p / static_cast<double>(area.vertices_m.size());
      }
      for (Point& p : area.vertices_m) p = middle + 0.99 * (p - middle);
    };
    EXPECT_NE(fault([&](automaton::Maneuver& m) { shrink(m.swept_area_m); }).find("swept area"),
              std::string::npos);
    EXPECT_NE(fault([&](automaton::Maneuver& m) { shrink(m.lane_area_m); }).find("lane area"),
              std::string::npos);
    EXPECT_NE(fault([&](automaton::Maneuver& m) { m.swept_area_m = {}; }), "");
  }
}

TEST_F(BuiltAutomaton, AFileThatLacksWhatItsSubgraphsNeedIsRefused) {
  automaton::AutomatonFile lacking = file_;
  automaton::UniversalAutomaton automaton = *file_.automaton;
  automaton.maneuvers.pop_back();
  lacking.automaton = std::make_shared<const automaton::UniversalAutomaton>(automaton);
  automaton::write_automaton_file(lacking, path_);
  EXPECT_NE(
      refusal().find("possible with the maneuvers: subgraph 'both': the automaton holds no edge"),
      std::string::npos)
      << refusal();
  automaton.maneuvers.erase(automaton.maneuvers.begin());
  lacking.automaton = std::make_shared<const automaton::UniversalAutomaton>(automaton);
  automaton::write_automaton_file(lacking, path_);
  EXPECT_NE(refusal().find("the self-loop of every trim; that of trim 1 is missing"),
            std::string::npos);
}

TEST_F(BuiltAutomaton, ItIsToldFromAConfigurationByItsFirstLine) {
  EXPECT_TRUE(automaton::is_automaton_file(path_));
  EXPECT_FALSE(automaton::is_automaton_file(folder_ / "car.yaml"));
  EXPECT_FALSE(automaton::is_automaton_file(folder_ / "absent.yaml"));
}

TEST(Sha256, OfTheStandardsExample) {
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  Sha256 pieces;
  pieces.add("a");
  pieces.add("bc");
  EXPECT_EQ(pieces.hex(), sha256_of("abc"));
}

}  // namespace
}  // namespace hlc::maneuver_design

#include "planner/scenario/problem_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "planner/scenario/named_subgraph.hpp"
#include "planner/search/ompl/ompl_engine.hpp"
#include "planner/search/search_engine.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "tests/support/random_problem.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::scenario::problem_file_test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

const std::string kAutomaton = test::source_folder() + "/launch_scripts/automata/paper.yaml";

std::shared_ptr<const automaton::Subgraph> subgraph_b() {
  static const auto result = read_subgraph(
      kAutomaton, [](const auto& offered) -> const auto& { return *find_subgraph(offered, "B"); });
  return result;
}

/// Three steps straight ahead, with one square in the way of the last.
const std::string kHandWritten = R"({
  "automaton": "paper.yaml",
  "subgraph": "B",
  "horizon_steps": 3,
  "step_s": 0.2,
  "start": {"x": 1, "y": 2, "psi": 0, "trim": 7},
  "reference": [[1.16, 2], [1.32, 2], [1.48, 2]],
  "reference_speed": [1, 0.8, 0.8],
  "obstacles": [[], [], [[[3, 3], [3, 4], [4, 4], [4, 3]]]],
  "corridor": [[[0, 1], [9, 1]]]
})";

class ProblemFileTest : public testing::Test {
 protected:
  ProblemFileTest() {
    std::filesystem::copy_file(kAutomaton, folder_ / "paper.yaml",
                               std::filesystem::copy_options::overwrite_existing);
  }

  void put(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }

  /// The hand-written problem with one piece replaced.
  [[nodiscard]] static std::string with(const std::string& from, const std::string& to) {
    std::string text = kHandWritten;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  /// The error of reading; empty without error.
  [[nodiscard]] std::string error_of(const std::string& text) const {
    put(text);
    try {
      static_cast<void>(read_problem_file(file_, subgraph_b()));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] std::string error_with(const std::string& from, const std::string& to) const {
    return error_of(with(from, to));
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "problem.json";
};

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same_bits(const Point& a, const Point& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y());
}

void expect_same(const search::HorizonProblem& a, const search::HorizonProblem& b) {
  EXPECT_TRUE(same_bits(a.start.x_m, b.start.x_m));
  EXPECT_TRUE(same_bits(a.start.y_m, b.start.y_m));
  EXPECT_TRUE(same_bits(a.start.heading_rad, b.start.heading_rad));
  EXPECT_EQ(a.start_trim, b.start_trim);
  EXPECT_TRUE(std::ranges::equal(a.reference_m, b.reference_m,
                                 [](const Point& p, const Point& q) { return same_bits(p, q); }));
  EXPECT_TRUE(std::ranges::equal(a.contouring, b.contouring,
                                 [](const Point& p, const Point& q) { return same_bits(p, q); }));
  EXPECT_TRUE(std::ranges::equal(a.reference_speed_mps, b.reference_speed_mps,
                                 [](double p, double q) { return same_bits(p, q); }));
  ASSERT_EQ(a.obstacles_m.size(), b.obstacles_m.size());
  for (std::size_t j = 0; j < a.obstacles_m.size(); ++j) {
    EXPECT_EQ(a.obstacles_m[j], b.obstacles_m[j]);
  }
  ASSERT_EQ(a.boundary_m.size(), b.boundary_m.size());
  for (std::size_t i = 0; i < a.boundary_m.size(); ++i) {
    EXPECT_TRUE(same_bits(a.boundary_m[i].from_m, b.boundary_m[i].from_m));
    EXPECT_TRUE(same_bits(a.boundary_m[i].to_m, b.boundary_m[i].to_m));
  }
  EXPECT_EQ(a.avoids_steering_limit, b.avoids_steering_limit);
  EXPECT_EQ(a.incumbent, b.incumbent);
}

TEST_F(ProblemFileTest, WrittenProblemsReadBackToTheSameBits) {
  const auto subgraph = subgraph_b();
  const automaton::ReachableSets reachable(*subgraph, 8);
  const auto engine = search::make_search_engine(*subgraph, reachable, {});
  std::size_t with_incumbent = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    ProblemFile file{.automaton_file = folder_ / "paper.yaml", .subgraph = subgraph};
    file.problem = test::random_problem(*subgraph, 1 + test::pick(random, 8), random);
    file.problem.incumbent = engine->search(file.problem, search::never_stop).maneuvers;
    if (!file.problem.incumbent.empty()) ++with_incumbent;
    file.problem.avoids_steering_limit = test::pick(random, 2) == 0;
    file.problem.start.x_m = std::array{-0.0, 5e-324, 1e9, 0.1, -7.0}.at(test::pick(random, 5));
    file.search.engine =
        test::pick(random, 2) == 0 ? search::Engine::kBestFirst : search::Engine::kBranchAndBound;
    file.search.factory = test::pick(random, 2) == 0 ? search::make_ompl_engine : nullptr;
    file.search.max_expansions = 1 + test::pick(random, 1'000'000);
    if (seed % 2 == 0) file.search.criterion_weights = {{"J1", 0.1 / 3.0}, {"J2", 5e-324}};
    write_problem_file(file, file_);
    const ProblemFile read = read_problem_file(file_, subgraph);
    expect_same(read.problem, file.problem);
    EXPECT_EQ(read.automaton_file, file.automaton_file);
    EXPECT_EQ(read.search.engine, file.search.engine);
    EXPECT_EQ(read.search.factory, file.search.factory);
    EXPECT_EQ(read.search.criterion_weights, file.search.criterion_weights);
    EXPECT_EQ(read.search.cost_to_go, file.search.cost_to_go);
    EXPECT_EQ(read.search.max_expansions, file.search.max_expansions);
  }
  EXPECT_GT(with_incumbent, test::num_seeds(60) / 3);
}

TEST_F(ProblemFileTest, AHandWrittenFileIsGoodAndItsAutomatonLiesBesideIt) {
  put(kHandWritten);
  const ProblemFile file = read_problem_file(file_);
  EXPECT_EQ(file.automaton_file, folder_ / "paper.yaml");
  EXPECT_EQ(file.subgraph->spec().name, "B");
  EXPECT_EQ(file.problem.horizon_steps(), 3U);
  EXPECT_EQ(file.problem.start, (Pose{1.0, 2.0, 0.0}));
  EXPECT_EQ(file.problem.start_trim, TrimId{6});
  EXPECT_EQ(file.problem.reference_speed_mps, (std::vector{1.0, 0.8, 0.8}));
  EXPECT_EQ(file.problem.boundary_m.size(), 1U);
  EXPECT_EQ(file.search.max_expansions, search::SearchOptions{}.max_expansions);
}

TEST_F(ProblemFileTest, AClockwisePolygonIsTakenCounterClockwise) {
  put(kHandWritten);
  const auto read = [&] { return read_problem_file(file_, subgraph_b()).problem.obstacles_m[2]; };
  const std::vector<ConvexPolygon> clockwise = read();
  put(with("[[3, 3], [3, 4], [4, 4], [4, 3]]", "[[4, 3], [4, 4], [3, 4], [3, 3]]"));
  EXPECT_EQ(read(), clockwise);
}

TEST_F(ProblemFileTest, WhatMayBeAbsentMayBeAbsent) {
  put(R"({"automaton": "paper.yaml", "subgraph": "B", "horizon_steps": 1, "step_s": 0.2,
          "start": {"x": 0, "y": 0, "psi": 0, "trim": 1}, "reference": [[0, 0]]})");
  const ProblemFile file = read_problem_file(file_);
  EXPECT_TRUE(file.problem.obstacles_m.empty());
  EXPECT_TRUE(file.problem.boundary_m.empty());
  EXPECT_TRUE(file.problem.reference_speed_mps.empty());
  EXPECT_TRUE(file.problem.contouring.empty());
  EXPECT_TRUE(file.problem.incumbent.empty());
  EXPECT_NO_THROW(check_can_be_searched(file));
}

TEST_F(ProblemFileTest, AnotherAutomatonMayTakeThePlaceOfTheNamedOne) {
  put(with("paper.yaml", "gone.yaml"));
  EXPECT_THROW(static_cast<void>(read_problem_file(file_)), std::invalid_argument);
  EXPECT_NO_THROW(static_cast<void>(read_problem_file(file_, kAutomaton)));
}

TEST_F(ProblemFileTest, ErrorsNamePlaceValueAndWhatIsAllowed) {
  EXPECT_THAT(error_with(R"("y": 2)", R"("y": "2")"),
              HasSubstr(R"(problem.json: start.y = "2", must be a number)"));
  EXPECT_THAT(error_with(R"("y": 2)", R"("z": 2)"),
              HasSubstr("problem.json: start.z = 2, unknown key; known keys: x, y, psi, trim"));
  EXPECT_THAT(error_with(R"(, "psi": 0)", ""), HasSubstr("start.psi is missing"));
  EXPECT_THAT(error_with(R"("corridor")", R"("corridors")"),
              HasSubstr("corridors = [[[0,1],[9,1]]], unknown key"));
  EXPECT_THAT(error_with(R"("trim": 7)", R"("trim": 0)"),
              HasSubstr("start.trim = 0, must be a whole number >= 1 and <= 12"));
  EXPECT_THAT(error_with(R"("trim": 7)", R"("trim": 13)"), HasSubstr("start.trim = 13"));
  EXPECT_THAT(error_with(R"("trim": 7)", R"("trim": 6.5)"), HasSubstr("start.trim = 6.5"));
  EXPECT_THAT(error_with(R"("step_s": 0.2)", R"("step_s": 0.25)"),
              HasSubstr("step_s = 0.25, must be 0.2, the automaton's"));
  EXPECT_THAT(error_with(", [1.48, 2]]", "]"),
              HasSubstr("reference has 2 entries, must have one per step, 3 of them"));
  EXPECT_THAT(error_with("[1.48, 2]", "[1.48, 2, 0]"),
              HasSubstr("reference[2] has 3 entries, must have [x, y]"));
  EXPECT_THAT(error_with("[1, 0.8,", "[-1, 0.8,"),
              HasSubstr("reference_speed[0] = -1, must be a number >= 0"));
  EXPECT_THAT(error_with(R"("reference_speed")", R"("contouring": [[0, 9]], "reference_speed")"),
              HasSubstr("contouring has 1 entries, must have one per step, 3 of them"));
  EXPECT_THAT(error_with("[[], [], [", "[[], ["), HasSubstr("obstacles has 2 entries"));
  EXPECT_THAT(error_with(R"("horizon_steps": 3)", R"("horizon_steps": 65)"),
              HasSubstr("horizon_steps = 65, must be a whole number >= 1 and <= 64"));
  EXPECT_THAT(error_with(R"("horizon_steps": 3)", R"("horizon_steps": 3.0)"),
              HasSubstr("horizon_steps = 3.0"));
  EXPECT_THAT(error_with("[[0, 1], [9, 1]]", "[[0, 1], [9, 1], [9, 2]]"),
              HasSubstr("corridor[0] has 3 entries, must have [[x1, y1], [x2, y2]]"));
  EXPECT_THAT(error_with(R"("subgraph": "B")", R"("subgraph": "Z")"),
              HasSubstr(R"(subgraph = "Z", must be B)"));
  EXPECT_THAT(error_with(R"("corridor")", R"("subgraph": "B", "corridor")"),
              HasSubstr(R"(problem.json: subgraph = "B", duplicate key, must be unique)"));
  EXPECT_THAT(error_with("\"psi\": 0", R"("psi": 0, "x": 1)"),
              HasSubstr("problem.json: start.x = 1, duplicate key, must be unique"));
  EXPECT_THAT(
      error_with("\"corridor\"", R"("incumbent": [{}, {"trim": 1, "trim": 2}], "corridor")"),
      HasSubstr("problem.json: incumbent[1].trim = 2, duplicate key, must be unique"));
  EXPECT_THAT(error_with(R"("corridor")", R"("search": {"engine": "fast"}, "corridor")"),
              HasSubstr(R"(search.engine = "fast", must be one of branch_and_bound, best_first)"));
  EXPECT_THAT(error_with(R"("corridor")", R"("search": {"max_expansions": 0}, "corridor")"),
              HasSubstr("search.max_expansions = 0, must be a whole number >= 1"));
  EXPECT_THAT(
      error_with(R"("corridor")", R"("search": {"criterion_weights": {"J9": 1}}, "corridor")"),
      HasSubstr("search.criterion_weights.J9 = 1, must be criteria of the automaton's"));
  EXPECT_THAT(
      error_with(R"("corridor")", R"("search": {"criterion_weights": {"J2": -1}}, "corridor")"),
      HasSubstr("search.criterion_weights.J2 = -1, must be a number >= 0 and <= 1e+09"));
  EXPECT_THAT(error_with(R"("corridor")", R"("avoids_steering_limit": 1, "corridor")"),
              HasSubstr("avoids_steering_limit = 1, must be true or false"));
}

TEST_F(ProblemFileTest, ErrorsOfPolygonsSayWhatIsWrong) {
  const std::string square = "[[3, 3], [3, 4], [4, 4], [4, 3]]";
  EXPECT_THAT(error_with(square, "[[3, 3], [3, 4]]"),
              AllOf(HasSubstr("obstacles[2][0] = [[3,3],[3,4]]"), HasSubstr("at least 3")));
  EXPECT_THAT(error_with(square, "[[0, 0], [1, 1], [3, 3]]"), HasSubstr("with an area of"));
  EXPECT_THAT(error_with(square, "[[0, 0], [2, 0], [0.1, 0.1], [0, 2]]"),
              HasSubstr("its vertices in order: this one turns both left and right"));
  EXPECT_THAT(error_with(square, "[[0, 0], [1, 1], [1, 0], [0, 1]]"),
              HasSubstr("this one turns both left and right"))
      << "a bow tie";
  EXPECT_THAT(error_with(square, "[[0, 0], [1, 0], [1, 1], [0, 0]]"), HasSubstr("not repeated"));
  // A star of five points turns left at each of them, but twice around.
  EXPECT_THAT(error_with(square, "[[1, 0], [-0.8, 0.6], [0.3, -0.95], [0.3, 0.95], [-0.8, -0.6]]"),
              HasSubstr("its vertices in order: this one crosses itself"));
  EXPECT_EQ(error_with(square, "[[0, 0], [1, 0], [2, 0], [0, 2]]"), "")
      << "three on a line are fine";
}

TEST_F(ProblemFileTest, ErrorsOfAnIncumbentNameTheManeuver) {
  const auto incumbent = [&](const std::string& list) {
    return error_with(R"("corridor")", R"("incumbent": )" + list + R"(, "corridor")");
  };
  const std::string trim = R"({"trim": 7, "label": "trim"})";
  const std::string stop = R"({"trim": 1, "label": "J2"})";
  EXPECT_EQ(incumbent("[" + trim + "," + trim + "," + stop + "]"), "");
  EXPECT_THAT(incumbent("[" + trim + "," + stop + "]"), HasSubstr("incumbent has 2 entries"));
  EXPECT_THAT(incumbent("[" + trim + "," + stop + R"(, {"trim": 9, "label": "J1"}])"),
              HasSubstr("incumbent[2] = {\"trim\":9,\"label\":\"J1\"}, must be a maneuver of the "
                        "automaton from trim 1"));
}

TEST_F(ProblemFileTest, WhatIsNoJsonIsNamedWithItsPlace) {
  EXPECT_THAT(error_with("\"y\": 2", "\"y\": NaN"),
              AllOf(HasSubstr("problem.json: "), HasSubstr("line 6")));
  for (const std::string& text :
       {with("\"y\": 2", "\"y\": NaN"), with("\"y\": 2", "\"y\": -Infinity"), std::string(),
        kHandWritten + "{}", "// three steps\n" + kHandWritten, with("[9, 1]]]", "[9, 1]]],"),
        with("\"B\"", "\"\xff\""), "\"" + std::string(2'000'000, 'x')}) {
    const std::string error = error_of(text);
    EXPECT_THAT(error,
                AllOf(HasSubstr("problem.json: parse error at line "),
                      EndsWith(", must be one JSON object (RFC 8259)"), Not(HasSubstr("\n"))));
    EXPECT_LT(error.size(), 400 + file_.string().size());
  }
  EXPECT_THAT(error_of("[1]"), HasSubstr("problem.json: [1], must be an object"));
  std::filesystem::remove(file_);
  EXPECT_THROW(static_cast<void>(read_problem_file(file_, subgraph_b())), std::invalid_argument);
}

TEST_F(ProblemFileTest, ANumberThatNoDoubleHoldsIsNamedWithItsPlace) {
  const std::string allowed = ", must be a finite number";
  EXPECT_THAT(error_with("\"y\": 2", "\"y\": 1e999"),
              EndsWith("problem.json: line 6: start.y = 1e999" + allowed));
  EXPECT_THAT(error_with("\"step_s\": 0.2", "\"step_s\": -1e999\n"),
              EndsWith("problem.json: line 5: step_s = -1e999" + allowed));
  EXPECT_THAT(error_with("[1.32, 2]", "[" + std::string(2'000'000, '9') + ", 2]"),
              EndsWith("problem.json: line 7: reference[1][0] = " + std::string(60, '9') + "..." +
                       allowed));
  EXPECT_THAT(error_with("[4, 4]", "[4, 1e999]"),
              EndsWith("problem.json: line 9: obstacles[2][0][2][1] = 1e999" + allowed));
  EXPECT_THAT(
      error_with("\"corridor\"",
                 R"("incumbent": [{"trim": 1, "label": "J2"}, {"trim": 1e999}], "corridor")"),
      EndsWith("problem.json: line 10: incumbent[1].trim = 1e999" + allowed));
  EXPECT_THAT(error_of("[[], {}, 0, [1], 1e999]"),
              EndsWith("problem.json: line 1: [4] = 1e999" + allowed));
  EXPECT_THAT(error_of("1e999"), EndsWith("problem.json: line 1: a number = 1e999" + allowed));
}

TEST_F(ProblemFileTest, KeysAndValuesWithControlCharactersStayInOneLine) {
  EXPECT_THAT(error_with("step_s", "ste\\np\\u001b[31m"),
              HasSubstr("ste\\np\\x1b[31m = 0.2, unknown key; known keys: automaton"));
  EXPECT_THAT(error_with("\"y\": 2", "\"y\": \"\\n\\u001b\""),
              HasSubstr(R"(start.y = "\n\u001b", must be)"));
}

TEST_F(ProblemFileTest, ListsWithinListsWithinListsAreRefused) {
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_THAT(error_with("\"B\"", deep),
              AllOf(HasSubstr("problem.json: subgraph[0][0]"),
                    HasSubstr("[0]...: too deeply nested, must be <= 100 levels")));
  const auto lists = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_THAT(error_of(lists(101)), HasSubstr("problem.json: [0][0]"));
  EXPECT_THAT(error_of(lists(100)), HasSubstr(", must be an object"));
}

TEST_F(ProblemFileTest, AnAutomatonThatIsNoneIsNamedWithTheKey) {
  std::filesystem::copy_file(test::source_folder() + "/launch_scripts/scenarios/circle.yaml",
                             folder_ / "circle.yaml");
  for (const std::string name : {"nope.yaml", "", ".", "circle.yaml"}) {
    put(with("paper.yaml", name));
    try {
      static_cast<void>(read_problem_file(file_));
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("problem.json: automaton = \"" + name + "\""),
                                      HasSubstr(", must be ")));
    }
  }
}

TEST_F(ProblemFileTest, ASubgraphThatItsAutomatonDoesNotCarryIsNamedWithTheFile) {
  std::ifstream good(kAutomaton);
  std::string text((std::istreambuf_iterator<char>(good)), {});
  const std::string all = "label: J2, trims: all";
  ASSERT_NE(text.find(all), std::string::npos);
  // J1 is faster on its way than at its ends: the limit leaves the trims, but takes their edges.
  text.replace(text.find(all), all.size(), "label: J1, trims: [1, 7], max_speed_mps: 0.81");
  std::ofstream(folder_ / "cut.yaml") << text;
  const auto error = [this](const std::optional<std::filesystem::path>& automaton) {
    try {
      static_cast<void>(read_problem_file(file_, automaton));
    } catch (const std::invalid_argument& refusal) {
      return std::string(refusal.what());
    }
    return std::string();
  };
  const std::string reason = "subgraph 'B': no way from trim 7 to a trim of speed 0";
  put(with("paper.yaml", "cut.yaml"));
  EXPECT_THAT(error(std::nullopt),
              AllOf(HasSubstr("problem.json: automaton = \"cut.yaml\": "), EndsWith(reason)));
  put(kHandWritten);
  EXPECT_THAT(error(folder_ / "cut.yaml"), AllOf(HasSubstr("problem.json: with the automaton of "),
                                                 HasSubstr("cut.yaml: "), EndsWith(reason)));
}

TEST_F(ProblemFileTest, AHeadingIsLimitedLikeTheProblemsOwn) {
  EXPECT_EQ(error_with("\"psi\": 0", "\"psi\": -1e6"), "");
  EXPECT_THAT(error_with("\"psi\": 0", "\"psi\": 1000000.1"),
              EndsWith("a number >= -1e+06 and <= 1e+06"));
  EXPECT_THAT(error_with("\"psi\": 0", "\"psi\": 1e17"),
              HasSubstr("start.psi = 1e+17, must be a number >= -1e+06 and <= 1e+06"));
}

TEST_F(ProblemFileTest, DamagedFilesAreRefusedInOneLineOrRead) {
  std::size_t refused = 0;
  for (std::uint64_t seed = 0; seed < test::num_seeds(400); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::string text = kHandWritten;
    for (std::size_t i = 1 + test::pick(random, 3); i > 0; --i) {
      const std::size_t at = test::pick(random, text.size());
      switch (test::pick(random, 3)) {
        case 0:
          text.erase(at, 1 + test::pick(random, 6));
          break;
        case 1:
          text.insert(at, 1, "0123456789-.e[]{},:\" \ntfn\xff"[test::pick(random, 26)]);
          break;
        default:
          text[at] = static_cast<char>(test::pick(random, 256));
      }
    }
    const std::string error = error_of(text);
    EXPECT_THAT(error, Not(HasSubstr("\n")));
    if (error.empty()) continue;
    ++refused;
    EXPECT_THAT(error, HasSubstr("problem.json"));
  }
  EXPECT_GT(refused, test::num_seeds(400) / 2);
}

TEST_F(ProblemFileTest, NumbersThatAreNotFiniteAreNotWritten) {
  put(kHandWritten);
  ProblemFile file = read_problem_file(file_, subgraph_b());
  file.problem.start.x_m = std::numeric_limits<double>::infinity();
  EXPECT_THROW(static_cast<void>(to_text(file)), std::invalid_argument);
}

TEST_F(ProblemFileTest, TheCostToGoOf2022NeedsReferenceSpeeds) {
  put(with(R"("reference_speed": [1, 0.8, 0.8],)",
           R"("search": {"engine": "best_first", "cost_to_go": "2022"},)"));
  const ProblemFile file = read_problem_file(file_, subgraph_b());
  EXPECT_THROW(check_can_be_searched(file), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::scenario::problem_file_test

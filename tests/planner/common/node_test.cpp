#include "planner/common/node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace hlc {
namespace {

const char* const kText = R"(name: car
length_m: 0.22
doors: 4
open: false
vehicle:
  limits: {speed_mps: -1.0}
wheels:
  - {radius_m: 0.03}
  - {radius_m: wide}
numbers: [1, 2, x]
nothing:
)";

Node file() { return Node::parse_yaml(kText, "car.yaml"); }

/// Message of the error that `read` throws.
std::string message(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Node, ReadsFieldsOfTheirTypes) {
  const Node node = file();
  EXPECT_EQ(node.required<std::string>("name"), "car");
  EXPECT_EQ(node.required<double>("length_m", above(0.0)), 0.22);
  EXPECT_EQ(node.required<int>("doors"), 4);
  EXPECT_EQ(node.required<std::size_t>("doors"), 4U);
  EXPECT_EQ(node.required<double>("doors"), 4.0);
  EXPECT_FALSE(node.required<bool>("open"));
  EXPECT_EQ(node.optional("width_m", 0.1), 0.1);
  EXPECT_EQ(node.optional("length_m", 0.1), 0.22);
  EXPECT_EQ(node.map("vehicle").map("limits").required<double>("speed_mps"), -1.0);
  EXPECT_EQ(node.list("wheels").front().required<double>("radius_m"), 0.03);
  EXPECT_EQ(node.list("numbers")[1].as<int>(), 2);
  EXPECT_TRUE(node.optional_list("spares").empty());
  EXPECT_NO_THROW(node.optional_map("extras").check_no_unknown_keys());
}

TEST(Node, NamesFileLineWayValueAndWhatIsAllowed) {
  const Node node = file();
  EXPECT_EQ(message([&] { (void)node.required<int>("name"); }),
            "car.yaml:1: name = car, must be a whole number");
  EXPECT_EQ(message([&] { (void)node.required<int>("length_m"); }),
            "car.yaml:2: length_m = 0.22, must be a whole number");
  EXPECT_EQ(message([&] { (void)node.required<double>("length_m", between(1.0, 2.0)); }),
            "car.yaml:2: length_m = 0.22, must be a number >= 1 and <= 2");
  EXPECT_EQ(message([&] {
              (void)node.required<std::string>("name", one_of({"bus", "van"}));
            }),
            "car.yaml:1: name = car, must be one of bus, van");
  EXPECT_EQ(message([&] { (void)node.required<bool>("doors"); }),
            "car.yaml:3: doors = 4, must be true or false");
  EXPECT_EQ(message([&] {
              (void)node.map("vehicle").map("limits").required<double>("speed_mps", above(0.0));
            }),
            "car.yaml:6: vehicle.limits.speed_mps = -1.0, must be a number > 0");
  EXPECT_EQ(
      message([&] { (void)node.map("vehicle").map("limits").required<std::size_t>("speed_mps"); }),
      "car.yaml:6: vehicle.limits.speed_mps = -1.0, must be a whole number >= 0");
  EXPECT_EQ(message([&] { (void)node.list("wheels")[1].required<double>("radius_m"); }),
            "car.yaml:9: wheels[2].radius_m = wide, must be a number");
  EXPECT_EQ(message([&] { (void)node.list("numbers")[2].as<int>(); }),
            "car.yaml:10: numbers[3] = x, must be a whole number");
  EXPECT_EQ(message([&] { (void)node.required<double>("width_m", at_least(0.0)); }),
            "car.yaml:1: width_m is missing, must be a number >= 0");
  EXPECT_EQ(message([&] { (void)node.map("name"); }),
            "car.yaml:1: name = car, must be a map (key: value)");
  EXPECT_EQ(message([&] { (void)node.list("vehicle"); }),
            "car.yaml:5: vehicle = (a map), must be a list");
  EXPECT_EQ(message([&] { (void)node.required<std::string>("nothing"); }),
            "car.yaml:11: nothing = (nothing), must be text");
  EXPECT_EQ(message([&] { node.fail("doors", "fewer than wheels"); }),
            "car.yaml:3: doors = 4, must be fewer than wheels");
}

TEST(Node, RefusesNumbersThatAreNotFinite) {
  for (const char* const text : {"x: .nan", "x: .inf", "x: nan", "x: inf", "x: 1e999"}) {
    EXPECT_NE(message([&] { (void)Node::parse_yaml(text, "f").required<double>("x"); }), "no error")
        << text;
  }
}

TEST(Node, RefusesKeysThatNobodyAskedFor) {
  const Node node = Node::parse_yaml("a: 1\nb: 2\nd: 3\n", "f.yaml");
  (void)node.required<int>("a");
  (void)node.optional("b", 0);
  (void)node.optional("c", 0);
  EXPECT_EQ(message([&] { node.check_no_unknown_keys(); }),
            "f.yaml:3: d = 3, unknown key; known keys: a, b, c");
  (void)node.has("d");
  EXPECT_EQ(message([&] { node.check_no_unknown_keys(); }), "no error");
}

TEST(Node, RefusesTheSameKeyTwice) {
  EXPECT_EQ(message([] { (void)Node::parse_yaml("a: 1\nb: 2\na: 3\n", "f.yaml"); }),
            "f.yaml:3: a = 3, duplicate key, must be unique");
}

TEST(Node, RefusesWhatIsNotAReadableMap) {
  EXPECT_EQ(message([] { (void)Node::parse_yaml("a: 1\nb: [1", "f.yaml"); }).substr(0, 20),
            "f.yaml:2: not YAML: ");
  EXPECT_EQ(message([] { (void)Node::parse_yaml("", "f.yaml"); }),
            "f.yaml:1: (nothing), must be a map (key: value)");
  EXPECT_EQ(message([] { (void)Node::parse_yaml("[1, 2]", "f.yaml"); }),
            "f.yaml:1: (a list), must be a map (key: value)");
  EXPECT_EQ(message([] { (void)Node::read_yaml("no/such/file.yaml"); }),
            "no/such/file.yaml: cannot be read, must be a YAML file");
  EXPECT_EQ(message([] { (void)Node::read_yaml("/"); }), "/: cannot be read, must be a YAML file");
  for (const std::string device : {"/dev/null", "/dev/zero"}) {
    EXPECT_EQ(message([&device] { (void)Node::read_yaml(device); }),
              device + ": cannot be read, must be a YAML file");
  }
}

TEST(Node, ReadsAliasesButNoValueThatHoldsItself) {
  const Node node = Node::parse_yaml("a: &a [1, 2]\nb: *a\n", "f.yaml");
  EXPECT_EQ(node.list("b")[1].as<int>(), 2);
  EXPECT_EQ(message([] { (void)Node::parse_yaml("a: &a [*a, *a]\n", "f.yaml"); }),
            "f.yaml:1: a[1]: an alias of a value that holds it, must be of an earlier value");
}

TEST(Node, ReadsAliasesOfEveryKindOfValueAndOfKeys) {
  const Node node = Node::parse_yaml(
      "&k key: &m {x: 1, y: [2, &s three]}\ncopy: {inner: *m, *k : *s}\nlast: [*m, *k]\n",
      "f.yaml");
  EXPECT_EQ(node.map("copy").map("inner").list("y")[0].as<int>(), 2);
  EXPECT_EQ(node.map("copy").required<std::string>("key"), "three");
  EXPECT_EQ(node.list("last")[0].required<int>("x"), 1);
  EXPECT_EQ(node.list("last")[1].as<std::string>(), "key");
}

TEST(Node, NamesAKeyThatIsNoText) {
  EXPECT_EQ(Node::parse_yaml("? [a, {b: c}]\n: 1\nd: 2\n", "f.yaml").keys(),
            (std::vector<std::string>{"(no text)", "d"}));
}

// Each takes two bytes of the file, but a hundred and more in memory: with yaml-cpp's own tree,
// gigabytes.
TEST(Node, RefusesMoreTinyValuesThanMemoryIsTakenFor) {
  std::string text = "a: [";
  for (int i = 0; i < 4'100'000; ++i) text += i == 0 ? "1" : ",1";
  EXPECT_EQ(message([&] { (void)Node::parse_yaml(text + "]\n", "f.yaml"); }),
            "f.yaml:1: a[3999999]: too many values, must be <= 4000000");
}

TEST(Node, ReadsJsonLikeYamlButWithItsTypes) {
  const test::TemporaryFolder folder;
  test::put(folder / "car.json",
            R"({"name": "car", "length_m": 0.22, "open": true, "doors": [4, "5"]})");
  const Node node = Node::read_json(folder / "car.json");
  EXPECT_EQ(node.required<std::string>("name"), "car");
  EXPECT_EQ(node.required<double>("length_m", above(0.0)), 0.22);
  EXPECT_TRUE(node.required<bool>("open"));
  EXPECT_EQ(node.list("doors")[0].as<std::size_t>(), 4U);
  EXPECT_THAT(message([&] { (void)node.list("doors")[1].as<int>(); }),
              testing::EndsWith("car.json: doors[1] = \"5\", must be a whole number"));
  EXPECT_THAT(message([&] { (void)node.required<std::string>("length_m"); }),
              testing::EndsWith("car.json: length_m = 0.22, must be text"));
  EXPECT_THAT(message([&] { (void)node.list("doors", 3, "three"); }),
              testing::EndsWith("car.json: doors has 2 entries, must have three"));
}

TEST(Node, PrintsEveryValueAndKeyInOneShortLine) {
  const std::string longest(60, 'x');
  const Node node = Node::parse_yaml(
      "a: |\n  two\n  lines\nb: " + longest + "y\n\"k\\ney\": 1\n" + longest + "y: 2\n", "f.yaml");
  EXPECT_EQ(message([&] { (void)node.required<int>("a"); }),
            "f.yaml:1: a = two\\nlines\\n, must be a whole number");
  EXPECT_EQ(message([&] { (void)node.required<int>("b"); }),
            "f.yaml:4: b = " + longest + "..., must be a whole number");
  EXPECT_EQ(message([&] { node.check_no_unknown_keys(); }),
            "f.yaml:5: k\\ney = 1, unknown key; known keys: a, b");
  EXPECT_EQ(node.required<int>("k\ney"), 1);
  EXPECT_EQ(node.required<int>(longest + "y"), 2) << "keys are compared whole";
}

TEST(Node, TellsThePlaceOfAKey) {
  const Node vehicle = file().map("vehicle");
  EXPECT_EQ(vehicle.map("limits").place("speed_mps"),
            "car.yaml:6: vehicle.limits.speed_mps = -1.0");
  EXPECT_EQ(vehicle.place("limits"), "car.yaml:6: vehicle.limits = (a map)");
  EXPECT_EQ(vehicle.place("mass_kg"), "car.yaml:5: vehicle.mass_kg");
}

}  // namespace
}  // namespace hlc

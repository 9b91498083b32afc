// Holds the sources against the sizes that CONTRIBUTING.md allows. The kernel of branch and bound
// is exempt.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

constexpr std::size_t kMostLines = 400;
constexpr std::size_t kMostLinesOfAFunction = 60;
constexpr std::size_t kMostMembers = 15;
constexpr const char* kExempt = "planner/search/branch_and_bound/";

Lines lines_of(std::istream&& text) {
  Lines lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

void for_every_source(const std::function<void(const std::string& file, const Lines&)>& look) {
  const fs::path root = source_folder();
  std::size_t num_files = 0;
  for (const char* top : {"planner", "hlc_bridge", "vehicle_sim"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      const std::string file = entry.path().lexically_relative(root).generic_string();
      const bool is_source = extension == ".hpp" || extension == ".cpp" || extension == ".py";
      if (!is_source || file.starts_with(kExempt)) continue;
      ++num_files;
      look(file, lines_of(std::ifstream(entry.path())));
    }
  }
  EXPECT_GT(num_files, 300U);
}

struct Block {
  std::size_t first_line{};  ///< from 1
  std::size_t num_lines{};
  Lines lines;
};

/// What begins at a line of this indent and ends with a brace there, as clang-format leaves it.
std::vector<Block> blocks_at(const Lines& lines, std::size_t indent) {
  const std::string pad(indent, ' ');
  std::vector<Block> blocks;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (line.size() <= indent || !line.starts_with(pad)) continue;
    if (line[indent] == '}') {
      const auto first = lines.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = lines.begin() + static_cast<std::ptrdiff_t>(i);
      blocks.push_back({begin + 1, i + 1 - begin, Lines(first, last)});
    } else if (line[indent] != ' ' && line[indent] != '/' && line[indent] != '#') {
      begin = i;
    }
  }
  return blocks;
}

/// Functions of namespaces and of classes that are longer than allowed: their first lines.
std::vector<std::size_t> long_functions(const Lines& lines) {
  static const std::regex kType(R"(\s*(class|struct|union|enum|namespace|extern|template)\b.*)");
  std::vector<std::size_t> found;
  for (const std::size_t indent : {0U, 2U}) {
    for (const Block& block : blocks_at(lines, indent)) {
      const std::string& head = block.lines.front();
      const bool is_function =
          head.find('(') != std::string::npos && !std::regex_match(head, kType);
      if (is_function && block.num_lines > kMostLinesOfAFunction) found.push_back(block.first_line);
    }
  }
  return found;
}

/// Classes with more private data than allowed: their first lines.
std::vector<std::size_t> large_classes(const Lines& lines) {
  static const std::regex kMember(R"(  (?!.*\breturn\b)[^ ].*[\w>&*] \w+_(\{.*\}|\[.*\])?;.*)");
  static const std::regex kClass(R"((class|struct) .*)");
  std::vector<std::size_t> found;
  for (const Block& block : blocks_at(lines, 0)) {
    if (!std::regex_match(block.lines.front(), kClass)) continue;
    std::size_t num_members = 0;
    for (const std::string& line : block.lines) num_members += std::regex_match(line, kMember);
    if (num_members > kMostMembers) found.push_back(block.first_line);
  }
  return found;
}

TEST(HouseSizes, NoFileIsLongerThanAllowed) {
  for_every_source([](const std::string& file, const Lines& lines) {
    EXPECT_LE(lines.size(), kMostLines) << file;
  });
}

TEST(HouseSizes, NoFunctionIsLongerThanAllowed) {
  for_every_source([](const std::string& file, const Lines& lines) {
    for (const std::size_t line : long_functions(lines)) {
      ADD_FAILURE() << file << ":" << line << ": a function must be <= " << kMostLinesOfAFunction
                    << " lines";
    }
  });
}

TEST(HouseSizes, NoClassHasMoreMembersThanAllowed) {
  for_every_source([](const std::string& file, const Lines& lines) {
    for (const std::size_t line : large_classes(lines)) {
      ADD_FAILURE() << file << ":" << line << ": members must be <= " << kMostMembers;
    }
  });
}

TEST(HouseSizes, ALongFunctionIsNoticed) {
  const auto of = [](std::size_t num_lines, const std::string& head, const std::string& pad) {
    std::string text = pad + head + "\n";
    for (std::size_t i = 2; i < num_lines; ++i) text += pad + "  work();\n";
    return lines_of(std::istringstream(text + pad + "}\n"));
  };
  EXPECT_TRUE(long_functions(of(60, "int f(int a) {", "")).empty());
  EXPECT_EQ(long_functions(of(61, "int f(int a) {", "")), std::vector<std::size_t>{1});
  EXPECT_EQ(long_functions(of(61, "int f(int a) {", "  ")), std::vector<std::size_t>{1});
  EXPECT_TRUE(long_functions(of(61, "class F : public G<int(int)> {", "")).empty());
}

TEST(HouseSizes, ALargeClassIsNoticed) {
  const auto of = [](std::size_t num_members) {
    std::string text = "class F {\n public:\n  int a() const { return a_; }\n private:\n";
    for (std::size_t i = 0; i < num_members; ++i) text += "  std::map<int, int> a_{};  ///< what\n";
    return lines_of(std::istringstream(text + "};\n"));
  };
  EXPECT_TRUE(large_classes(of(15)).empty());
  EXPECT_EQ(large_classes(of(16)), std::vector<std::size_t>{1});
}

}  // namespace
}  // namespace hlc::test

// The program that draws pictures and videos of a run. Most is skipped on a machine without
// Chromium or ffmpeg.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/render/child_process.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kAt_s = 1.3;
constexpr std::size_t kWidth_px = 1280;
constexpr std::size_t kHeight_px = 720;

/// An affine map from the world [m] to the picture [px].
using Matrix = std::array<double, 6>;

struct Point {
  double x{};
  double y{};
};

Point mapped(const Matrix& m, const Point& p) {
  return {m[0] * p.x + m[2] * p.y + m[4], m[1] * p.x + m[3] * p.y + m[5]};
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const std::regex number(R"(-?[0-9.]+)");
  for (std::sregex_iterator match(text.begin(), text.end(), number), end; match != end; ++match) {
    numbers.push_back(std::stod(match->str()));
  }
  return numbers;
}

/// A car as the SVG has it.
struct DrawnCar {
  Point middle;  ///< [m]
  Matrix to_picture{};
};

/// @param colour  of the style sheet, as #rrggbb
DrawnCar car_in(const std::string& svg, const std::string& colour) {
  const std::regex body(R"re(d="(M[^"]*Z)" fill=")re" + colour +
                        R"re(" opacity="1" transform="matrix\(([^)]*)\))re");
  std::smatch match;
  EXPECT_TRUE(std::regex_search(svg, match, body)) << colour;
  const std::vector<double> corners = numbers_of(match[1]);
  const std::vector<double> matrix = numbers_of(match[2]);
  EXPECT_EQ(corners.size(), 8U);
  EXPECT_EQ(matrix.size(), 6U);
  DrawnCar car;
  for (std::size_t i = 0; i + 1 < corners.size(); i += 2) {
    car.middle.x += corners[i] / 4.0;
    car.middle.y += corners[i + 1] / 4.0;
  }
  std::ranges::copy(matrix, car.to_picture.begin());
  return car;
}

/// Colours of a picture, three bytes per px, row by row.
std::string pixels_of(const fs::path& picture) {
  const fs::path raw = picture.string() + ".raw";
  const std::string command = "ffmpeg -loglevel error -y -i " + picture.string() +
                              " -f rawvideo -pix_fmt rgb24 " + raw.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  return read_text(raw);
}

std::string colour_at(const std::string& pixels, const Point& at) {
  const auto x = static_cast<std::size_t>(std::lround(at.x));
  const auto y = static_cast<std::size_t>(std::lround(at.y));
  const std::string bytes = pixels.substr(3 * (y * kWidth_px + x), 3);
  std::string colour = "#";
  for (const char byte : bytes) colour += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return colour;
}

std::string video_facts(const fs::path& video) {
  FILE* pipe = popen(("ffprobe -v error -count_frames -of csv=p=0 -show_entries "
                      "stream=width,height,nb_read_frames:format=duration " +
                      video.string())
                         .c_str(),
                     "r");
  std::string text;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  pclose(pipe);
  return text;
}

/// Whether a process has this text in its command line: ffmpeg has `file:` before its path.
bool is_run(const std::string& text) {
  return std::ranges::any_of(fs::directory_iterator("/proc"), [&](const fs::directory_entry& one) {
    return read_text(one.path() / "cmdline").find(text) != std::string::npos;
  });
}

/// Three cars, 2 s of the paper's scenario.
class DrawRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    campaign = std::make_unique<TemporaryFolder>();
    const Outcome driven = run_program(
        "evaluate --scenario paper_three_cars --subgraphs B --starts 1 --steps 10 --keep_runs "
        "--scenario_folder " +
        source_folder() + "/launch_scripts/scenarios --out " + (*campaign / "runs").string());
    ASSERT_EQ(driven.exit_code, 0) << driven.output;
  }
  static void TearDownTestSuite() { campaign.reset(); }

  static bool can_draw() {
    return !render::path_of("chromium").empty() && !render::path_of("ffmpeg").empty();
  }
  static fs::path run() { return *campaign / "runs" / "runs" / "0"; }

  [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] Outcome draw(const std::string& flags) const {
    return run_program("draw_run " + run().string() + " " + flags);
  }
  /// @return path of the picture at kAt_s
  [[nodiscard]] fs::path drawn(const std::string& name, const std::string& flags = "") const {
    const Outcome outcome =
        draw(fmt::format("--at_s {} --out {} {}", kAt_s, file(name).string(), flags));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_EQ(outcome.output, "");
    return file(name);
  }

  /// Returns once it is being encoded; whatever it needs meanwhile is in this new folder.
  [[nodiscard]] ChildProcess begin_long_video(const fs::path& temporary) const {
    fs::create_directory(temporary);
    ::setenv("TMPDIR", temporary.c_str(), 1);
    ChildProcess program({build_folder() + "/bin/draw_run", run().string(), "--speed", "0.01",
                          "--video", file("run.mp4").string()},
                         file("log"));
    ::unsetenv("TMPDIR");
    EXPECT_TRUE(eventually(60s, [&] { return is_run("file:" + temporary.string()); }));
    return program;
  }

  TemporaryFolder folder_;

 private:
  inline static std::unique_ptr<TemporaryFolder> campaign;
};

TEST_F(DrawRun, ConflictZonesOfARunWithRightOfWayAreInThePictureByTheirNumbers) {
  if (!can_draw()) GTEST_SKIP() << "no chromium or no ffmpeg on this machine";
  const Outcome driven = run_program(
      "evaluate --scenario lab_cars --cars 2 --starts 1 --steps 5 --keep_runs --scenario_folder " +
      source_folder() + "/launch_scripts/scenarios --out " + file("runs").string());
  ASSERT_EQ(driven.exit_code, 0) << driven.output;
  const Outcome outcome =
      run_program(fmt::format("draw_run {} --at_s 0.5 --out {}",
                              (file("runs") / "runs" / "0").string(), file("frame.svg").string()));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(read_text(file("frame.svg")), HasSubstr("zone 1"));
}

TEST_F(DrawRun, TheCarsAreInBothKindsOfPicturesWhereTheyDrove) {
  if (!can_draw()) GTEST_SKIP() << "no chromium or no ffmpeg on this machine";
  const std::string svg = read_text(drawn("frame.svg"));
  const std::string pixels = pixels_of(drawn("frame.png"));
  ASSERT_EQ(pixels.size(), 3 * kWidth_px * kHeight_px);
  const record::RunFolder record = record::read_run_folder(run());
  const Nanoseconds at = *record.facts.first_step * record.facts.period +
                         static_cast<Nanoseconds>(std::llround(kAt_s * 1e9));
  const std::vector<std::string> colours{"#d55e00", "#0072b2", "#009e73"};  // red, blue, green
  for (std::uint8_t id = 1; id <= 3; ++id) {
    const auto& drive = record.drives.at(id);
    const auto sample = std::ranges::find(drive, at, &result::DrivenSample::t);
    ASSERT_NE(sample, drive.end());
    const DrawnCar car = car_in(svg, colours.at(id - 1U));
    const double px_per_m = car.to_picture[0];
    EXPECT_GT(px_per_m, 100.0);
    EXPECT_NEAR(car.middle.x, sample->pose.x_m, 1.0 / px_per_m);
    EXPECT_NEAR(car.middle.y, sample->pose.y_m, 1.0 / px_per_m);
    const Pose rear = compose(sample->pose, Pose{-0.07, 0.0, 0.0});
    EXPECT_EQ(colour_at(pixels, mapped(car.to_picture, {rear.x_m, rear.y_m})), colours.at(id - 1U));
  }
}

TEST_F(DrawRun, APictureHasTimeAndStatesInWords) {
  if (!can_draw()) GTEST_SKIP() << "no chromium or no ffmpeg on this machine";
  const std::string svg = read_text(drawn("frame.svg", "--vehicle_id 2 --dark"));
  EXPECT_THAT(svg, StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1280\""));
  for (const char* words : {">paper_three_cars<", ">1.30 s<", ">red: drives, 0.", ">planned<"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
}

TEST_F(DrawRun, APdfIsOnePageOfTheAskedSize) {
  if (!can_draw()) GTEST_SKIP() << "no chromium or no ffmpeg on this machine";
  const std::string pdf = read_text(drawn("frame.pdf", "--size 640x480"));
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 480 360]")) << "points of 1/72 inch";
  EXPECT_THAT(pdf, HasSubstr("/Count 1"));
}

TEST_F(DrawRun, AVideoHasTheAskedSizePicturesAndDuration) {
  if (!can_draw()) GTEST_SKIP() << "no chromium or no ffmpeg on this machine";
  for (const char* name : {"run.mp4", "run.gif"}) {
    const Outcome outcome =
        draw("--from_s 0.4 --to_s 1.4 --speed 0.5 --rate 10 --size 480x320 --video " +
             file(name).string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_EQ(video_facts(file(name)).substr(0, 16), "480,320,20\n2.000") << name;
  }
}

TEST_F(DrawRun, AnInterruptedOneLeavesNothing) {
  if (!can_draw()) GTEST_SKIP() << "no chromium or no ffmpeg on this machine";
  const fs::path temporary = file("temporary");
  ChildProcess program = begin_long_video(temporary);
  program.send(SIGINT);
  EXPECT_EQ(program.wait_for(60s), kExitInterrupted) << read_text(file("log"));
  EXPECT_TRUE(fs::is_empty(temporary));
  EXPECT_FALSE(fs::exists(file("run.mp4")));
  EXPECT_TRUE(eventually(60s, [&] { return !is_run(temporary.string()); }));
}

TEST_F(DrawRun, NeitherBrowserNorFfmpegOutlivesAKilledOne) {
  if (!can_draw()) GTEST_SKIP() << "no chromium or no ffmpeg on this machine";
  const fs::path temporary = file("temporary");
  ChildProcess program = begin_long_video(temporary);
  program.send(SIGKILL);
  EXPECT_TRUE(eventually(60s, [&] { return !is_run(temporary.string()); }));
  EXPECT_FALSE(fs::exists(file("run.mp4")));
}

TEST_F(DrawRun, FlagsAreRefusedInOneLine) {
  const std::string png = "--out " + file("frame.png").string() + " ";
  const std::string mp4 = "--video " + file("run.mp4").string() + " ";
  const std::vector<std::pair<std::string, std::string>> refused{
      {"", "--at_s and --out, or --video must be given"},
      {"--at_s 1", "--at_s requires --out"},
      {png, "--out requires --at_s"},
      {png + mp4 + "--at_s 1", "--at_s excludes --video"},
      {png + "--at_s 1 --speed 2", "--speed requires --video"},
      {png + "--at_s 2.1", "--at_s = 2.1, must be in 0 ... 2, the run's times"},
      {png + "--at_s nan", "--at_s = nan, must be in 0 ... 2, the run's times"},
      {"--at_s 1 --out frame.jpg", "--out = frame.jpg, must end in .png, .svg, .pdf"},
      {"--video run.avi", "--video = run.avi, must end in .mp4, .gif"},
      {mp4 + "--from_s 1 --to_s 1", "--from_s = 1, must be < --to_s = 1"},
      {mp4 + "--to_s 3", "--to_s = 3, must be in 0 ... 2, the run's times"},
      {mp4 + "--size 641x480", "641x480, must be WIDTHxHEIGHT, even numbers in 320 ... 4096"},
      {mp4 + "--vehicle_id 4", "--vehicle_id = 4, must be one of 1, 2, 3"},
  };
  for (const auto& [flags, line] : refused) {
    const Outcome outcome = draw(flags);
    EXPECT_EQ(outcome.exit_code, kExitBadInput) << flags;
    EXPECT_THAT(outcome.output, StartsWith("draw_run: "));
    EXPECT_THAT(outcome.output, HasSubstr(line + "\n"));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(DrawRun, AMissingProgramIsNamedWithItsPackage) {
  const char* const path = std::getenv("PATH");
  ASSERT_NE(path, nullptr);
  const std::string kept = path;
  ::setenv("PATH", "/nowhere", 1);
  const Outcome outcome = draw("--at_s 1 --out " + file("frame.png").string());
  ::setenv("PATH", kept.c_str(), 1);
  EXPECT_EQ(outcome.exit_code, kExitNotWritten);
  EXPECT_EQ(outcome.output,
            "draw_run: chromium is not installed: apt-get install chromium (Debian)\n");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

}  // namespace
}  // namespace hlc::test

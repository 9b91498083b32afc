// Draws a recorded run as its page shows it: a moment as a picture, or some time as a video.
#include <fmt/format.h>
#include <signal.h>
#include <sys/signalfd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/render/base64.hpp"
#include "hlc_bridge/render/browser.hpp"
#include "hlc_bridge/render/video.hpp"
#include "hlc_bridge/view/run_page.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/common/text_file.hpp"
#include "planner/road/lanelet_map.hpp"

namespace {

using nlohmann::json;

constexpr double kPxPerInch = 96.0;  // of the page
constexpr int kLeastPx = 320;
constexpr int kMostPx = 4096;

struct Size {
  int width_px{};
  int height_px{};
};

struct Choices {
  std::filesystem::path run;
  hlc::apps::OutputFile picture{.flag = "--out", .file = {}};
  hlc::apps::OutputFile video{.flag = "--video", .file = {}};
  std::optional<double> at_s;
  std::optional<double> from_s;
  std::optional<double> to_s;
  double speed{1.0};
  int frames_per_s{25};
  std::string size{"1280x720"};
  bool dark{};
  std::optional<int> follow;
};

/// Of "1280x720"; nothing for another text or size. Even, because H.264 is.
std::optional<Size> size_of(const std::string& text) {
  Size size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width_px);
  if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') return std::nullopt;
  const auto height = std::from_chars(width.ptr + 1, end, size.height_px);
  const auto is_good = [](int px) { return px >= kLeastPx && px <= kMostPx && px % 2 == 0; };
  const bool is_read = height.ec == std::errc{} && height.ptr == end;
  if (!is_read || !is_good(size.width_px) || !is_good(size.height_px)) return std::nullopt;
  return size;
}

void declare(CLI::App& app, Choices& choices) {
  hlc::apps::declare_run(app, choices.run);
  CLI::Option* const at =
      app.add_option("--at_s", choices.at_s,
                     "time of the picture, since the begin of the run; required without --video");
  CLI::Option* const out = hlc::apps::declare_output(
      app, choices.picture, "picture: .png, or .svg or .pdf, which keep sharp at any size");
  CLI::Option* const video = hlc::apps::declare_output(app, choices.video, "video: .mp4 or .gif");
  at->needs(out)->excludes(video);
  out->needs(at);
  app.add_option("--from_s", choices.from_s, "begin of the video; default: of the run")
      ->needs(video);
  app.add_option("--to_s", choices.to_s, "end of the video; default: of the run")->needs(video);
  app.add_option("--speed", choices.speed, "factor: 2 shows the cars twice as fast as they drove")
      ->check(hlc::apps::within(0.01, 100.0))
      ->capture_default_str()
      ->needs(video);
  app.add_option("--rate", choices.frames_per_s, "pictures per second of the video")
      ->check(hlc::apps::whole(1, 100))
      ->capture_default_str()
      ->needs(video);
  app.add_option("--size", choices.size, "WIDTHxHEIGHT, px; letters and lines grow with it")
      ->check(hlc::apps::allowing(
          [](const std::string& text) { return size_of(text).has_value(); },
          fmt::format("WIDTHxHEIGHT, even numbers in {} ... {}", kLeastPx, kMostPx), ""))
      ->capture_default_str();
  app.add_flag("--dark", choices.dark, "light on dark");
  app.add_option("--vehicle_id", choices.follow,
                 "of a car that stays in the middle, larger; default: none");
  hlc::apps::declare_help_end(
      app, {.examples = {"draw_run runs/my_run --at_s 7.4 --out frame.pdf",
                         "draw_run runs/my_run --video run.mp4 --from_s 4 --to_s 12 --speed 0.5 "
                         "--vehicle_id 2 --dark"},
            .exit_codes = "0 success, 1 chromium or ffmpeg is missing or failed, 2 invalid input "
                          "or an output that cannot be written, 130 interrupted"});
}

/// @throws std::invalid_argument naming the flag
void check_ending(const hlc::apps::OutputFile& output, const std::vector<std::string>& allowed) {
  if (!output.file ||
      std::ranges::find(allowed, output.file->extension().string()) != allowed.end())
    return;
  throw std::invalid_argument(fmt::format("{} = {}, must end in {}", output.flag,
                                          output.file->string(), fmt::join(allowed, ", ")));
}

struct Times {
  double begin_s{};
  double end_s{};
};

/// @throws std::invalid_argument naming the flag
double time_of(const char* flag, const std::optional<double>& given_s, double otherwise_s,
               const Times& run) {
  const double t_s = given_s.value_or(otherwise_s);
  if (t_s >= run.begin_s && t_s <= run.end_s) return t_s;
  throw std::invalid_argument(fmt::format("{} = {}, must be in {:.6g} ... {:.6g}, the run's times",
                                          flag, t_s, run.begin_s, run.end_s));
}

/// What is drawn: one time, if both are equal. @throws std::invalid_argument
Times times_of(const Choices& choices, const hlc::record::RunFolder& run) {
  if (run.rows.empty()) {
    throw std::invalid_argument(choices.run.string() + ": no step was reported, nothing to draw");
  }
  const auto num_steps = static_cast<double>(run.rows.back().step + 1);
  const Times all{.begin_s = 0.0, .end_s = num_steps * run.description.step_s};
  if (choices.at_s) {
    const double at_s = time_of("--at_s", choices.at_s, 0.0, all);
    return {.begin_s = at_s, .end_s = at_s};
  }
  const Times shown{.begin_s = time_of("--from_s", choices.from_s, all.begin_s, all),
                    .end_s = time_of("--to_s", choices.to_s, all.end_s, all)};
  if (shown.begin_s < shown.end_s) return shown;
  throw std::invalid_argument(
      fmt::format("--from_s = {}, must be < --to_s = {}", shown.begin_s, shown.end_s));
}

/// @throws std::invalid_argument naming the flag
void check_followed(const Choices& choices, const hlc::result::RunFacts& facts) {
  const auto is_followed = [&](int id) { return id == choices.follow; };
  if (!choices.follow || std::ranges::any_of(facts.vehicle_ids, is_followed)) return;
  throw std::invalid_argument(fmt::format("--vehicle_id = {}, must be one of {}", *choices.follow,
                                          fmt::join(facts.vehicle_ids, ", ")));
}

std::string page_of(hlc::record::RunFolder run) {
  hlc::view::FinishedRun page;
  if (run.scenario.map_file) page.map = hlc::road::read_lanelet_map(*run.scenario.map_file);
  page.description = std::move(run.description);
  page.facts = std::move(run.facts);
  page.rows = std::move(run.rows);
  page.drives = std::move(run.drives);
  page.show_guests();
  return hlc::view::picture_page(page);
}

/// The pictures of a run, drawn by its page in a browser.
class Pictures {
 public:
  Pictures(const Choices& choices, const std::string& page, int stop)
      : browser_(stop), size_(*size_of(choices.size)) {
    const std::filesystem::path file = browser_.folder() / "picture.html";
    hlc::write_file(file, page);
    browser_.open("file://" + file.string());
    const json chosen{{"width", size_.width_px},
                      {"height", size_.height_px},
                      {"theme", choices.dark ? "dark" : "light"},
                      {"follow", choices.follow ? json(*choices.follow) : json()},
                      {"speed", choices.speed}};
    static_cast<void>(browser_.value_of("picture.choose(" + chosen.dump() + ")"));
  }

  [[nodiscard]] std::string png(double t_s) {
    return hlc::render::bytes_of_base64(drawn("png", t_s).get<std::string>());
  }
  [[nodiscard]] std::string svg(double t_s) { return drawn("svg", t_s); }
  [[nodiscard]] std::string pdf(double t_s) {
    static_cast<void>(drawn("show", t_s));
    json paper{{"printBackground", true},
               {"paperWidth", size_.width_px / kPxPerInch},
               {"paperHeight", size_.height_px / kPxPerInch},
               {"pageRanges", "1"}};
    for (const char* side : {"Left", "Right", "Top", "Bottom"}) {
      paper[std::string("margin") + side] = 0;
    }
    const json printed = browser_.call("Page.printToPDF", paper);
    return hlc::render::bytes_of_base64(printed.at("data").get<std::string>());
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return browser_.folder(); }

 private:
  json drawn(const char* kind, double t_s) {
    return browser_.value_of(fmt::format("picture.{}({})", kind, t_s));
  }

  hlc::render::Browser browser_;
  Size size_;
};

void draw_moment(Pictures& pictures, const std::filesystem::path& file, double t_s) {
  const std::string kind = file.extension().string();
  hlc::write_file(file, kind == ".png"   ? pictures.png(t_s)
                        : kind == ".svg" ? pictures.svg(t_s)
                                         : pictures.pdf(t_s));
}

void draw_video(Pictures& pictures, const Choices& choices, const Times& times) {
  const std::filesystem::path& target = *choices.video.file;
  const std::filesystem::path file = pictures.folder() / ("video" + target.extension().string());
  const double duration_s = (times.end_s - times.begin_s) / choices.speed;
  const auto frames = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::llround(duration_s * choices.frames_per_s)));
  const hlc::apps::ProgressLine progress("picture", frames);
  hlc::render::Video video(file, choices.frames_per_s, pictures.folder() / "ffmpeg.log");
  for (std::size_t i = 0; i < frames; ++i) {
    const double since_s = static_cast<double>(i) / choices.frames_per_s * choices.speed;
    video.add(pictures.png(std::min(times.begin_s + since_s, times.end_s)));
    progress.show(i + 1);
  }
  video.finish();
  hlc::write_file(target, hlc::read_file(file));
}

/// SIGINT and the like make it readable instead of ending the program, which has to tidy up.
hlc::render::Descriptor stop_requests() {
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&signals, signal);
  ::sigprocmask(SIG_BLOCK, &signals, nullptr);
  ::signal(SIGPIPE, SIG_IGN);  // a program that has ended is an error of the writing
  return hlc::render::Descriptor(::signalfd(-1, &signals, SFD_CLOEXEC));
}

/// Returns the exit code.
int draw(const Choices& choices) {
  const hlc::render::Descriptor stop = stop_requests();
  check_ending(choices.picture, {".png", ".svg", ".pdf"});
  check_ending(choices.video, {".mp4", ".gif"});
  hlc::apps::check_output_files({choices.picture, choices.video},
                                {choices.run / "run.json", choices.run / "reports.csv"});
  hlc::record::RunFolder run = hlc::record::read_run_folder(choices.run);
  const Times times = times_of(choices, run);
  check_followed(choices, run.facts);
  try {
    Pictures pictures(choices, page_of(std::move(run)), stop.number());
    if (choices.video.file) {
      draw_video(pictures, choices, times);
    } else {
      draw_moment(pictures, *choices.picture.file, times.begin_s);
    }
    return hlc::kExitGood;
  } catch (const hlc::render::Fault& fault) {
    hlc::apps::complain("draw_run", fault.what());
    return hlc::kExitNotWritten;
  } catch (const hlc::render::Stopped&) {
    return hlc::kExitInterrupted;
  }
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Draws a run as its page shows it: a moment as a picture (--at_s, --out), or some time as a "
      "video (--video). Needs chromium, and ffmpeg for a video.",
      "draw_run"};
  Choices choices;
  declare(app, choices);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv,
                                               {{"--at", "--at_s"},
                                                {"--from", "--from_s"},
                                                {"--to", "--to_s"},
                                                {"--follow", "--vehicle_id"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("draw_run", [&] {
    if (!choices.at_s && !choices.video.file) {
      throw std::invalid_argument("--at_s and --out, or --video must be given");
    }
    return draw(choices);
  });
}

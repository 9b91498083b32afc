// Compares two run folders: how their starts differ, where the runs begin to differ and in what,
// the main numbers side by side.
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/record/start_differences.hpp"
#include "hlc_bridge/result/run_comparison.hpp"
#include "hlc_bridge/view/comparison_page.hpp"
#include "planner/apps/fitted_table.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/common/text_file.hpp"
#include "planner/road/lanelet_map.hpp"

namespace {

constexpr int kExitDifferent = 1;

hlc::result::ComparedRun compared(hlc::record::RunFolder run) {
  hlc::result::RunSummary summary =
      hlc::result::summarize(run.description, run.facts, run.rows, run.drives);
  return {.name = run.folder.string(),
          .summary = std::move(summary),
          .facts = std::move(run.facts),
          .rows = std::move(run.rows),
          .drives = std::move(run.drives),
          .incomplete = std::move(run.incomplete)};
}

std::optional<hlc::road::LaneletMap> map_of(const hlc::record::RunFolder& run) {
  if (!run.scenario.map_file) return std::nullopt;
  return hlc::road::read_lanelet_map(*run.scenario.map_file);
}

/// For the terminal: sentences up to the first empty line, then tables; without one, all as tables.
std::string fitted(const std::string& text) {
  const std::size_t tables = text.find("\n\n") + 1;
  return hlc::apps::fitted_lines(text.substr(0, tables)) +
         hlc::apps::fitted_table(text.substr(tables));
}

/// Returns the exit code.
int compare_runs(const std::filesystem::path& folder_a, const std::filesystem::path& folder_b,
                 const hlc::apps::OutputFile& html) {
  hlc::record::RunFolder a = hlc::record::read_run_folder(folder_a);
  hlc::record::RunFolder b = hlc::record::read_run_folder(folder_b);
  if (html.file && (html.file->extension() != ".html" || html.file->filename() == "run.html")) {
    throw std::invalid_argument("--html = " + html.file->string() +
                                ", must end in .html, and not be the run.html of a run");
  }
  hlc::apps::check_output_files({html});
  std::vector<std::string> started = hlc::record::start_differences(a, b);
  const auto map_a = html.file ? map_of(a) : std::nullopt;
  const auto map_b = html.file ? map_of(b) : std::nullopt;
  const hlc::result::RunComparison comparison =
      hlc::result::compare(compared(std::move(a)), compared(std::move(b)), std::move(started));
  if (html.file) hlc::write_file(*html.file, hlc::view::comparison_page(comparison, map_a, map_b));
  std::cout << fitted(hlc::result::comparison_text(comparison));
  return comparison.are_equal() ? hlc::kExitGood : kExitDifferent;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Compares two runs: how their starts differ, the first step and vehicle in which they differ "
      "and in what (reports, input, messages, plan), the main numbers side by side.",
      "compare"};
  std::filesystem::path run_a;
  std::filesystem::path run_b;
  hlc::apps::OutputFile html{.flag = "--html", .file = {}};
  app.add_option("RUN_A", run_a, "run folder")->required()->type_name("DIR");
  app.add_option("RUN_B", run_b, "run folder")->required()->type_name("DIR");
  hlc::apps::declare_output(app, html, "the same as a page, with a picture of both runs' paths");
  hlc::apps::declare_help_end(
      app, {.examples = {"compare runs/my_run runs/other_run",
                         "compare runs/my_run runs/other_run --html comparison.html"},
            .exit_codes = "0 the runs are equal, 1 they differ, 2 invalid input or an output that "
                          "cannot be written",
            .notes = "Measured times and how the runs were started do not count."});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("compare", [&] { return compare_runs(run_a, run_b, html); });
}

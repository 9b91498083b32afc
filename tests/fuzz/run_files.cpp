// Files of a run folder: the text is that of the file.
#include "hlc_bridge/mcap/indexed_file.hpp"
#include "hlc_bridge/mcap/merge.hpp"
#include "hlc_bridge/mcap/message_recorder.hpp"
#include "hlc_bridge/mcap/recorded_messages.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/drive_file.hpp"
#include "hlc_bridge/record/explanation_file.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "tests/fuzz/in_file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::fuzz {
namespace {

namespace fs = std::filesystem;

/// What `write` writes to a file.
std::string written(const std::function<void(const fs::path&)>& write) {
  const test::TemporaryFolder folder;
  write(folder / "file");
  return read_file(folder / "file");
}

std::string reports() {
  return written([](const fs::path& path) {
    std::mt19937_64 random(1);
    record::ReportFile file(path, [](const std::string&) {});
    for (int i = 0; i < 5; ++i) {
      auto record = dds::sample<ReportRecord>(random);
      record.report.waiting.since = record.report.step;
      file.append(record);
    }
    static_cast<void>(file.finish());
  });
}

std::string facts() {
  result::RunFacts facts{.vehicle_ids = {1, 2}, .period = 20'000'000, .steps = 7};
  facts.first_step = 3;
  facts.reason = "none";
  facts.died = {{"vehicle_1", "presence"}};
  return record::facts_json(facts);
}

std::string drive() {
  return std::string(record::kDriveHeading) +
         "\n0,1.5,-2,0.1,0.5,0.2,-0.1,0\n20000000,1.51,-2,0.1,0.5,0.2,-0.1,5\n";
}

const mcap::Schema kSchema{.name = "VehicleState", .encoding = "omgidl", .text = "struct x {};"};
const mcap::Channel kChannel{
    .schema = 1, .topic = "t", .encoding = "cdr", .metadata = {{"a", "b"}}};

/// As IndexedFile writes it: run.mcap.
std::string indexed() {
  return written([](const fs::path& path) {
    mcap::IndexedFile file(path);
    file.add(kSchema);
    file.add(kChannel);
    for (std::uint32_t i = 0; i < 3; ++i) {
      file.add(mcap::Message{.channel = 1, .sequence = i, .log_time = i, .payload = "payload"});
    }
    file.finish();
  });
}

/// As MessageRecorder writes it: messages/*.mcap.
std::string recorded() {
  std::string bytes(mcap::kMagic);
  mcap::append_header(bytes);
  mcap::append_schema(bytes, 1, kSchema);
  mcap::append_channel(bytes, 1, kChannel);
  mcap::append_message(bytes, {.channel = 1, .log_time = 5, .payload = "payload"});
  mcap::append_end(bytes);
  return bytes;
}

Target of_file(const std::string& name, const std::string& file,
               const std::function<void(const fs::path&)>& read, const std::string& sample) {
  return {name, [=](std::string_view bytes) { in_new_file(file, bytes, read); },
          [=] { return std::vector{sample}; }};
}

void merge(const fs::path& part) {
  const auto none = [](const auto&) { return std::vector<mcap::JsonChannel>{}; };
  static_cast<void>(mcap::merge({part}, none, part.parent_path() / "run.mcap"));
}

const fs::path kRun = "run/configuration";

}  // namespace

std::vector<Target> run_file_targets() {
  const auto folder_of = [](const fs::path& file) { return file.parent_path().parent_path(); };
  return {
      of_file(
          "facts", "run.json",
          [](const fs::path& file) { static_cast<void>(record::read_facts(file)); }, facts()),
      of_file(
          "reports", "reports.csv",
          [](const fs::path& file) { static_cast<void>(record::read_reports(file)); }, reports()),
      of_file(
          "drive", "vehicle_1.csv",
          [](const fs::path& file) { static_cast<void>(record::read_drive(file)); }, drive()),
      of_file(
          "explanations", "explanations.csv",
          [](const fs::path& file) {
            static_cast<void>(record::read_explanations(file.parent_path(), {}));
          },
          "step,vehicle,text\n"),
      of_file(
          "run_mcap", "run.mcap",
          [](const fs::path& file) { mcap::read_messages(file, [](const auto&, const auto&) {}); },
          indexed()),
      of_file("messages_mcap", "part.mcap", merge, recorded()),
      of_file(
          "flags", kRun / "flags.yaml",
          [folder_of](const fs::path& file) {
            static_cast<void>(record::kept_choices(folder_of(file)));
          },
          record::flags_yaml({.file = "/scenarios/circle.yaml"})),
      of_file(
          "forks", kRun / "forks.yaml",
          [folder_of](const fs::path& file) {
            const auto forks = record::kept_forks(folder_of(file));
            result::RunDescription description;
            record::add_obstacles(forks, description);
            static_cast<void>(record::forks_text(forks));
          },
          record::forks_yaml({{.from = 3, .set = {"obstacle=1,2,3,4", "without=2"}}})),
  };
}

}  // namespace hlc::fuzz

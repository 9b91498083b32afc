#include "hlc_bridge/process/lab_control_process.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/time/wall_time.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::process {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

dds::ParticipantOptions on_domain(const LabControlOptions& options, dds::DomainRole role,
                                  Shell<lab_control::LabControlMachine>& shell) {
  const bool lab = role == dds::DomainRole::kLab;
  return {.name = kLabControlName,
          .domain_id = lab ? options.lab_domain : options.controller_domain,
          .role = role,
          .transport = options.transport,
          .lease = options.time.lease,
          .discovery_server = lab ? options.discovery_server : std::nullopt,
          .peers = lab ? std::vector<std::string>{} : options.controller_peers,
          .version = options.version,
          .security = options.security,
          .on_loss = [](const std::string& line) { log(kLabControlName, machine::warning(line)); },
          .admits = [&shell](const auto& publisher,
                             std::size_t bytes) { return shell.admits(publisher, bytes); },
          .on_published = options.on_published};
}

std::optional<record::ReportFile> make_report_file(const std::filesystem::path& folder,
                                                   GrowingFile::OnFailure on_failure) {
  if (folder.empty()) {
    return std::nullopt;
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path file = folder / "reports.csv";
  if (error || std::filesystem::exists(file)) {
    throw std::invalid_argument("--out = " + folder.string() +
                                ", must be a folder that can be created and holds no reports.csv");
  }
  return std::optional<record::ReportFile>{std::in_place, file, std::move(on_failure)};
}

std::optional<record::CertificateFile> make_certificate_file(const std::filesystem::path& folder,
                                                             GrowingFile::OnFailure on_failure) {
  if (folder.empty()) return std::nullopt;
  return std::optional<record::CertificateFile>{std::in_place, folder / "certificates.csv",
                                                std::move(on_failure)};
}

}  // namespace

LabControlProcess::Writers::Writers(dds::Participant& lab, dds::Participant& controllers,
                                    std::function<void()> on_presence)
    : trigger(lab, dds::topics::system_trigger(), std::move(on_presence)),
      parameter(lab, dds::topics::parameter()),
      log(lab, dds::topics::log()),
      run_state(controllers, dds::topics::run_state()) {}

LabControlProcess::LabControlProcess(LabControlOptions options)
    : options_(std::move(options)),
      reports_(make_report_file(
          options_.out, [this](const std::string& line) { perform(machine::warning(line)); })),
      certificates_(make_certificate_file(
          options_.out, [this](const std::string& line) { perform(machine::warning(line)); })),
      progress_(stderr, options_.is_terminal),
      shell_(kLabControlName,
             lab_control::LabControlMachine(options_.make_run(options_.run),
                                            ProgressLine::interval(options_.is_terminal)),
             options_.time.make_pacing(options_.run.startup_timeout, time::wall_time_now())),
      lab_(on_domain(options_, dds::DomainRole::kLab, shell_),
           [this] { shell_.presence_changed(); }),
      controllers_(on_domain(options_, dds::DomainRole::kController, shell_),
                   [this] { shell_.presence_changed(); }),
      writers_(lab_, controllers_, [this] { shell_.presence_changed(); }),
      ready_reader_(lab_, dds::topics::ready_status(),
                    [this](const ReadyStatus& status) { shell_.post(status); }),
      request_reader_(lab_, dds::topics::parameter_request(),
                      [this](const ParameterRequest& request) { shell_.post(request); }),
      stop_reader_(
          lab_, dds::topics::stop_request(),
          [this](const StopRequest& request) { shell_.post(request); }, {}, dds::kItsController),
      report_reader_(
          controllers_, dds::topics::report(),
          [this](const ReportRecord& record) { shell_.post(record); }, {}, dds::kItsController) {
  if (shell_.machine().run().awaits_states()) listen_to_vehicles();
  record_facts();
}

/// Real time: a vehicle is present once a state has been received. While the run gathers, every
/// state counts, since a vehicle may leave and come back; later ones have no effect.
void LabControlProcess::listen_to_vehicles() {
  for (const std::uint8_t id : options_.run.all_ids()) {
    state_readers_.try_emplace(
        id, lab_, dds::topics::vehicle_state(id),
        [this](const VehicleState& state) {
          if (is_gathering_) shell_.post(state);
        },
        nullptr, dds::only(vehicle_name(id)));
  }
}

int LabControlProcess::run() {
  const int exit_code = shell_.run(*this);
  progress_.end_line();
  const bool are_complete = complete_records();
  log_result();
  return exit_code_with_outputs(exit_code, are_complete);
}

bool LabControlProcess::complete_records() {
  const std::optional<std::string> incomplete = reports_ ? reports_->finish() : std::nullopt;
  if (incomplete) perform(machine::warning(*incomplete));
  const std::optional<std::string> unproven = certificates_ ? certificates_->close() : std::nullopt;
  if (unproven) perform(machine::warning(*unproven));
  try {
    record_facts();
  } catch (const std::runtime_error& error) {
    perform(machine::warning(error.what()));
    return false;
  }
  return !incomplete && !unproven;
}

lab_control::LabControlPresence LabControlProcess::presence() const {
  machine::Participants both{.alive = lab_.alive(), .lost = lab_.lost()};
  both.alive.merge(controllers_.alive());
  both.lost.merge(controllers_.lost());
  return {.participants = std::move(both),
          .trigger_readers = {writers_.trigger.matched(), writers_.trigger.matched_names()}};
}

void LabControlProcess::perform(const ReportRecord& record) {
  if (reports_) reports_->append(record);
  if (certificates_) certificates_->append(record);
}

void LabControlProcess::perform(Log log) {
  log.stamp = time::real_time_now();
  writers_.log.write(log);
}

void LabControlProcess::perform(const RunState& state) {
  is_gathering_ = false;
  writers_.run_state.write(state);
}

void LabControlProcess::perform(const machine::LogLine& line) {
  progress_.end_line();
  log("", line);  // the name is the logger's
}

void LabControlProcess::log_result() {
  const lab_control::LabRunResult& result = shell_.machine().run().result();
  if (result.exit_code == kExitGood) {
    perform(machine::info(std::to_string(options_.run.steps) + " steps driven"));
  } else {
    perform(machine::error(result.reason));
  }
}

void LabControlProcess::record_facts() const {
  if (options_.out.empty()) {
    return;
  }
  const lab_control::LabRun& run = shell_.machine().run();
  const lab_control::LabRunResult& result = run.result();
  result::RunFacts facts;
  facts.simulated_time = run.releases_time();
  facts.vehicle_ids = options_.run.vehicle_ids;
  facts.period = options_.run.period;
  facts.steps = options_.run.steps;
  facts.first_step = result.first_step;
  facts.wall_s = static_cast<double>(result.wall) * kSecondsPerNanosecond;
  facts.clock_s = static_cast<double>(result.clock) * kSecondsPerNanosecond;
  facts.died = result.deaths;
  // Content of the file until the run has finished, also if it never does.
  facts.exit_code = run.finished() ? result.exit_code : kExitDied;
  facts.reason = run.finished() ? result.reason : "lab_control did not end the run";
  write_file(options_.out / "run.json", record::facts_json(facts));
}

}  // namespace hlc::process

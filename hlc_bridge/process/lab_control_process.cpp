#include "hlc_bridge/process/lab_control_process.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/lab_control/real_time_run.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"
#include "hlc_bridge/record/facts_file.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "hlc_bridge/time/real_timer.hpp"
#include "planner/common/text_file.hpp"

namespace hlc {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;
/// What does not complete a tick is read this late at most.
constexpr Nanoseconds kMailMayLie = 50'000'000;
constexpr std::chrono::milliseconds kLeaveTime{800};
constexpr std::chrono::milliseconds kHurriedLeaveTime{200};

ParticipantOptions on_domain(const LabControlOptions& options, DomainRole role) {
  const bool lab = role == DomainRole::kLab;
  return {
      .name = kLabControlName,
      .domain_id = lab ? options.lab_domain : options.controller_domain,
      .role = role,
      .transport = options.transport,
      .logical_time = options.logical_time,
      .discovery_server = lab ? options.discovery_server : std::nullopt,
      .peers = lab ? std::vector<std::string>{} : options.controller_peers,
      .version = options.version,
      .on_loss = [](const std::string& line) { spdlog::warn("{}: {}", kLabControlName, line); }};
}

std::unique_ptr<LabRun> make_run(const LabControlOptions& options) {
  if (options.logical_time) {
    return std::make_unique<LogicalRun>(options.run);
  }
  return std::make_unique<RealTimeRun>(options.run);
}

std::optional<ReportFile> make_report_file(const std::filesystem::path& folder) {
  if (folder.empty()) {
    return std::nullopt;
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path file = folder / "reports.csv";
  if (error || std::filesystem::exists(file)) {
    throw std::invalid_argument("--out = " + folder.string() +
                                ", must be a folder that can be made and holds no reports.csv");
  }
  return std::optional<ReportFile>{std::in_place, file};
}

}  // namespace

LabControlProcess::LabControlProcess(LabControlOptions options)
    : options_(std::move(options)),
      run_(make_run(options_)),
      reports_(make_report_file(options_.out)),
      progress_(stderr, options_.is_terminal),
      lab_(on_domain(options_, DomainRole::kLab),
           [this] { signal_.post([this] { presence_changed_ = true; }); }),
      controllers_(on_domain(options_, DomainRole::kController),
                   [this] { signal_.post([this] { presence_changed_ = true; }); }),
      trigger_writer_(lab_, topics::system_trigger(),
                      [this] { signal_.post([this] { presence_changed_ = true; }); }),
      parameter_writer_(lab_, topics::parameter()),
      log_writer_(lab_, topics::log()),
      run_state_writer_(controllers_, topics::run_state()),
      ready_reader_(
          lab_, topics::ready_status(),
          [this](const ReadyStatus& mail) { signal_.post([&] { mail_.emplace_back(mail); }); }),
      request_reader_(lab_, topics::parameter_request(),
                      [this](const ParameterRequest& mail) {
                        signal_.post([&] { mail_.emplace_back(mail); });
                      }),
      stop_reader_(
          lab_, topics::stop_request(),
          [this](const StopRequest& mail) { signal_.post([&] { mail_.emplace_back(mail); }); }),
      report_reader_(controllers_, topics::report(), [this](const ReportRecord& mail) {
        signal_.post([&] { mail_.emplace_back(mail); });
      }) {
  if (!options_.logical_time) {
    listen_to_vehicles();
  }
}

/// Real time: a vehicle is there when a state has come. While the run gathers, every state counts,
/// since a vehicle may leave and come back; later ones tell nothing new.
void LabControlProcess::listen_to_vehicles() {
  for (const std::uint8_t id : options_.run.vehicle_ids) {
    state_readers_.try_emplace(id, lab_, topics::vehicle_state(id),
                               [this](const VehicleState& mail) {
                                 signal_.post([&] {
                                   if (is_gathering_) mail_.emplace_back(mail);
                                 });
                               });
  }
}

void LabControlProcess::interrupt() {
  signal_.post([this] { interrupted_ = true; });
}

Nanoseconds LabControlProcess::now() const {
  if (!options_.logical_time) {
    return real_time_now();
  }
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<Nanoseconds>(std::chrono::nanoseconds(since_start).count());
}

int LabControlProcess::run() {
  record_facts();
  perform(run_->advance(now()));
  while (!run_->finished()) {
    wait_for_mail();
    read_mail();
    perform(run_->advance(now()));
    show_progress();
  }
  progress_.end_line();
  let_everybody_leave();
  read_mail();  // reports that came with the stop
  if (reports_) {
    reports_->finish();
  }
  record_facts();
  tell_result();
  return run_->result().exit_code;
}

void LabControlProcess::wait_for_mail() {
  // In logical time a tick's answers come one by one, and only the last of them matters.
  const std::size_t enough = std::max<std::size_t>(run_->answers_owed(), 1);
  const auto has_mail = [&] { return mail_.size() >= enough || presence_changed_ || interrupted_; };
  // Wake-up times and progress are in now()'s time; a wait in steps of at most an hour suffices.
  const Nanoseconds longest = enough > 1 ? kMailMayLie : 3600 * kNanosecondsPerSecond;
  const Nanoseconds wake = std::min(run_->wake_up(), progress_.next());
  const Nanoseconds from = now();
  const std::chrono::nanoseconds pause{std::min(wake - std::min(wake, from), longest)};
  static_cast<void>(signal_.wait_until(std::chrono::steady_clock::now() + pause, has_mail));
}

void LabControlProcess::read_mail() {
  const auto [mail, presence_changed, interrupted] = signal_.locked([this] {
    return std::tuple{std::exchange(mail_, {}), std::exchange(presence_changed_, false),
                      std::exchange(interrupted_, false)};
  });
  if (presence_changed) {
    look_who_is_there();
  }
  for (const Mail& item : mail) {
    std::visit([this](const auto& message) { read(message); }, item);
  }
  if (interrupted) {
    run_->interrupt();
  }
}

void LabControlProcess::read(const ReportRecord& record) {
  run_->report(record);
  if (reports_) {
    reports_->append(record);
  }
}

void LabControlProcess::read(const ParameterRequest& request) {
  if (request.name == kPeriodParameter) {
    const std::uint64_t period_ms = options_.run.period / kNanosecondsPerMillisecond;
    parameter_writer_.write({.name = request.name, .value = period_ms});
  } else if (request.name == kActiveIdsParameter) {
    const std::vector<std::uint8_t>& ids = options_.run.vehicle_ids;
    parameter_writer_.write(
        {.name = request.name, .value = std::vector<std::int32_t>(ids.begin(), ids.end())});
  }
}

void LabControlProcess::look_who_is_there() {
  std::set<std::string> alive = lab_.alive();
  alive.merge(controllers_.alive());
  std::set<std::string> lost = lab_.lost();
  lost.merge(controllers_.lost());
  run_->presence(alive, lost);
  run_->trigger_readers(trigger_writer_.matched_names());
}

void LabControlProcess::perform(const LabRunActions& actions) {
  for (const Death& death : actions.deaths) {
    progress_.end_line();
    spdlog::error("{} died: {}", death.process, death.sign);
    log_writer_.write({.id = kLabControlName,
                       .content = death.process + " died: " + death.sign,
                       .stamp = real_time_now(),
                       .level = 1});
  }
  for (const std::string& process : actions.returns) {
    progress_.end_line();
    spdlog::info("{} is back", process);
  }
  if (actions.run_state) {
    signal_.locked([this] { is_gathering_ = false; });
    if (!options_.logical_time && start_ == 0 && !actions.triggers.empty()) {
      start_ = actions.triggers.front();
    }
    run_state_writer_.write({.phase = *actions.run_state, .start = start_});
  }
  for (const Nanoseconds trigger : actions.triggers) {
    if (began_ == 0) {
      began_ = now();
    }
    trigger_writer_.write({.next_start = trigger});
  }
}

void LabControlProcess::show_progress() {
  const Nanoseconds wall = now();
  if (wall < progress_.next() || run_->finished()) {
    return;
  }
  if (run_->phase() == LabRun::Phase::kGathering) {
    progress_.update(wall, "waiting, " + run_->waiting_for());
    return;
  }
  const double period_s = static_cast<double>(options_.run.period) * kSecondsPerNanosecond;
  const double wall_s = static_cast<double>(wall - began_) * kSecondsPerNanosecond;
  const std::uint64_t steps = run_->steps_begun();
  progress_.update(
      wall, fmt::format("step {} of {}, {:.1f} s driven in {:.1f} s", steps, options_.run.steps,
                        static_cast<double>(steps) * period_s, wall_s));
}

/// Everybody has the stop symbol before the lab control is gone, and so leaves without alarm.
void LabControlProcess::let_everybody_leave() const {
  const bool in_a_hurry = run_->result().exit_code == kExitInterrupted;
  const auto deadline =
      std::chrono::steady_clock::now() + (in_a_hurry ? kHurriedLeaveTime : kLeaveTime);
  static_cast<void>(
      signal_.wait_until(deadline, [this] { return trigger_writer_.matched() == 0; }));
}

void LabControlProcess::tell_result() {
  const LabRunResult& result = run_->result();
  if (result.exit_code == kExitGood) {
    spdlog::info("{} steps driven", options_.run.steps);
  } else {
    spdlog::error("{}", result.reason);
  }
}

void LabControlProcess::record_facts() const {
  if (options_.out.empty()) {
    return;
  }
  const LabRunResult& result = run_->result();
  RunFacts facts;
  facts.simulated_time = options_.logical_time;
  facts.vehicle_ids = options_.run.vehicle_ids;
  facts.period = options_.run.period;
  facts.steps = options_.run.steps;
  facts.first_step = result.first_step;
  facts.wall_s = static_cast<double>(result.wall) * kSecondsPerNanosecond;
  facts.clock_s = static_cast<double>(result.clock) * kSecondsPerNanosecond;
  facts.died = result.deaths;
  // What stands in the file until the run has finished, and for ever if it does not.
  facts.exit_code = run_->finished() ? result.exit_code : kExitDied;
  facts.reason = run_->finished() ? result.reason : "lab_control did not end the run";
  write_file(options_.out / "run.json", facts_json(facts));
}

}  // namespace hlc

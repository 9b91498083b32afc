#include "tests/integration/forger.hpp"

#include <chrono>
#include <limits>
#include <list>
#include <memory>
#include <random>
#include <utility>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::test {
namespace {

using dds::DomainRole;
namespace topics = dds::topics;

constexpr Nanoseconds kFarFuture = std::numeric_limits<Nanoseconds>::max() / 2;

/// In the name of one vehicle, on its own topics and its middleware's domain.
class OfVehicle {
 public:
  OfVehicle(dds::Participant& lab, int local_domain, std::uint8_t id)
      : id_{id},
        local_{dds::on_loopback(kForger, local_domain, DomainRole::kLocal)},
        state_{lab, topics::vehicle_state(id)},
        vehicle_command_{lab, topics::vehicle_command(id)},
        list_{local_, topics::vehicle_state_list()},
        trigger_{local_, topics::system_trigger()},
        command_{local_, topics::command()} {}

  void publish(std::mt19937_64& random) {
    auto state = dds::sample<VehicleState>(random);
    state.vehicle_id = id_;
    state.create_stamp = time::real_time_now();
    state_.write(state);
    auto command = dds::sample<TrajectoryCommand>(random);
    command.vehicle_id = id_;
    command.create_stamp = time::real_time_now();
    vehicle_command_.write(command);
    command_.write(command);
    auto list = dds::sample<VehicleStateList>(random);
    list.t_now = time::real_time_now();
    list_.write(list);
    list.t_now = kFarFuture;
    list_.write(list);
    trigger_.write(SystemTrigger{kStopSymbol});
  }

 private:
  std::uint8_t id_;
  dds::Participant local_;
  dds::Writer<VehicleState> state_;
  dds::Writer<TrajectoryCommand> vehicle_command_;
  dds::Writer<VehicleStateList> list_;
  dds::Writer<SystemTrigger> trigger_;
  dds::Writer<TrajectoryCommand> command_;
};

/// In the name of all controllers, and of the lab control.
class OfAll {
 public:
  explicit OfAll(int lab_domain)
      : lab{dds::on_loopback(kForger, lab_domain, DomainRole::kLab)},
        controllers_{dds::on_loopback(kForger, lab_domain + 50, DomainRole::kController)} {}

  void publish(std::uint8_t id, std::uint64_t step, std::mt19937_64& random) {
    const VehicleId vehicle{id};
    auto traffic = dds::sample<coordination::Traffic>(random);
    traffic.vehicle = vehicle;
    traffic.step = {step};
    traffic_.write(traffic);
    auto prediction = dds::sample<coordination::Prediction>(random);
    prediction.vehicle = vehicle;
    prediction.step = {step};
    prediction_.write(prediction);
    outcome_.write({.vehicle = vehicle, .step = {step}, .wants_fallback = true});
    auto report = dds::sample<ReportRecord>(random);
    report.report.vehicle = vehicle;
    report.report.step = {step};
    report_.write(report);
    stop_request_.write({.vehicle_id = id});
    run_state_.write({.phase = RunPhase::kMinimalRiskStop});
    parameter_.write(dds::sample<Parameter>(random));
    trigger_.write(SystemTrigger{kStopSymbol});
  }

  dds::Participant lab;

 private:
  dds::Participant controllers_;
  dds::Writer<coordination::Traffic> traffic_{controllers_, topics::traffic()};
  dds::Writer<coordination::Prediction> prediction_{controllers_, topics::prediction()};
  dds::Writer<coordination::Outcome> outcome_{controllers_, topics::outcome()};
  dds::Writer<ReportRecord> report_{controllers_, topics::report()};
  dds::Writer<RunState> run_state_{controllers_, topics::run_state()};
  dds::Writer<StopRequest> stop_request_{lab, topics::stop_request()};
  dds::Writer<Parameter> parameter_{lab, topics::parameter()};
  dds::Writer<SystemTrigger> trigger_{lab, topics::system_trigger()};
};

}  // namespace

Forger::Forger(int lab_domain, std::vector<std::uint8_t> vehicle_ids)
    : thread_{[this, lab_domain, ids = std::move(vehicle_ids)] { publish(lab_domain, ids); }} {}

Forger::~Forger() {
  ends_ = true;
  thread_.join();
}

void Forger::publish(int lab_domain, const std::vector<std::uint8_t>& vehicle_ids) {
  constexpr std::chrono::milliseconds kPause{20};  // the rate, not a wait for anything
  std::mt19937_64 random(1);
  OfAll all(lab_domain);
  std::list<OfVehicle> vehicles;
  for (const std::uint8_t id : vehicle_ids) vehicles.emplace_back(all.lab, lab_domain + id, id);
  while (!ends_) {
    // In logical time steps begin with 0, in real time with the clock's.
    const std::uint64_t step =
        num_rounds_ % 2 == 0 ? num_rounds_ / 10
                             : static_cast<std::uint64_t>(time::real_time_now() / 200'000'000);
    for (const std::uint8_t id : vehicle_ids) all.publish(id, step, random);
    for (OfVehicle& vehicle : vehicles) vehicle.publish(random);
    ++num_rounds_;
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace hlc::test

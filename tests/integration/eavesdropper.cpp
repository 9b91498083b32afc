#include "tests/integration/eavesdropper.hpp"

#include <atomic>
#include <list>
#include <string>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/topics.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"

namespace hlc::test {
namespace {

using dds::DomainRole;
namespace topics = dds::topics;

dds::ParticipantOptions on(int domain, DomainRole role) {
  return dds::on_loopback("eavesdropper", domain, role);
}

}  // namespace

class Eavesdropper::Readers {
 public:
  Readers(int lab_domain, const std::vector<std::uint8_t>& vehicle_ids)
      : lab_{on(lab_domain, DomainRole::kLab)},
        controllers_{on(lab_domain + 50, DomainRole::kController)} {
    read(lab_, topics::ready_status(), "ready status");
    read(lab_, topics::system_trigger(), "trigger");
    read(lab_, topics::parameter(), "parameter");
    read(lab_, topics::stop_request(), "stop request");
    read(lab_, topics::log(), "log");
    read(controllers_, topics::traffic(), "traffic");
    read(controllers_, topics::prediction(), "prediction");
    read(controllers_, topics::outcome(), "outcome");
    read(controllers_, topics::report(), "report");
    read(controllers_, topics::run_state(), "run state");
    for (const std::uint8_t id : vehicle_ids) {
      read(lab_, topics::vehicle_state(id), "state");
      read(lab_, topics::vehicle_command(id), "command to a vehicle");
      dds::Participant& local = locals_.emplace_back(on(lab_domain + id, DomainRole::kLocal));
      read(local, topics::vehicle_state_list(), "state list");
      read(local, topics::system_trigger(), "trigger to a controller");
      read(local, topics::command(), "command to a middleware");
    }
  }

  [[nodiscard]] std::map<std::string, std::uint64_t> num_read() const {
    return {num_read_.begin(), num_read_.end()};
  }

 private:
  template <class Message>
  void read(dds::Participant& participant, const dds::Topic<Message>& topic,
            const std::string& kind) {
    std::atomic<std::uint64_t>& count = num_read_[kind];
    readers_.push_back(std::make_shared<dds::Reader<Message>>(
        participant, topic, [&count](const Message& /*message*/) { ++count; }));
  }

  std::map<std::string, std::atomic<std::uint64_t>> num_read_;
  dds::Participant lab_;
  dds::Participant controllers_;
  std::list<dds::Participant> locals_;
  std::vector<std::shared_ptr<void>> readers_;
};

Eavesdropper::Eavesdropper(int lab_domain, const std::vector<std::uint8_t>& vehicle_ids)
    : readers_{std::make_unique<Readers>(lab_domain, vehicle_ids)} {}

Eavesdropper::~Eavesdropper() = default;

std::map<std::string, std::uint64_t> Eavesdropper::num_read() const { return readers_->num_read(); }

}  // namespace hlc::test

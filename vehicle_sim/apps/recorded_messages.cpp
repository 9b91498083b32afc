#include "vehicle_sim/apps/recorded_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "hlc_bridge/dds/serialized.hpp"
#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/mcap/recorded_messages.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::apps {
namespace {

namespace topics = dds::topics;

class Collector {
 public:
  explicit Collector(const record::RunFolder& run, std::filesystem::path file)
      : run_(run), file_(std::move(file)) {}

  void take(const mcap::Channel& channel, const mcap::Message& message) {
    const std::string topic = channel.topic.substr(channel.topic.find('/') + 1);
    if (channel.encoding != "cdr") return;
    if (topic == topics::vehicle_state_list().name) {
      const auto publisher = channel.metadata.find("publisher");
      if (publisher == channel.metadata.end()) return;
      const auto list = read<VehicleStateList>(channel, message);
      const StepIndex step{step_at(list.t_now, run_.facts.period)};
      lists_[publisher->second].try_emplace(step, list);
    } else if (topic == topics::traffic().name) {
      add(read<coordination::Traffic>(channel, message), message, messages_.traffic);
    } else if (topic == topics::prediction().name) {
      add(read<coordination::Prediction>(channel, message), message, messages_.predictions);
    } else if (topic == topics::outcome().name) {
      add(read<coordination::Outcome>(channel, message), message, messages_.outcomes);
    } else if (topic == topics::automaton_request().name) {
      throw std::invalid_argument(file_.string() +
                                  ": an operator requested a subgraph, must be a run without");
    }
  }

  closed_loop::RecordedMessages result() && {
    if (lists_.empty()) {
      throw std::invalid_argument(file_.string() +
                                  ": has no state lists, must have those of our "
                                  "middleware (run_lab.sh --messages true)");
    }
    for (auto& [publisher, lists] : lists_) {
      for (const std::uint8_t id : served_by(publisher)) {
        for (const auto& [step, list] : lists) {
          messages_.lists.try_emplace({VehicleId{id}, step}, list);
        }
      }
    }
    return std::move(messages_);
  }

 private:
  template <class Message>
  [[nodiscard]] Message read(const mcap::Channel& channel, const mcap::Message& message) const {
    if (auto found = dds::message_from<Message>(message.payload)) return *std::move(found);
    throw std::runtime_error(fmt::format("{}: message {} of topic {} cannot be read",
                                         file_.string(), message.sequence, channel.topic));
  }

  template <class Message>
  static void add(Message message, const mcap::Message& recorded,
                  closed_loop::RecordedMessages::BySteps<Message>& messages) {
    const StepIndex step = message.step;
    messages.emplace(step, closed_loop::RecordedMessages::Published<Message>{
                               recorded.log_time, std::make_shared<Message>(std::move(message))});
  }

  /// Vehicles of the middleware with this name; the only one serves all.
  [[nodiscard]] std::vector<std::uint8_t> served_by(const std::string& publisher) const {
    if (lists_.size() == 1) return run_.facts.vehicle_ids;
    const std::vector<std::string> names = process_names(publisher);
    std::vector<std::uint8_t> ids;
    std::ranges::copy_if(run_.facts.vehicle_ids, std::back_inserter(ids), [&](std::uint8_t id) {
      return std::ranges::count(names, middleware_name(id)) > 0;
    });
    return ids;
  }

  const record::RunFolder& run_;
  std::filesystem::path file_;
  closed_loop::RecordedMessages messages_;
  std::map<std::string, std::map<StepIndex, VehicleStateList>> lists_;  ///< by publisher
};

}  // namespace

closed_loop::RecordedMessages read_recorded_messages(const record::RunFolder& run) {
  const std::filesystem::path file = run.folder / "run.mcap";
  if (!std::filesystem::exists(file)) {
    throw std::invalid_argument(
        file.string() + ": is missing, must be there for a run in real time (--messages true)");
  }
  Collector collector(run, file);
  mcap::read_messages(file, [&](const mcap::Channel& channel, const mcap::Message& message) {
    collector.take(channel, message);
  });
  return std::move(collector).result();
}

}  // namespace hlc::apps

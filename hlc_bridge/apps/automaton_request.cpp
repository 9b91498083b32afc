// Requests another subgraph from running controllers and prints their answers.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "planner/common/yaml_text.hpp"

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kExitRefused = 1;

struct Flags {
  hlc::apps::NetworkFlags network;
  std::optional<int> controller_domain;
  std::vector<std::string> controller_peers;
  std::vector<int> vehicles;
  std::vector<std::string> criteria;
  std::vector<std::string> weights;
  std::optional<double> max_speed_mps;
  std::vector<int> enable_trims;
  std::vector<int> disable_trims;
  std::vector<std::string> enable_edges;
  std::vector<std::string> disable_edges;
  double in_s{0.0};
  std::uint64_t valid_from_ns{0};
  double timeout_s{10.0};
  bool follow{false};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_ids", flags.vehicles, "vehicles to ask, e.g. 1,2; default: all")
      ->delimiter(',')
      ->check(hlc::apps::vehicle_id_range());
  auto* const criterion =
      app.add_option("--criteria", flags.criteria,
                     "labels of the maneuvers, e.g. J2, or J1,J2; default: the scenario's")
          ->delimiter(',');
  app.add_option("--weights", flags.weights,
                 "instead: maneuvers that are optimal for a weighted sum of criteria, e.g. "
                 "J1=0.3,J2=0.7; missing maneuvers are computed in the background; default: none")
      ->delimiter(',')
      ->excludes(criterion);
  app.add_option("--max_speed_mps", flags.max_speed_mps,
                 "speed limit [m/s]; default: the scenario's")
      ->check(hlc::apps::within(0.0, 100.0));
  const auto add_trims = [&app](const std::string& name, std::vector<int>& trims,
                                const std::string& what) {
    app.add_option(name, trims, what)->delimiter(',')->check(hlc::apps::whole(1, 100'000));
  };
  add_trims("--enable_trims", flags.enable_trims,
            "trims beside the scenario's, numbered from 1; default: none");
  add_trims("--disable_trims", flags.disable_trims,
            "trims of the scenario's that are not to be used; default: none");
  app.add_option("--enable_edges", flags.enable_edges,
                 "edges that the scenario disables, from:to, e.g. 2:3,3:2; default: none")
      ->delimiter(',');
  app.add_option("--disable_edges", flags.disable_edges,
                 "edges that are not to be used, from:to; default: none")
      ->delimiter(',');
  auto* const in_s = app.add_option("--in_s", flags.in_s, "real time: in force so much later")
                         ->capture_default_str()
                         ->check(hlc::apps::within(0.0, 3600.0));
  app.add_option("--valid_from_ns", flags.valid_from_ns,
                 "in force from this time of the run on, e.g. of the logical clock; 0: at once")
      ->capture_default_str()
      ->excludes(in_s);
  app.add_option("--timeout_s", flags.timeout_s,
                 "how long to wait for answers after the request's time")
      ->capture_default_str()
      ->check(hlc::apps::within(0.1, 3600.0));
  app.add_flag("--follow", flags.follow,
               "stay until stopped: controllers that appear later are asked, too, and every answer "
               "is printed");
  app.add_option("--controller_domain", flags.controller_domain,
                 "domain of the controllers; default: lab domain + 50");
  hlc::apps::declare_controller_peers(app, flags.controller_peers);
  flags.network.declare_network(app);
  hlc::apps::declare_help_end(
      app,
      {.examples = {"automaton_request --dds_domain 40 --transport loopback --vehicle_ids 2 "
                    "--max_speed_mps 0.5",
                    "automaton_request --dds_domain 40 --transport loopback --weights "
                    "J1=0.3,J2=0.7 --follow"},
       .exit_codes =
           "0 in force, 1 a controller refused, 2 invalid input, 3 a controller did not answer",
       .notes = "A request is a change of the scenario's subgraph, not of the last request: "
                "without any it is for the scenario's own, or the choice of the vehicle's "
                "policies. A zone's speed limit holds for every request."});
}

std::vector<hlc::TrimId> trims_of(const std::vector<int>& numbers) {
  std::vector<hlc::TrimId> trims;
  for (const int number : numbers) trims.push_back({static_cast<std::size_t>(number) - 1});
  return trims;
}

hlc::TrimId trim_of(const std::string& flag, const std::string& edge, std::string_view number) {
  std::size_t trim = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), trim);
  if (error != std::errc{} || end != number.data() + number.size() || trim == 0) {
    throw std::invalid_argument(flag + ": '" + hlc::one_line(edge) +
                                "', must be from:to with numbers of trims, from 1");
  }
  return {trim - 1};
}

std::vector<hlc::TrimPair> edges_of(const std::string& flag,
                                    const std::vector<std::string>& edges) {
  std::vector<hlc::TrimPair> pairs;
  for (const std::string& edge : edges) {
    const std::size_t colon = std::min(edge.find(':'), edge.size());
    const std::string_view text = edge;
    pairs.push_back({trim_of(flag, edge, text.substr(0, colon)),
                     trim_of(flag, edge, text.substr(std::min(colon + 1, edge.size())))});
  }
  return pairs;
}

std::vector<hlc::CriterionWeight> weights_of(const std::vector<std::string>& texts) {
  std::vector<hlc::CriterionWeight> weights;
  for (const std::string& text : texts) {
    const std::size_t equals = std::min(text.find('='), text.size());
    hlc::CriterionWeight one{.criterion = text.substr(0, equals)};
    const char* const begin = text.data() + std::min(equals + 1, text.size());
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), one.weight);
    if (one.criterion.empty() || error != std::errc{} || end != text.data() + text.size() ||
        !std::isfinite(one.weight) || one.weight < 0.0) {
      throw std::invalid_argument("--weights: '" + hlc::one_line(text) +
                                  "', must be criterion=number, number >= 0");
    }
    weights.push_back(std::move(one));
  }
  return weights;
}

hlc::SubgraphRequest subgraph_request(const Flags& flags) {
  return {.labels = flags.criteria,
          .weights = weights_of(flags.weights),
          .max_speed_mps = flags.max_speed_mps,
          .enable_trims = trims_of(flags.enable_trims),
          .disable_trims = trims_of(flags.disable_trims),
          .enable_edges = edges_of("--enable_edges", flags.enable_edges),
          .disable_edges = edges_of("--disable_edges", flags.disable_edges)};
}

hlc::dds::ParticipantOptions participant_options(const Flags& flags) {
  hlc::dds::check_domain_id("--dds_domain", flags.network.dds_domain);
  const int domain = flags.controller_domain
                         ? *flags.controller_domain
                         : hlc::dds::default_controller_domain(flags.network.dds_domain);
  hlc::dds::check_domain_id("--controller_domain", domain);
  hlc::dds::check_addresses("--controller_peers", flags.controller_peers);
  hlc::dds::ParticipantOptions options;
  options.name = "automaton_request";
  options.domain_id = domain;
  options.role = hlc::dds::DomainRole::kController;
  options.transport = hlc::dds::transport_from_name(flags.network.transport);
  options.peers = flags.controller_peers;
  options.version = hlc::apps::program_version();
  options.security = flags.network.security;
  return options;
}

const char* word_for(hlc::RequestOutcome outcome) {
  switch (outcome) {
    case hlc::RequestOutcome::kAccepted:
      return "accepted";
    case hlc::RequestOutcome::kInForce:
      return "in force";
    case hlc::RequestOutcome::kRefused:
      return "refused";
    case hlc::RequestOutcome::kStale:
      return "stale";
  }
  return "?";
}

/// One request and its answers.
class Asker {
 public:
  explicit Asker(const Flags& flags)
      : flags_(flags),
        subgraph_(subgraph_request(flags)),
        asked_(flags.vehicles.begin(), flags.vehicles.end()),
        participant_(participant_options(flags), [this] { signal_.notify(); }),
        writer_(participant_, hlc::dds::topics::automaton_request(), [this] { signal_.notify(); }),
        reader_(
            participant_, hlc::dds::topics::automaton_answer(),
            [this](const hlc::AutomatonAnswer& answer) {
              signal_.post([&] { answers_.push_back(answer); });
            },
            {}, hlc::dds::kItsController) {}

  int run() {
    if (!find_controllers()) return hlc::kExitMissing;
    ask();
    const auto deadline = Clock::now() + seconds(flags_.in_s + flags_.timeout_s);
    while (!stops() && (flags_.follow || (!is_settled() && Clock::now() < deadline))) {
      print_answers(flags_.follow ? Clock::now() + std::chrono::hours{1} : deadline);
    }
    return exit_code();
  }

  void stop() {
    signal_.post([this] { stop_ = true; });
  }

 private:
  static Clock::duration seconds(double time_s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_s));
  }

  [[nodiscard]] bool stops() const {
    return signal_.locked([this] { return stop_; });
  }

  /// Controllers that are matched in both directions. Without --vehicle_ids: all that are matched
  /// one second after the first one.
  bool find_controllers() {
    const auto all_matched = [this] {
      return stop_ || std::ranges::all_of(asked_, [this](int id) { return is_matched(id); });
    };
    const auto any_matched = [&] { return stop_ || writer_.matched() > 0; };
    const auto deadline = Clock::now() + seconds(flags_.timeout_s);
    const bool is_open = asked_.empty();
    const bool found = is_open ? signal_.wait_until(deadline, any_matched)
                               : signal_.wait_until(deadline, all_matched);
    if (is_open && found) {
      static_cast<void>(
          signal_.wait_until(Clock::now() + std::chrono::seconds{1}, [this] { return stop_; }));
      for (int id = 1; id <= static_cast<int>(hlc::kMaxLabVehicleId); ++id) {
        if (is_matched(id)) asked_.insert(id);
      }
    }
    if (found && !asked_.empty()) return true;
    report_missing();
    return false;
  }

  [[nodiscard]] bool is_matched(int id) const {
    const std::string name = hlc::controller_name(static_cast<std::uint8_t>(id));
    return writer_.matched_names().contains(name) && reader_.matched_names().contains(name);
  }

  void report_missing() const {
    std::vector<std::string> missing;
    for (const int id : asked_) {
      if (!is_matched(id)) missing.push_back(hlc::controller_name(static_cast<std::uint8_t>(id)));
    }
    if (missing.empty()) missing.emplace_back("any controller");
    std::cerr << fmt::format(
        "automaton_request: missing on domain {}: {} (see --dds_domain and --transport)\n",
        participant_.options().domain_id, fmt::join(missing, ", "));
  }

  void ask() {
    const hlc::Nanoseconds now = hlc::time::real_time_now();
    id_ = now;
    const auto in = static_cast<hlc::Nanoseconds>(1e9 * flags_.in_s);
    const hlc::Nanoseconds valid_from = in > 0 ? now + in : flags_.valid_from_ns;
    // Controllers that appear later are asked, too: the topic keeps the last request of every
    // vehicle.
    for (int id = 1; id <= static_cast<int>(hlc::kMaxLabVehicleId); ++id) {
      if (!flags_.vehicles.empty() && !asked_.contains(id)) continue;
      writer_.write({.vehicle = {static_cast<std::uint8_t>(id)},
                     .id = id_,
                     .valid_from = valid_from,
                     .subgraph = subgraph_});
    }
  }

  /// Waits until `until` at the latest and prints the answers received.
  void print_answers(Clock::time_point until) {
    static_cast<void>(signal_.wait_until(until, [this] { return stop_ || !answers_.empty(); }));
    const auto answers = signal_.locked([this] { return std::exchange(answers_, {}); });
    for (const hlc::AutomatonAnswer& answer : answers) {
      if (answer.id != id_) continue;  // to another request
      outcomes_[answer.vehicle.value] = answer.outcome;
      const std::string from = answer.outcome == hlc::RequestOutcome::kInForce
                                   ? fmt::format(" from step {}", answer.step.value)
                                   : "";
      std::cout << fmt::format("vehicle {}: {}{}: {}", answer.vehicle.value,
                               word_for(answer.outcome), from, answer.text)
                << std::endl;
    }
  }

  [[nodiscard]] bool is_settled() const {
    return std::ranges::all_of(asked_, [this](int id) {
      const auto found = outcomes_.find(id);
      return found != outcomes_.end() && found->second != hlc::RequestOutcome::kAccepted;
    });
  }

  [[nodiscard]] int exit_code() const {
    std::vector<int> silent;
    bool is_refused = false;
    for (const int id : asked_) {
      const auto found = outcomes_.find(id);
      if (found == outcomes_.end() || found->second == hlc::RequestOutcome::kAccepted) {
        silent.push_back(id);
      } else {
        is_refused = is_refused || found->second != hlc::RequestOutcome::kInForce;
      }
    }
    if (!silent.empty()) {
      std::cerr << fmt::format("automaton_request: no final answer from vehicles {}\n",
                               fmt::join(silent, ", "));
      return hlc::kExitMissing;
    }
    return is_refused ? kExitRefused : hlc::kExitGood;
  }

  Flags flags_;
  hlc::SubgraphRequest subgraph_;
  std::set<int> asked_;
  std::uint64_t id_{};
  std::map<int, hlc::RequestOutcome> outcomes_;  ///< the last of each vehicle

  hlc::time::Signal signal_;
  // Guarded by signal_:
  std::vector<hlc::AutomatonAnswer> answers_;
  bool stop_{};

  hlc::dds::Participant participant_;
  hlc::dds::Writer<hlc::AutomatonRequest> writer_;
  hlc::dds::Reader<hlc::AutomatonAnswer> reader_;
};

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{
      "Asks controllers to plan on another part of their automaton, while they drive.",
      "automaton_request"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv,
                                               {{"--vehicle", "--vehicle_ids"},
                                                {"--criterion", "--criteria"},
                                                {"--max_speed", "--max_speed_mps"}})) {
    return *code;
  }
  return hlc::apps::run_program(
      "automaton_request", signals,
      [&] {
        hlc::apps::check_each_once("--vehicle_ids", flags.vehicles);
        return std::make_shared<Asker>(flags);
      },
      [](Asker& asker) { asker.stop(); });
}

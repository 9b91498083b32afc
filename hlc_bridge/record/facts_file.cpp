#include "hlc_bridge/record/facts_file.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "planner/common/text_file.hpp"

namespace hlc::record {

std::string facts_json(const result::RunFacts& facts) {
  nlohmann::ordered_json json;
  json["simulated_time"] = facts.simulated_time;
  json["vehicle_ids"] = facts.vehicle_ids;
  json["period_ns"] = facts.period;
  json["steps"] = facts.steps;
  json["first_step"] = facts.first_step ? nlohmann::ordered_json(*facts.first_step) : nullptr;
  json["wall_s"] = facts.wall_s;
  json["clock_s"] = facts.clock_s;
  json["exit_code"] = facts.exit_code;
  json["reason"] = facts.reason;
  json["died"] = nlohmann::ordered_json::array();
  for (const Death& death : facts.died) {
    json["died"].push_back({{"process", death.process}, {"sign", death.sign}});
  }
  return json.dump(2) + "\n";
}

result::RunFacts read_facts(const std::filesystem::path& file) {
  const std::string text = read_file(file, kMostInputBytes);
  try {
    const auto json = nlohmann::json::parse(text);
    result::RunFacts facts;
    facts.simulated_time = json.at("simulated_time").get<bool>();
    facts.vehicle_ids = json.at("vehicle_ids").get<std::vector<std::uint8_t>>();
    facts.period = json.at("period_ns").get<Nanoseconds>();
    facts.steps = json.at("steps").get<std::uint64_t>();
    if (!json.at("first_step").is_null()) {
      facts.first_step = json.at("first_step").get<std::uint64_t>();
    }
    facts.wall_s = json.at("wall_s").get<double>();
    facts.clock_s = json.at("clock_s").get<double>();
    facts.exit_code = json.at("exit_code").get<int>();
    facts.reason = json.at("reason").get<std::string>();
    for (const auto& death : json.at("died")) {
      facts.died.push_back(
          {death.at("process").get<std::string>(), death.at("sign").get<std::string>()});
    }
    return facts;
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(file.string() + ": broken, must be as written by lab_control (" +
                             error.what() + ")");
  }
}

}  // namespace hlc::record

#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"
#include "hlc_bridge/view/page_json.hpp"

namespace hlc::view {

/// Numbers values in the order in which they appear.
template <class Value>
class Table {
 public:
  std::size_t number_of(const Value& value) {
    const auto [found, is_new] = numbers_.try_emplace(value, values_.size());
    if (is_new) values_.push_back(value);
    return found->second;
  }
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }

 private:
  std::map<Value, std::size_t> numbers_;
  std::vector<Value> values_;
};

/// Of the columns of messages `steps`, by name: the table of texts or lists into which they point,
/// and the unit in which they count. Both are a part of the message `run`.
[[nodiscard]] Json column_tables();
[[nodiscard]] Json column_units();

/// The messages `steps` of all vehicles of a run, and `maneuvers` with those that they point to.
class StepMessages {
 public:
  explicit StepMessages(const result::RunDescription& run)
      : subgraph_(run.automaton), conflicts_(run.conflicts) {}

  /// By step: a text about the plans of several vehicles together.
  using Together = std::map<std::uint64_t, std::string>;

  /// Message `steps`.
  /// @param rows      of that vehicle, by step
  /// @param together  about that vehicle and those that it is coupled with
  [[nodiscard]] Json of(VehicleId vehicle, std::span<const result::StepRecord* const> rows,
                        const Together& together = {});

  /// Message `maneuvers`: those that `of` numbered since the last call.
  [[nodiscard]] Json new_maneuvers();

 private:
  std::shared_ptr<const automaton::Subgraph> subgraph_;
  std::shared_ptr<const right_of_way::ConflictMap> conflicts_;
  Table<const automaton::Maneuver*> maneuvers_;
  std::size_t num_sent_{};
};

}  // namespace hlc::view

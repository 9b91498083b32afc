#include "planner/scenario/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

namespace hlc {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestShown = 60;

/// The value in one line, cut if it is long.
std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > kLongestShown) text = text.substr(0, kLongestShown) + " ...";
  return text;
}

/// "[json.exception.parse_error.101] parse error at line 3, column 1: ..." without the brackets.
std::string reason_of(const json::exception& error) {
  const std::string text = error.what();
  const auto end = text.find("] ");
  std::string reason = end == std::string::npos ? text : text.substr(end + 2);
  std::ranges::replace(reason, '\n', ' ');
  return reason;
}

}  // namespace

void JsonPlace::fail(const std::string& allowed) const {
  throw std::invalid_argument(*file_ + ": " + (place_.empty() ? "the whole" : place_) + " = " +
                              shown(*value_) + ", allowed " + allowed);
}

std::optional<JsonPlace> JsonPlace::find(const std::string& key) const {
  if (!value_->is_object()) fail("an object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonPlace(*file_, place_.empty() ? key : place_ + "." + key, *found);
}

JsonPlace JsonPlace::at(const std::string& key, const std::string& allowed) const {
  if (std::optional<JsonPlace> found = find(key)) return *found;
  throw std::invalid_argument(*file_ + ": " + (place_.empty() ? key : place_ + "." + key) +
                              " is missing, allowed " + allowed);
}

std::vector<std::string> JsonPlace::keys() const {
  if (!value_->is_object()) fail("an object");
  std::vector<std::string> result;
  for (const auto& [key, value] : value_->items()) result.push_back(key);
  return result;
}

void JsonPlace::check_keys(std::initializer_list<std::string_view> known) const {
  if (!value_->is_object()) fail("an object");
  for (const auto& [key, value] : value_->items()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    std::string allowed;
    for (const std::string_view one : known) {
      allowed += (allowed.empty() ? "" : ", ") + std::string(one);
    }
    throw std::invalid_argument(*file_ + ": unknown key " +
                                (place_.empty() ? key : place_ + "." + key) + ", allowed " +
                                allowed);
  }
}

std::vector<JsonPlace> JsonPlace::list(const std::string& allowed,
                                       std::optional<std::size_t> size) const {
  if (!value_->is_array()) fail(allowed);
  if (size && value_->size() != *size) {
    throw std::invalid_argument(*file_ + ": " + place_ + " has " + std::to_string(value_->size()) +
                                " entries, allowed " + allowed);
  }
  std::vector<JsonPlace> places;
  places.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) {
    places.emplace_back(*file_, place_ + "[" + std::to_string(i) + "]", (*value_)[i]);
  }
  return places;
}

double JsonPlace::number(double least, const std::string& allowed) const {
  if (!value_->is_number()) fail(allowed);
  const auto value = value_->get<double>();
  if (!std::isfinite(value) || value < least) fail(allowed);
  return value;
}

double JsonPlace::number() const {
  return number(std::numeric_limits<double>::lowest(), "a finite number");
}

std::size_t JsonPlace::whole(std::size_t least, std::size_t most) const {
  std::string allowed = "a whole number from " + std::to_string(least);
  if (most < std::numeric_limits<std::size_t>::max()) allowed += " to " + std::to_string(most);
  if (!value_->is_number_unsigned()) fail(allowed);
  const auto value = value_->get<std::size_t>();
  if (value < least || value > most) fail(allowed);
  return value;
}

std::string JsonPlace::text(const std::string& allowed) const {
  if (!value_->is_string()) fail(allowed);
  return value_->get<std::string>();
}

bool JsonPlace::truth() const {
  if (!value_->is_boolean()) fail("true, false");
  return value_->get<bool>();
}

nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path)) {
    throw std::invalid_argument(path.string() + ": cannot be read, allowed a JSON file");
  }
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto refuse_repeated = [&](int /*depth*/, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key &&
        !keys.back().insert(parsed.get<std::string>()).second) {
      throw std::invalid_argument(path.string() + ": key " + parsed.get<std::string>() +
                                  " stands twice in one object, allowed once");
    }
    return true;
  };
  try {
    return json::parse(stream, refuse_repeated);
  } catch (const json::exception& error) {
    throw std::invalid_argument(path.string() + ": " + reason_of(error));
  }
}

}  // namespace hlc

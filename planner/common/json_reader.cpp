#include "planner/common/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

using nlohmann::json;

/// Whoever prints or frees a value goes into it as deep as it is.
constexpr std::size_t kDeepest = 100;
constexpr std::size_t kLongestReason = 200;
constexpr char kJson[] = ", allowed one JSON object (RFC 8259)";

std::string joined(const std::string& place, const std::string& key) {
  return (place.empty() ? "" : place + ".") + one_line(key);
}

std::string entry_of(const std::string& place, std::size_t index) {
  return place + "[" + std::to_string(index) + "]";
}

/// "[json.exception.parse_error.101] parse error at line 3, column 1: ..." without the brackets.
std::string reason_of(const json::exception& error) {
  const std::string text = error.what();
  const auto end = text.find("] ");
  return one_line(end == std::string::npos ? text : text.substr(end + 2), kLongestReason);
}

/// An object or a list that is being read.
struct Open {
  bool is_list{};
  std::size_t entry{};         ///< of a list: the one that comes next, or is open
  std::set<std::string> keys;  ///< of an object
  std::string last_key;        ///< of an object
};

/// "incumbent[1].trim": where the next value stands.
std::string place_of(const std::vector<Open>& opened) {
  std::string place;
  for (const Open& one : opened) {
    place = one.is_list ? entry_of(place, one.entry) : joined(place, one.last_key);
  }
  return place;
}

/// A value is complete: in a list, the next one comes.
void count_entry(std::vector<Open>& opened) {
  if (!opened.empty() && opened.back().is_list) ++opened.back().entry;
}

/// "line 3: " of a number that no double holds, one character behind which the parser has stopped;
/// empty if the stream cannot go back.
std::string line_of_number(std::istream& stream) {
  const std::streamoff end = stream.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in);
  if (end <= 0) return {};
  std::string before(static_cast<std::size_t>(end - 1), '\0');
  stream.rdbuf()->pubseekpos(0, std::ios::in);
  stream.rdbuf()->sgetn(before.data(), static_cast<std::streamsize>(before.size()));
  return "line " + std::to_string(1 + std::ranges::count(before, '\n')) + ": ";
}

/// "start.x = 1e999": of the number, the parser's own words are "number overflow parsing '1e999'".
std::string number_at(const std::string& place, const std::string& reason) {
  const std::size_t begin = reason.find('\'') + 1;
  return (place.empty() ? "a number" : place) + " = " +
         one_line(reason.substr(begin, reason.rfind('\'') - begin));
}

}  // namespace

std::string JsonPlace::shown() const {
  return *file_ + ": " + (place_.empty() ? "the whole" : place_) + " = " +
         one_line(value_->dump(-1, ' ', false, json::error_handler_t::replace));
}

void JsonPlace::fail(const std::string& allowed) const {
  throw std::invalid_argument(shown() + ", allowed " + allowed);
}

void JsonPlace::fail_because(const std::string& reason) const {
  throw std::invalid_argument(shown() + ": " + reason);
}

std::optional<JsonPlace> JsonPlace::find(const std::string& key) const {
  if (!value_->is_object()) fail("an object");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return JsonPlace(*file_, joined(place_, key), *found);
}

JsonPlace JsonPlace::at(const std::string& key, const std::string& allowed) const {
  if (std::optional<JsonPlace> found = find(key)) return *found;
  throw std::invalid_argument(*file_ + ": " + joined(place_, key) + " is missing, allowed " +
                              allowed);
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
    throw std::invalid_argument(*file_ + ": unknown key " + joined(place_, key) + ", allowed " +
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
    places.emplace_back(*file_, entry_of(place_, i), (*value_)[i]);
  }
  return places;
}

double JsonPlace::number(double least, double most, const std::string& allowed) const {
  if (!value_->is_number()) fail(allowed);
  const auto value = value_->get<double>();
  if (!std::isfinite(value) || value < least || value > most) fail(allowed);
  return value;
}

double JsonPlace::number() const {
  using Limits = std::numeric_limits<double>;
  return number(Limits::lowest(), Limits::max(), "a finite number");
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
  std::vector<Open> opened;
  const auto open = [&](bool is_list) {
    if (opened.size() == kDeepest) {
      throw std::invalid_argument(
          path.string() + ": " + one_line(place_of(opened), kLongestReason) +
          ": lists or objects within each other, allowed " + std::to_string(kDeepest) + " at most");
    }
    opened.push_back({.is_list = is_list, .entry = 0, .keys = {}, .last_key = {}});
  };
  const auto check = [&](int, json::parse_event_t event, json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        open(event == json::parse_event_t::array_start);
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        opened.pop_back();
        count_entry(opened);
        break;
      case json::parse_event_t::key:
        opened.back().last_key = parsed.get<std::string>();
        if (!opened.back().keys.insert(opened.back().last_key).second) {
          throw std::invalid_argument(path.string() + ": key " + place_of(opened) +
                                      " stands twice in one object, allowed once");
        }
        break;
      case json::parse_event_t::value:
        count_entry(opened);
        break;
    }
    return true;
  };
  try {
    return json::parse(stream, check);
  } catch (const json::out_of_range& error) {
    throw std::invalid_argument(path.string() + ": " + line_of_number(stream) +
                                number_at(place_of(opened), error.what()) +
                                ", allowed a finite number");
  } catch (const json::exception& error) {
    throw std::invalid_argument(path.string() + ": " + reason_of(error) + kJson);
  }
}

}  // namespace hlc

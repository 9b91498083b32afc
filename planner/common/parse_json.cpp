#include <fmt/format.h>

#include <istream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "planner/common/value_tree.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestReason = 200;
constexpr int kNumberOverflow = 406;  // of nlohmann's exceptions

/// The characters of a stream; counts the lines read.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  CountingIterator() = default;
  CountingIterator(std::istream& stream, int& line) : at_(stream), line_(&line) {}

  char operator*() const { return *at_; }
  CountingIterator& operator++() {
    // The parser reads one character ahead: a number ends before its line does.
    if (was_line_break_) ++*line_;
    was_line_break_ = *at_ == '\n';
    ++at_;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }

 private:
  std::istreambuf_iterator<char> at_{};
  int* line_{};
  bool was_line_break_{false};
};

/// "[json.exception.parse_error.101] parse error at line 3, column 1: ..." without the brackets.
std::string reason_of(const json::exception& error) {
  const std::string text = error.what();
  const auto end = text.find("] ");
  return one_line(end == std::string::npos ? text : text.substr(end + 2), kLongestReason);
}

/// Callbacks of nlohmann's parser.
class TreeEvents : public json::json_sax_t {
 public:
  TreeEvents(const std::string& name, const int& line)
      : name_(name), line_(line), tree_(name, FileFormat::kJson) {}

  bool null() override { return scalar(Value::Kind::kNothing, {}); }
  bool boolean(bool value) override {
    return scalar(Value::Kind::kLiteral, value ? "true" : "false");
  }
  bool number_integer(json::number_integer_t value) override {
    return scalar(Value::Kind::kLiteral, fmt::to_string(value));
  }
  bool number_unsigned(json::number_unsigned_t value) override {
    return scalar(Value::Kind::kLiteral, fmt::to_string(value));
  }
  bool number_float(json::number_float_t value, const std::string& /*written*/) override {
    return scalar(Value::Kind::kLiteral, json(value).dump());
  }
  bool string(std::string& value) override { return scalar(Value::Kind::kText, value); }
  bool binary(json::binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*size*/) override { return open(Value::Kind::kMap); }
  bool start_array(std::size_t /*size*/) override { return open(Value::Kind::kList); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& text) override {
    tree_.key(text, 0);
    return true;
  }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const json::exception& error) override {
    if (error.id == kNumberOverflow) {
      // "number overflow parsing '1e999'"
      const std::string reason = error.what();
      const std::size_t begin = reason.find('\'') + 1;
      const std::string path = tree_.path();
      throw std::invalid_argument(
          fmt::format("{}: line {}: {} = {}, must be a finite number", name_, line_,
                      path.empty() ? "a number" : path,
                      one_line(reason.substr(begin, reason.rfind('\'') - begin))));
    }
    throw std::invalid_argument(
        fmt::format("{}: {}, must be one JSON object (RFC 8259)", name_, reason_of(error)));
  }

  [[nodiscard]] Value take() { return tree_.take(); }

 private:
  bool scalar(Value::Kind kind, std::string text) {
    tree_.scalar(kind, std::move(text), 0);
    return true;
  }
  bool open(Value::Kind kind) {
    tree_.open(kind, 0);
    return true;
  }
  bool close() {
    tree_.close();
    return true;
  }

  const std::string& name_;
  const int& line_;
  ValueTreeBuilder tree_;
};

}  // namespace

Value parse_json(std::istream& stream, const std::string& name) {
  int line = 1;
  TreeEvents events(name, line);
  json::sax_parse(CountingIterator(stream, line), CountingIterator(), &events);
  return events.take();
}

}  // namespace hlc

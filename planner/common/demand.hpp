#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>

/// HLC_DEMAND(condition, values...): an assertion that is also active in release builds. If the
/// condition is false, one line with the place, the condition and the values goes to standard
/// error, and the program aborts:
///
///     planner/geometry/polygon.cpp:198: demanded distance_m >= 0.0; distance_m = -0.5
///
/// It is for a programmer's mistake, a broken precondition or invariant. Bad input (a file, a flag,
/// a message) is refused with an error instead. Values: numbers, bool, enumerators, strings, and
/// types with a number called `value` (VehicleId, StepIndex). They are evaluated only if the
/// condition is false.
///
/// Plain assert remains where a check costs per vertex or per obstacle of a search: costs of edges,
/// cost-to-go, prepared obstacles (planner/search).
#define HLC_DEMAND(condition, ...)                                                       \
  do {                                                                                   \
    if (!(condition)) [[unlikely]] {                                                     \
      ::hlc::demand_failed(__builtin_FILE(), __builtin_LINE(), #condition, #__VA_ARGS__, \
                           {__VA_ARGS__});                                               \
    }                                                                                    \
  } while (false)

namespace hlc {

/// One value as text.
class DemandedValue {
 public:
  DemandedValue(std::string_view text) : text_(text) {}
  DemandedValue(const char* text) : text_(text) {}
  DemandedValue(const std::string& text) : text_(text) {}
  template <class T>
  requires std::is_arithmetic_v<T> DemandedValue(T number) {
    if constexpr (std::same_as<T, bool>) {
      text_ = number ? "true" : "false";
    } else if constexpr (std::floating_point<T>) {
      write(static_cast<double>(number));
    } else if constexpr (std::is_signed_v<T>) {
      write(static_cast<std::int64_t>(number));
    } else {
      write(static_cast<std::uint64_t>(number));
    }
  }
  template <class T>
  requires std::is_enum_v<T> DemandedValue(T value)
      : DemandedValue(static_cast<std::underlying_type_t<T>>(value)) {}
  template <class T>
  requires std::is_arithmetic_v<decltype(T::value)> DemandedValue(T id) : DemandedValue(id.value) {}

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void write(double number);
  void write(std::int64_t number);
  void write(std::uint64_t number);

  std::string text_;
};

/// Called by HLC_DEMAND. `names`: the values as written there, separated by commas.
[[noreturn]] void demand_failed(std::string_view file, int line, std::string_view condition,
                                std::string_view names,
                                std::initializer_list<DemandedValue> values);

}  // namespace hlc

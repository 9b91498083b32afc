#pragma once

#include <cstdint>
#include <string>

namespace hlc::doctor {

enum class Verdict : std::uint8_t {
  kGood,
  kNote,  ///< may be wanted
  kBad,   ///< a run will not work
};

/// One line of lab_doctor.
struct Finding {
  Verdict verdict{};
  std::string what;    ///< what was found
  std::string advice;  ///< what to do; empty if nothing
};

}  // namespace hlc::doctor

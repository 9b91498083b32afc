#pragma once

#include <memory>
#include <string>

#include "hlc_bridge/dds/participant.hpp"

namespace hlc::process {

/// During its lifetime the log lines of this process (spdlog's default logger) are also published
/// to the operator: topic `log` of the lab domain, in the lab's levels.
///
/// | spdlog | lab |
/// |---|---|
/// | critical, error | 1 |
/// | warning | 2 |
/// | info and less | 3 |
///
/// Lines above the operator's level (topic `logLevel`; default 1) are not sent. Never blocks: the
/// writer keeps the newest line.
class LabLog {
 public:
  /// @param node_id  of the program, as the operator's log window names it
  /// @throws std::runtime_error if an endpoint cannot be made
  LabLog(dds::Participant& lab, std::string node_id);
  ~LabLog();
  LabLog(const LabLog&) = delete;
  LabLog& operator=(const LabLog&) = delete;

 private:
  class Sink;
  std::shared_ptr<Sink> sink_;
};

}  // namespace hlc::process

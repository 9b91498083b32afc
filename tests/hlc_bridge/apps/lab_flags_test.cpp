#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"

namespace hlc::apps {
namespace {

/// Flags of a program that the lab starts.
struct LabProgram {
  LabProgram() {
    network.declare(app);
    app.add_option("--vehicle_ids", ids)->delimiter(',')->required()->check(vehicle_id_range());
  }
  std::optional<int> parse(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "program");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    testing::internal::CaptureStderr();
    const auto code = parse_lab_flags(app, network, static_cast<int>(argv.size()), argv.data());
    complaint = testing::internal::GetCapturedStderr();
    return code;
  }
  CommandLine app{"", "program"};
  NetworkFlags network;
  std::vector<int> ids;
  std::string complaint;
};

TEST(LabFlags, UnknownOnesAreIgnoredOnTheLabsTransport) {
  LabProgram program;
  EXPECT_EQ(program.parse({"--vehicle_ids=1,2", "--script=fast", "words", "--dds_domain=21"}),
            std::nullopt);
  EXPECT_EQ(program.ids, (std::vector{1, 2}));
  EXPECT_EQ(program.network.dds_domain, 21) << "after the unknown ones";
}

TEST(LabFlags, UnknownOnesAreRefusedElsewhere) {
  LabProgram program;
  EXPECT_EQ(program.parse({"--vehicle_ids=1", "--script=fast", "--transport=loopback"}), 2);
  EXPECT_EQ(program.complaint,
            "program: The following argument was not expected: --script=fast, must be a flag that "
            "--help lists\n");
}

TEST(LabFlags, ABadValueOfAKnownFlagIsRefusedAsEverywhere) {
  LabProgram program;
  EXPECT_EQ(program.parse({"--vehicle_ids=1", "--dds_domain=many"}), 2);
  EXPECT_NE(program.complaint.find("--dds_domain: many, must be"), std::string::npos)
      << program.complaint;
}

}  // namespace
}  // namespace hlc::apps

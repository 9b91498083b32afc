// The program with flags that it must refuse: it ends before it joins any domain.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "tests/support/program.hpp"

namespace hlc::apps {
namespace {

test::Outcome run(const std::string& flags) { return test::run_program("vehicle_sim " + flags); }

struct BadFlags {
  std::string flags;
  std::string named;  ///< what the message must speak of
};
void PrintTo(const BadFlags& one, std::ostream* out) { *out << '"' << one.flags << '"'; }

class VehicleSimRefuses : public testing::TestWithParam<BadFlags> {};

TEST_P(VehicleSimRefuses, InOneLineWithExitCodeTwo) {
  const auto [exit_code, output] = run(GetParam().flags);
  EXPECT_EQ(exit_code, 2) << output;
  EXPECT_NE(output.find(GetParam().named), std::string::npos) << output;
  EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
}

INSTANTIATE_TEST_SUITE_P(
    Flags, VehicleSimRefuses,
    testing::Values(
        BadFlags{"", "--vehicle_id"}, BadFlags{"--vehicle_id=0", "1 ... 30"},
        BadFlags{"--vehicle_id=31", "1 ... 30"}, BadFlags{"--vehicle_id=two", "--vehicle_id"},
        BadFlags{"--vehicle_id=24", "--pose"},
        BadFlags{"--vehicle_id=1 --transport=loopback --speed=3", "--speed=3"},
        BadFlags{"--vehicle_id=1 --pose=1,2", "--pose"},
        BadFlags{"--vehicle_id=1 --pose=1,2,north", "--pose"},
        BadFlags{"--vehicle_id=1 --pose=1,nan,0", "--pose"},
        BadFlags{"--vehicle_ids=1,2,1", "--vehicle_ids"},
        BadFlags{"--vehicle_ids=1,2 --pose=1,2,3", "--pose: 3 numbers, must be 3 for each of 2"},
        BadFlags{"--vehicle_ids=1,2 --noise_seed=1", "--noise_seed"},
        BadFlags{"--vehicle_ids=1,2 --record=/tmp/x.csv", "must contain {id}"},
        BadFlags{"--vehicle_id=1 --dds_domain=233", "233"},
        BadFlags{"--vehicle_id=1 --dds_domain=-1", "-1"},
        BadFlags{"--vehicle_id=1 --transport=tcp", "tcp"},
        BadFlags{"--vehicle_id=1 --simulated_time=maybe", "--simulated_time"},
        BadFlags{"--vehicle_id=1 --noise_seed=-1", "--noise_seed"},
        BadFlags{"--vehicle_id=1 --gains_scale=nan", "--gains_scale"},
        BadFlags{"--vehicle_id=1 --gains_scale=-1", "--gains_scale"},
        BadFlags{"--vehicle_id=1 --stamps=late", "--stamps"},
        BadFlags{"--vehicle_id=1 --stamps=lab --gains_scale=0.5", "--gains_scale"},
        BadFlags{"--vehicle_id=1 --discovery_mode=client", "--discovery"},
        BadFlags{"--vehicle_id=1 --discovery_mode=server", "--discovery_mode"},
        BadFlags{"--vehicle_id=1 --startup_timeout_s=0", "--startup_timeout_s"},
        BadFlags{"--vehicle_id=1 --record=/no/such/folder/x.csv", "/no/such/folder/x.csv"}));

TEST(VehicleSimFlags, HelpIsGoodAndNamesTheExitCodes) {
  const auto [exit_code, output] = run("--help");
  EXPECT_EQ(exit_code, 0);
  EXPECT_NE(output.find("Exit codes"), std::string::npos);
}

}  // namespace
}  // namespace hlc::apps

#include "hlc_bridge/record/drive_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kHeading{kDriveHeading};

TEST(DriveFile, SeventeenDigitsReadBackAsTheSameBits) {
  const unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 random{seed};
  std::uniform_real_distribution<double> value{-5.0, 5.0};
  const test::TemporaryFolder folder;
  std::string text = kHeading + "\n";
  std::vector<Pose> poses;
  for (Nanoseconds i = 0; i < 200; ++i) {
    poses.push_back({value(random), value(random), value(random)});
    char numbers[128];
    std::snprintf(numbers, sizeof(numbers), "%.17g,%.17g,%.17g,0.5,0.25,-0.125,", poses.back().x_m,
                  poses.back().y_m, poses.back().heading_rad);
    text += std::to_string(i * kVehiclePeriod) + "," + numbers + std::to_string(i) + "\n";
  }
  test::put(drive_file(folder.path(), 3), text);
  const result::Drive drive = read_drive(folder / "vehicle_3.csv");
  ASSERT_EQ(drive.size(), poses.size());
  for (std::size_t i = 0; i < drive.size(); ++i) {
    EXPECT_EQ(drive[i].t, i * kVehiclePeriod);
    EXPECT_EQ(drive[i].pose, poses[i]);
    EXPECT_EQ(drive[i].speed_mps, 0.5);
    EXPECT_EQ(drive[i].throttle, 0.25);
    EXPECT_EQ(drive[i].steering, -0.125);
    EXPECT_EQ(drive[i].command_create, i);
  }
}

TEST(DriveFile, TimesMustIncrease) {
  const test::TemporaryFolder folder;
  test::put(folder / "d.csv", kHeading + "\n20,0,0,0,0,0,0,0\n20,0,0,0,0,0,0,0\n");
  EXPECT_THAT([&] { (void)read_drive(folder / "d.csv"); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("d.csv:3: t_ns = \"20\", must be larger than in the row before")));
}

}  // namespace
}  // namespace hlc::record

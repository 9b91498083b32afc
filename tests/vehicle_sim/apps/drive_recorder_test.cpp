#include "vehicle_sim/apps/drive_recorder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "hlc_bridge/record/drive_file.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::apps {
namespace {

std::string lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class DriveRecorderTest : public testing::Test {
 protected:
  const test::TemporaryFolder folder_;
};

TEST_F(DriveRecorderTest, RowsAreOnTheDiskAtOnceWithAllDigits) {
  const std::filesystem::path file = folder_ / "drive.csv";
  DriveRecorder recorder(file);
  recorder.write({.t = 20'000'000,
                  .pose = {.x_m = 1.0 / 3.0, .y_m = -2.5, .heading_rad = 1e-20},
                  .speed_mps = 0.1,
                  .throttle = -1.0,
                  .steering = 0.0,
                  .command_create = 1});
  EXPECT_EQ(
      lines_of(file),
      "t_ns,x_m,y_m,yaw_rad,speed_mps,throttle,steering,command_create_ns\n"
      "20000000,0.33333333333333331,-2.5,9.9999999999999995e-21,0.10000000000000001,-1,0,1\n");
}

TEST_F(DriveRecorderTest, WhatIsWrittenIsReadBackBitForBit) {
  const std::filesystem::path file = folder_ / "drive.csv";
  DriveRecorder recorder(file);
  const Pose pose{.x_m = 1.0 / 3.0, .y_m = -0.1, .heading_rad = 1e-17};
  recorder.write({.t = 20'000'000, .pose = pose, .speed_mps = 0.7, .steering = -0.2});
  const result::Drive drive = record::read_drive(file);
  ASSERT_EQ(drive.size(), 1U);
  EXPECT_EQ(drive[0].t, 20'000'000U);
  EXPECT_EQ(drive[0].pose, pose);
  EXPECT_EQ(drive[0].speed_mps, 0.7);
  EXPECT_EQ(drive[0].steering, -0.2);
}

TEST_F(DriveRecorderTest, FileThatCannotBeWrittenIsNamed) {
  try {
    DriveRecorder recorder(folder_ / "no_such_folder" / "drive.csv");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no_such_folder"), std::string::npos);
  }
}

TEST_F(DriveRecorderTest, OfACarThatIsStartedAgainTheWholeDriveIsThere) {
  const std::filesystem::path file = folder_ / "drive.csv";
  DriveRecorder(file).write({.t = 20'000'000});
  { std::ofstream(file, std::ios::app) << "40000000,0.1,0"; }  // killed in the middle of a row
  DriveRecorder(file, true).write({.t = 60'000'000});
  DriveRecorder(file, true).write({.t = 80'000'000});
  const result::Drive drive = record::read_drive(file);
  ASSERT_EQ(drive.size(), 3U);
  EXPECT_EQ(drive[1].t, 60'000'000U);
  DriveRecorder(folder_ / "new.csv", true).write({.t = 20'000'000});
  EXPECT_EQ(record::read_drive(folder_ / "new.csv").size(), 1U);
  DriveRecorder(file).write({.t = 20'000'000});
  EXPECT_EQ(record::read_drive(file).size(), 1U);
}

// Otherwise a full disk would truncate a drive silently.
TEST_F(DriveRecorderTest, ARowThatCannotBeWrittenIsAnError) {
  const std::filesystem::path file = folder_ / "drive.csv";
  DriveRecorder recorder(file);
  const test::FullDisk disk(std::filesystem::file_size(file) + 5);
  try {
    recorder.write({.t = 20'000'000});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), file.string() + ": cannot be written");
  }
}

}  // namespace
}  // namespace hlc::apps

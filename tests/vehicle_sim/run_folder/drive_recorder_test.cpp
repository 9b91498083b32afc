#include "vehicle_sim/run_folder/drive_recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "hlc_bridge/record/drive_file.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::run_folder {
namespace {

std::string lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class DriveRecorderTest : public testing::Test {
 protected:
  DriveRecorder open(const std::filesystem::path& file, bool append = false) {
    return {file, [this](const std::string& line) { failures_.push_back(line); }, append};
  }

  const test::TemporaryFolder folder_;
  std::vector<std::string> failures_;
};

TEST_F(DriveRecorderTest, RowsAreOnTheDiskAtOnceWithAllDigits) {
  const std::filesystem::path file = folder_ / "drive.csv";
  DriveRecorder recorder = open(file);
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
  DriveRecorder recorder = open(file);
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
    static_cast<void>(open(folder_ / "no_such_folder" / "drive.csv"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no_such_folder"), std::string::npos);
  }
}

TEST_F(DriveRecorderTest, OfACarThatIsStartedAgainTheWholeDriveIsThere) {
  const std::filesystem::path file = folder_ / "drive.csv";
  open(file).write({.t = 20'000'000});
  { std::ofstream(file, std::ios::app) << "40000000,0.1,0"; }  // killed in the middle of a row
  open(file, true).write({.t = 60'000'000});
  open(file, true).write({.t = 80'000'000});
  const result::Drive drive = record::read_drive(file);
  ASSERT_EQ(drive.size(), 3U);
  EXPECT_EQ(drive[1].t, 60'000'000U);
  open(folder_ / "new.csv", true).write({.t = 20'000'000});
  EXPECT_EQ(record::read_drive(folder_ / "new.csv").size(), 1U);
  open(file).write({.t = 20'000'000});
  EXPECT_EQ(record::read_drive(file).size(), 1U);
}

TEST_F(DriveRecorderTest, ARowThatCannotBeWrittenIsReportedAndTheCarDrivesOn) {
  const std::filesystem::path file = folder_ / "drive.csv";
  DriveRecorder recorder = open(file);
  {
    const test::FullDisk disk(std::filesystem::file_size(file) + 5);
    recorder.write({.t = 20'000'000});
  }
  recorder.write({.t = 40'000'000});
  EXPECT_THAT(failures_,
              testing::ElementsAre(file.string() + ": no longer written: File too large"));
  EXPECT_EQ(recorder.close(), file.string() + ": incomplete, 2 rows are missing");
  EXPECT_TRUE(record::read_drive(file).empty()) << "no row behind the incomplete one";
}

}  // namespace
}  // namespace hlc::run_folder

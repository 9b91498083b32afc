#include "hlc_bridge/record/certificate_file.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "planner/common/text_file.hpp"
#include "planner/geometry/footprint.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::record {
namespace {

const auto kUnexpectedLine = [](const std::string& line) { ADD_FAILURE() << line; };

ConvexPolygon triangle(double x) {
  return {{Point{x, 0.0}, Point{x + 1.0, 0.0}, Point{x, 0.1 + 0.2}}};
}

ReportRecord record_with(const std::shared_ptr<const coordination::Certificate>& certificate) {
  ReportRecord record;
  record.report.step = {17};
  record.report.vehicle = {4};
  record.report.certificate = certificate;
  return record;
}

TEST(CertificateFile, HasALineForEveryCertificateWithNumbersThatReadBackToTheSameBits) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "certificates.csv";
  CertificateFile certificates(file, kUnexpectedLine);
  certificates.append(record_with(nullptr));
  certificates.append(record_with(std::make_shared<
                                  const coordination::Certificate>(coordination::Certificate{
      .footprint = {.length_m = 0.22, .width_m = 0.107},
      .areas = {.first = {17}, .areas_m = {triangle(0), triangle(2)}, .final_area_m = triangle(3)},
      .is_agreed = true,
      .separations = {
          {.from = {2}, .known = coordination::KnownMotion::kNew, .lines = {{0.5, 1.25}, {-3, 2}}},
          {.from = {9},
           .known = coordination::KnownMotion::kMissing,
           .lines = {{1, 0}, {1, 0}}}}})));
  EXPECT_EQ(certificates.close(), std::nullopt);
  EXPECT_EQ(read_file(file),
            "step,id,length_m,width_m,is_agreed,areas,standstill,separations\n"
            "17,4,0.22,0.107,1,0 0 1 0 0 0.30000000000000004;2 0 3 0 2 0.30000000000000004,"
            "3 0 4 0 3 0.30000000000000004,2:new:0.5 1.25 -3 2;9:missing:1 0 1 0\n");
}

TEST(CertificateFile, LeavesTheAreasOfAStandingVehicleAndTheLinesOfOneAloneEmpty) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "certificates.csv";
  CertificateFile certificates(file, kUnexpectedLine);
  certificates.append(
      record_with(std::make_shared<const coordination::Certificate>(coordination::Certificate{
          .footprint = {.length_m = 1, .width_m = 2},
          .areas = {.first = {17}, .areas_m = {}, .final_area_m = triangle(0)},
          .is_agreed = false,
          .separations = {}})));
  EXPECT_EQ(certificates.close(), std::nullopt);
  EXPECT_EQ(read_file(file),
            "step,id,length_m,width_m,is_agreed,areas,standstill,separations\n"
            "17,4,1,2,0,,0 0 1 0 0 0.30000000000000004,\n");
}

}  // namespace
}  // namespace hlc::record

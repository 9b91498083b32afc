#include "hlc_bridge/record/certificate_file.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace hlc::record {
namespace {

constexpr std::string_view kCertificateHeading =
    "step,id,length_m,width_m,is_agreed,areas,standstill,separations\n";

void add_number(double value, std::string& text) {
  if (!text.empty() && text.back() != ',' && text.back() != ';' && text.back() != ':') text += ' ';
  text += fmt::format("{}", value);
}

void add_area(const ConvexPolygon& area, std::string& text) {
  for (const Point& corner : area.vertices_m) {
    add_number(corner.x(), text);
    add_number(corner.y(), text);
  }
}

void add_separation(const coordination::Separation& separation, std::string& text) {
  text += fmt::format("{}:{}:", separation.from.value, coordination::to_string(separation.known));
  for (const auto& [direction_rad, offset_m] : separation.lines) {
    add_number(direction_rad, text);
    add_number(offset_m, text);
  }
}

std::string line(const coordination::Report& report) {
  const auto& [footprint, areas, is_agreed, separations] = *report.certificate;
  std::string text = fmt::format("{},{},{},{},{},", report.step.value, report.vehicle.value,
                                 footprint.length_m, footprint.width_m, is_agreed ? 1 : 0);
  for (std::size_t i = 0; i < areas.areas_m.size(); ++i) {
    if (i > 0) text += ';';
    add_area(areas.areas_m[i], text);
  }
  text += ',';
  add_area(areas.final_area_m, text);
  text += ',';
  for (std::size_t i = 0; i < separations.size(); ++i) {
    if (i > 0) text += ';';
    add_separation(separations[i], text);
  }
  return text + '\n';
}

}  // namespace

CertificateFile::CertificateFile(std::filesystem::path file, GrowingFile::OnFailure on_failure)
    : file_{std::move(file), GrowingFile::Opening::kEmptied, std::move(on_failure)} {
  file_.begin(kCertificateHeading);
}

void CertificateFile::append(const ReportRecord& record) {
  if (record.report.certificate != nullptr) file_.write(line(record.report));
}

}  // namespace hlc::record

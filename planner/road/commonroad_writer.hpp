#pragma once

#include <tinyxml2.h>

#include <string>

#include "planner/road/lanelet_map.hpp"

namespace hlc::road {

/// Metadata of a CommonRoad file.
struct CommonRoadHead {
  std::string benchmark_id;
  std::string author;
  std::string source;
  std::string time_step;  ///< [s]
};

/// Writes a CommonRoad 2020a file element by element: `open` ... `close` for elements on separate
/// lines, `open_inline` ... `close_inline` for those within a line. Numbers have 9 decimals.
class CommonRoadWriter : private tinyxml2::XMLPrinter {
 public:
  /// Writes the begin of the file, up to its first lanelet. The date is always the same.
  explicit CommonRoadWriter(const CommonRoadHead& head);

  /// The map's <lanelet> elements, by ascending id.
  void add_lanelets(const LaneletMap& map);

  void open(const char* name) { OpenElement(name); }
  void close() { CloseElement(); }
  void open_inline(const char* name) { OpenElement(name, true); }
  void close_inline() { CloseElement(true); }
  /// Of the last opened element.
  using tinyxml2::XMLPrinter::PushAttribute;
  void text(const char* name, const std::string& text, bool is_inline = true);
  void number(const char* name, double value);

  /// The whole text. Nothing can be added afterwards.
  [[nodiscard]] std::string finish();

 private:
  void PrintSpace(int depth) override;
  void add_bound(const char* name, const std::vector<Point>& points_m);
  void add_references(const char* name, const std::vector<LaneletId>& ids);
  void add_adjacent(const char* name, const std::optional<Lanelet::Adjacent>& adjacent);
};

}  // namespace hlc::road

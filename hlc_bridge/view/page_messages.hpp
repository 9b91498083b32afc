#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/explanation.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "planner/road/lanelet_map.hpp"

/// The data of a run for the page (page/model.js), as messages: JSON objects whose `kind` is
///
/// * `run`: the scenario, in words what was driven and what went wrong, the map's lanes, the
///   vehicles with their routes, names of enumerators; with right of way `roads`, the routes of the
///   conflict map: places of their cells and the number of the conflict zone at each
///   (right_of_way/conflict_zones.hpp), 0 for none; the first message;
/// * `maneuvers`: label, poses at equal times and swept area of each, in its own frame; the page
///   numbers them from 0 in the order in which they arrive;
/// * `steps`: reports of one vehicle: steps, poses, and in `columns` a column per further field, in
///   the unit that `units` of `run` has for it, or as places in the table that `tables` of `run`
///   has for it: a table of this message or of `run`. `names` and `sets` are tables of texts and of
///   lists of numbers: of vehicles; in `plan` of its maneuvers, from the one under way on, as far
///   as they are known; in `held` road, first cell and number of cells, or nothing;
/// * `drive`: states of one vehicle at equal times, without a gap;
/// * `why`: explanations of one vehicle: `steps` is a list of [first step, last step, text], a text
///   with line feeds;
/// * `search`: what one vehicle searched in one step, as a page of its own;
/// * `log`: lines;
/// * `end`: in a run under way only, see live_messages.hpp.
///
/// Lengths are whole numbers of `unit_m`, angles of `unit_rad`, speeds of 1 mm/s; times count from
/// t(0) of the run, steps from 0. Columns of positions, angles, speeds and steps, and lines (x and
/// y in turn), hold the first value and then the differences: few digits. What is not a finite
/// number, or beyond 10^9 m, is 0.
namespace hlc::view {

/// A finished run.
struct FinishedRun {
  result::RunDescription description;
  result::RunFacts facts;
  std::vector<result::StepRecord> rows;  ///< of step_records()
  result::Drives drives;
  std::optional<road::LaneletMap> map;  ///< none: open ground
  std::vector<result::LoggedLine> log;
  std::vector<result::Explanation> explanations;
  std::vector<result::SearchPage> searches;
  std::string fork;      ///< what was changed in it, as text; empty: nothing
  std::string time;      ///< kind of time, as text: "logical time"
  std::string revision;  ///< of the programs
  std::string fault;     ///< what was wrong with the drive; empty: nothing
  /// How a step can be explained, or why not: VEHICLE and STEP stand for their numbers; empty:
  /// nothing is known of that yet.
  std::string how_explained;

  /// Lets pages and pictures show the guests, too: behind the others, as cars that never plan.
  void show_guests() {
    for (const result::VehicleDescription& guest : description.guests) {
      facts.vehicle_ids.push_back(guest.id.value);
      description.vehicles.push_back(guest);
    }
  }
};

/// All messages of the run as one JSON array. Equal runs give equal bytes. Bytes that are not UTF-8
/// are replaced.
[[nodiscard]] std::string page_messages(const FinishedRun& run);

}  // namespace hlc::view

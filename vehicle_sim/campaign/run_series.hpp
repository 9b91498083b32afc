#pragma once

#include <cstddef>
#include <string>

#include "vehicle_sim/campaign/campaign.hpp"

/// A run as rows over time, for figures. Times count from the run's first step.
namespace hlc::campaign {

/// A row per step and vehicle.
///
/// * run ... start   the run, as in runs.csv
/// * vehicle, name   its id and its name in the scenario
/// * planned_on      subgraph of the step's plan (Report::subgraph)
/// * searched        false before the start and after the end: then nothing was generated
/// * planning_ms     processor time of the search; empty: not measured
/// * arc_length_m    of the planned position along the vehicle's path, from the path's first point;
///                   unwrapped, it grows beyond the length of a closed path
/// * error_mm        distance of the planned position to the path
/// * is_stuck        waits for so long that the run counts the vehicle as stuck, if that is its
///                   last step
inline constexpr char kStepColumns[] =
    "run,scenario,profile,subgraph,policy,start,vehicle,name,step,time_s,planned_on,generated,"
    "expanded,searched,planning_ms,arc_length_m,error_mm,is_stuck\n";

/// A row per vehicle and tick: the true state, and the limit of the policy's zones there (empty: in
/// no zone).
inline constexpr char kDriveColumns[] =
    "run,vehicle,time_s,x_m,y_m,yaw_rad,speed_mps,zone_limit_mps\n";

/// A row per pair of vehicles and tick at which their footprints are closer than kNear_m;
/// kept_m: what plans keep, both safety margins.
inline constexpr char kDistanceColumns[] = "run,first,second,pair,time_s,distance_m,kept_m\n";
inline constexpr double kNear_m = 1.0;

/// Rows of one run, without headings.
struct RunSeries {
  std::string steps;
  std::string drives;
  std::string distances;
};

/// How much of a run is written.
enum class SeriesExtent {
  kWhole,
  kFirstVehicle,  ///< its steps without planning times, and every kSparse-th tick: for the spread
};
inline constexpr std::size_t kSparse = 5;

/// @param number   of the run
/// @param heading  Campaign::heading_of(number)
/// @pre the run was driven to its end
[[nodiscard]] RunSeries series_of(const DrivenRun& run, std::size_t number,
                                  const RunFigures& heading, SeriesExtent extent);

}  // namespace hlc::campaign

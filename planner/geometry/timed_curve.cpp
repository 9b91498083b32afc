#include "planner/geometry/timed_curve.hpp"

namespace hlc {

double CurveSample::curvature_per_m() const {
  const double speed_mps = velocity_mps.norm();
  if (speed_mps == 0.0) {
    return 0.0;
  }
  const double cross =
      velocity_mps.x() * acceleration_mps2.y() - velocity_mps.y() * acceleration_mps2.x();
  return cross / (speed_mps * speed_mps * speed_mps);
}

CurveSample interpolated(const TimedPoint& from, const TimedPoint& to, double duration_s,
                         double share) {
  const double T = duration_s;
  const double u = share;
  const Point& p0 = from.position_m;
  const Point& p1 = to.position_m;
  const Point m0 = T * from.velocity_mps;
  const Point m1 = T * to.velocity_mps;

  CurveSample result;
  result.position_m = ((2.0 * u - 3.0) * u * u + 1.0) * p0 + ((u - 2.0) * u + 1.0) * u * m0 +
                      (3.0 - 2.0 * u) * u * u * p1 + (u - 1.0) * u * u * m1;
  result.velocity_mps = (6.0 * (u - 1.0) * u * p0 + ((3.0 * u - 4.0) * u + 1.0) * m0 +
                         6.0 * (1.0 - u) * u * p1 + (3.0 * u - 2.0) * u * m1) /
                        T;
  result.acceleration_mps2 = ((12.0 * u - 6.0) * p0 + (6.0 * u - 4.0) * m0 + (6.0 - 12.0 * u) * p1 +
                              (6.0 * u - 2.0) * m1) /
                             (T * T);
  return result;
}

}  // namespace hlc

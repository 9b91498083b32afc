#include "vehicle_sim/guest/hand_control.hpp"

#include <algorithm>

namespace hlc::guest {
namespace {

constexpr double kSpeedSteps = 10.0;
constexpr double kCurvatureSteps = 4.0;
constexpr double kLargestAxis = 32767.0;
/// Nearer to its middle a stick is not pushed.
constexpr double kDeadShare = 0.1;
constexpr char kEscape = '\x1b';

/// The letter for the last character of an arrow's sequence, ESC [ A; 0 for another key's.
char letter_of_arrow(char last) {
  switch (last) {
    case 'A':
      return 'w';
    case 'B':
      return 's';
    case 'C':
      return 'd';
    case 'D':
      return 'a';
    default:
      return 0;
  }
}

}  // namespace

void HandControl::type(std::string_view characters) {
  for (const char one : characters) {
    if (one == kEscape) {
      escape_ = one;
    } else if (escape_.size() == 1) {
      escape_ += one;  // '[' or 'O'
    } else if (escape_.size() == 2) {
      escape_.clear();
      press(letter_of_arrow(one));
    } else {
      press(one);
    }
  }
}

void HandControl::press(char key) {
  const double faster_mps = limits_.speed_mps / kSpeedSteps;
  const double tighter_per_m = limits_.curvature_per_m / kCurvatureSteps;
  switch (key) {
    case 'w':
      return change(speed_mps_ + faster_mps, curvature_per_m_);
    case 's':
      return change(speed_mps_ - faster_mps, curvature_per_m_);
    case 'a':
      return change(speed_mps_, curvature_per_m_ + tighter_per_m);
    case 'd':
      return change(speed_mps_, curvature_per_m_ - tighter_per_m);
    case 'x':
      return change(speed_mps_, 0.0);
    case ' ':
      return stop();
    case 'q':
      is_over_ = true;
      return stop();
    default:
      return;
  }
}

void HandControl::push(unsigned axis, int value) {
  const double share = std::clamp(-static_cast<double>(value) / kLargestAxis, -1.0, 1.0);
  const double pushed = share > -kDeadShare && share < kDeadShare ? 0.0 : share;
  if (axis == 0) change(speed_mps_, pushed * limits_.curvature_per_m);
  if (axis == 1) change(pushed * limits_.speed_mps, curvature_per_m_);
}

void HandControl::stop() { change(0.0, curvature_per_m_); }

void HandControl::change(double speed_mps, double curvature_per_m) {
  constexpr double kRounding_mps = 1e-9;  // of tenths that add up to nothing
  speed_mps_ = std::clamp(speed_mps, 0.0, limits_.speed_mps);
  if (speed_mps_ < kRounding_mps) speed_mps_ = 0.0;
  curvature_per_m_ = std::clamp(curvature_per_m, -limits_.curvature_per_m, limits_.curvature_per_m);
}

}  // namespace hlc::guest

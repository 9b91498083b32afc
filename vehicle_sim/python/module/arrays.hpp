#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <ranges>
#include <vector>

#include "planner/geometry/pose.hpp"

/// NumPy arrays from the planner's values; each owns its memory. The caller holds the
/// interpreter's lock.
namespace hlc::python {

namespace py = pybind11;

/// A new array of this shape, its last index the fastest. The strides are given, because Debian's
/// pybind11 (2.10) takes the size of a number from NumPy's structures as they were before NumPy 2.
template <class Number>
[[nodiscard]] py::array_t<Number> new_array(const std::vector<std::size_t>& shape,
                                            const Number* numbers = nullptr) {
  std::vector<std::size_t> strides(shape.size());
  std::size_t stride = sizeof(Number);
  for (std::size_t i = shape.size(); i-- > 0;) {
    strides[i] = stride;
    stride *= shape[i];
  }
  return py::array_t<Number>(shape, strides, numbers);
}

/// One number of each row: shape (number of rows,).
template <class Number, class Rows, class Get>
[[nodiscard]] py::array_t<Number> column(const Rows& rows, Get get) {
  py::array_t<Number> array = new_array<Number>({std::size(rows)});
  Number* next = array.mutable_data();
  for (const auto& row : rows) *next++ = static_cast<Number>(get(row));
  return array;
}

/// `width` numbers of each row: shape (number of rows, width). `get(row, numbers)` fills them.
template <class Rows, class Fill>
[[nodiscard]] py::array_t<double> table(const Rows& rows, std::size_t width, Fill fill) {
  py::array_t<double> array = new_array<double>({std::size(rows), width});
  double* next = array.mutable_data();
  for (const auto& row : rows) {
    fill(row, next);
    next += width;
  }
  return array;
}

/// Shape (n, 2) [m].
template <class Points>
[[nodiscard]] py::array_t<double> point_table(const Points& points) {
  return table(points, 2, [](const Point& point, double* numbers) {
    numbers[0] = point.x();
    numbers[1] = point.y();
  });
}

/// Shape (n, 3): x [m], y [m], heading [rad].
template <class Poses>
[[nodiscard]] py::array_t<double> pose_table(const Poses& poses) {
  return table(poses, 3, [](const Pose& pose, double* numbers) {
    numbers[0] = pose.x_m;
    numbers[1] = pose.y_m;
    numbers[2] = pose.heading_rad;
  });
}

}  // namespace hlc::python

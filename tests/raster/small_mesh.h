#pragma once
#include "raster/camera.h"
#include "raster/mesh_topology.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace daumier::raster {

/// A mesh whose positions are homogeneous pixel coordinates.
template <class T>
struct PositionedMesh {
  MeshTopology topology;
  std::vector<T> positions;  ///< V x 4
};

/// A ball of rings x 2 rings quads with a bumpy radius, seen by `camera`.
template <class T>
PositionedMesh<T> BumpyBall(int rings, double radius, const Camera& camera, double turn = 0.2) {
  std::vector<T> points = {T(0), T(radius), T(0)};
  std::vector<int> corners;
  const int sides = 2 * rings;
  for (int ring = 1; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      const double polar = std::numbers::pi * ring / rings, around = 2 * std::numbers::pi * side / sides + turn;
      const double r = radius * (1 + 0.1 * std::sin(3 * around) * std::sin(2 * polar));
      points.insert(points.end(), {T(r * std::sin(polar) * std::sin(around)), T(r * std::cos(polar)),
                                   T(r * std::sin(polar) * std::cos(around))});
    }
  }
  points.insert(points.end(), {T(0), T(-radius), T(0)});
  const int last = static_cast<int>(points.size()) / 3 - 1;
  const auto at = [&](int ring, int side) { return 1 + (ring - 1) * sides + side % sides; };
  for (int side = 0; side < sides; ++side) {
    corners.insert(corners.end(), {0, at(1, side), at(1, side + 1)});
    for (int ring = 1; ring + 1 < rings; ++ring) {
      corners.insert(corners.end(), {at(ring, side), at(ring + 1, side), at(ring + 1, side + 1)});
      corners.insert(corners.end(), {at(ring, side), at(ring + 1, side + 1), at(ring, side + 1)});
    }
    corners.insert(corners.end(), {at(rings - 1, side), last, at(rings - 1, side + 1)});
  }
  PositionedMesh<T> mesh{MakeTopology(corners, last + 1), std::vector<T>(4 * (size_t(last) + 1))};
  Project(camera, last + 1, points.data(), mesh.positions.data());
  return mesh;
}

/// Numbers between -1 and 1, the same for a seed.
template <class T>
std::vector<T> RandomNumbers(size_t count, unsigned seed) {
  std::mt19937 engine(seed);
  std::vector<T> numbers(count);
  for (T& number : numbers) number = T(engine()) / T(2147483648.0) - 1;
  return numbers;
}

/// sum(a * b)
inline double Dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Largest difference between `gradient` and central differences of function(x), over entries for which `wanted` holds.
template <class Function, class Wanted>
double MaxDifference(const Function& function, std::vector<double> x, const std::vector<double>& gradient, double step,
                     const Wanted& wanted) {
  double worst = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!wanted(i)) continue;
    const double old = x[i];
    x[i] = old + step;
    const double above = function(x);
    x[i] = old - step;
    const double below = function(x);
    x[i] = old;
    worst = std::max(worst, std::abs((above - below) / (2 * step) - gradient[i]));
  }
  return worst;
}
template <class Function>
double MaxDifference(const Function& function, const std::vector<double>& x, const std::vector<double>& gradient,
                     double step = 1e-6) {
  return MaxDifference(function, x, gradient, step, [](size_t) { return true; });
}

}  // namespace daumier::raster

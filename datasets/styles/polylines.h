#pragma once
#include "core/random.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

/// Lines of the plane as rows of points, x right and y down.
namespace daumier::datasets {

using Polyline = std::vector<Eigen::Vector2d>;

double LengthOf(const Polyline& line);
/// From the first point to each.
std::vector<double> ArcLengths(const Polyline& line);
Eigen::AlignedBox2d BoxOf(const Polyline& line);
Polyline Reversed(Polyline line);
/// The lines end to end.
Polyline Joined(Polyline first, const Polyline& second);
/// The part between two shares (0 to 1) of the length, `count` points at equal distances; from > to runs backwards. Of
/// a line without length the point, `count` times. @throws Error if there are no points or fewer than 2 are requested.
Polyline Part(const Polyline& line, double from, double to, int count);
/// The whole line so.
Polyline Resampled(const Polyline& line, int count);
/// The share of the length at which the line is nearest to a point.
double ShareNearest(const Polyline& line, const Eigen::Vector2d& point);
Eigen::Vector2d AtShare(const Polyline& line, double share);
/// The index of the nearest of its points.
int NearestIndex(const Polyline& line, const Eigen::Vector2d& point);
double DistanceTo(const Polyline& line, const Eigen::Vector2d& point);
/// (1 - t) a + t b, point by point. @throws Error unless both have the same number of points.
Polyline Mixed(const Polyline& a, const Polyline& b, double t);
/// A smooth curve through points (Catmull-Rom), `count` points at equal distances.
Polyline Smooth(const Polyline& through, int count);
/// An ellipse from an angle to another (degrees, clockwise from the right), `count` points.
Polyline EllipseArc(const Eigen::Vector2d& centre, double half_x, double half_y, double from, double to, int count);
/// Whether a point lies inside a closed polygon (even-odd).
bool IsInside(const Polyline& polygon, const Eigen::Vector2d& point);
/// The pieces of a line outside of (or inside) a polygon, cut where it enters and leaves.
struct LinePiece {
  Polyline points;
  std::vector<int> origin;  ///< Of each point its index on the line; -1 where it was cut.
};
std::vector<LinePiece> Outside(const Polyline& line, const Polyline& polygon);
std::vector<LinePiece> Inside(const Polyline& line, const Polyline& polygon);
/// The line moved along its normal by amplitude sin(2 pi (waves s + phase)), s from 0 to 1 along it.
Polyline Waved(const Polyline& line, double amplitude, double waves, double phase);

/// True with a probability.
inline bool Happens(double probability, Rng& rng) {
  return rng.Uniform() < probability;
}
/// A normal number of a deviation, cut off at twice as much.
double Deviate(double deviation, Rng& rng);

}  // namespace daumier::datasets

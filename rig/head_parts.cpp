#include "rig/head_parts.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "geometry/path.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::rig {
namespace {

constexpr int kFewestOfBall = 12;
constexpr double kOffBall = 0.05, kFarthestCentre = 0.8, kLeastBall = 0.5, kLargestBall = 1.8;  // In radii.
constexpr double kOnBall = 1.12, kBetweenLids = 1.5;                                            // In radii.
constexpr double kOnSkin = 0.5;     // Of a place that lies on the template, cm.
constexpr double kSkinShare = 0.6;  // Of a part that is skin, at least.
constexpr double kInMouth = 0.7, kDeepInMouth = 1.6, kInFrontOfLips = 0.05;  // In widths of the mouth.
constexpr double kBothJaws = 0.2;  // Above and below the line of the lips, in widths of the mouth.
constexpr double kApart = 0.12;    // Between the middles of upper and lower parts of a mouth, in its widths.

/// A connected part.
struct Part {
  std::vector<int> places;
  double area = 0;
  Eigen::RowVector3d middle;
};

std::vector<Part> PartsOf(const HeadSurface& head) {
  std::vector<Part> parts(size_t(head.num_components()), Part{{}, 0, Eigen::RowVector3d::Zero()});
  for (int p = 0; p < head.num_places(); ++p) parts[size_t(head.components[size_t(p)])].places.push_back(p);
  const Eigen::VectorXd areas = geometry::VertexAreas(head.mesh);
  for (Part& part : parts) {
    for (const int p : part.places) {
      part.area += areas[p];
      part.middle += areas[p] * head.mesh.vertices.row(p);
    }
    if (part.area > 0) {
      part.middle /= part.area;
    } else {
      part.middle = head.mesh.vertices(part.places, Eigen::all).colwise().mean();
    }
  }
  return parts;
}

double FarthestFrom(const geometry::Vector3& centre, const HeadSurface& head, const Part& part) {
  double farthest = 0;
  for (const int p : part.places)
    farthest = std::max(farthest, (head.mesh.vertices.row(p).transpose() - centre).norm());
  return farthest;
}

/// The share of a part's places that lie on the template.
double ShareOnTemplate(const TemplateMatch& match, const HeadSurface& head, const Part& part) {
  constexpr size_t kTested = 2000;  // Places, spread evenly.
  const size_t step = std::max<size_t>(1, part.places.size() / kTested);
  size_t num_tested = 0, num_on = 0;
  for (size_t i = 0; i < part.places.size(); i += step) {
    const int p = part.places[i];
    ++num_tested;
    num_on +=
        match.Nearest(head.mesh.vertices.row(p), head.normals.row(p), kOnSkin, [](FaceSide) { return true; }) ? 1 : 0;
  }
  return double(num_on) / double(num_tested);
}

/// The ball of one eye and the parts that belong to it.
struct FoundEye {
  std::optional<Ball> ball;
  std::vector<size_t> parts;
};

FoundEye FindEye(const HeadSurface& head, const std::vector<Part>& parts, const Ball& expected) {
  FoundEye found;
  double largest = 0;
  for (const Part& part : parts) {
    if (part.area <= largest || FarthestFrom(expected.centre, head, part) > 3 * expected.radius) continue;
    const auto ball = FitBall(head.mesh.vertices(part.places, Eigen::all));
    if (!ball || (ball->centre - expected.centre).norm() > kFarthestCentre * expected.radius ||
        ball->radius < kLeastBall * expected.radius || ball->radius > kLargestBall * expected.radius)
      continue;
    largest = part.area;
    found.ball = ball;
  }
  for (size_t i = 0; found.ball && i < parts.size(); ++i)
    if (FarthestFrom(found.ball->centre, head, parts[i]) <= kOnBall * found.ball->radius) found.parts.push_back(i);
  return found;
}

/// Lowest and highest y of a part.
std::pair<double, double> HeightsOf(const HeadSurface& head, const Part& part) {
  const Eigen::VectorXd heights = head.mesh.vertices(part.places, 1);
  return {heights.minCoeff(), heights.maxCoeff()};
}

double WidthOf(const HeadSurface& head, const Part& part) {
  const Eigen::VectorXd x = head.mesh.vertices(part.places, 0);
  return x.maxCoeff() - x.minCoeff();
}

/// Of a part of both jaws: 0 above, 1 below, and between them by the ways along the surface to either.
void ShareJaw(const HeadSurface& head, const Part& part, double line, double margin, std::vector<float>& shares) {
  std::array<std::vector<int>, 2> seeds;
  for (const int p : part.places) {
    if (head.mesh.vertices(p, 1) > line + margin) seeds[0].push_back(p);
    if (head.mesh.vertices(p, 1) < line - margin) seeds[1].push_back(p);
  }
  std::array<geometry::NearestSeeds, 2> ways;
  for (size_t i = 0; i < 2; ++i)
    ways[i] = geometry::FindNearestSeeds(head.mesh.vertices, head.neighbours, seeds[i],
                                         std::numeric_limits<double>::infinity());
  for (const int p : part.places) {
    const double up = ways[0].distances[size_t(p)], down = ways[1].distances[size_t(p)];
    const double t = up + down > 0 ? up / (up + down) : 0;
    shares[size_t(p)] = float(t * t * (3 - 2 * t));
  }
}

/// Height over the line of the lips that divides upper from lower parts: in the middle of the largest gap between their
/// middles, if it is wide enough and near the lips.
double DivisionOf(std::vector<double> heights, double width) {
  std::sort(heights.begin(), heights.end());
  double division = 0, largest = kApart * width;
  for (size_t i = 1; i < heights.size(); ++i) {
    if (heights[i] - heights[i - 1] <= largest) continue;
    largest = heights[i] - heights[i - 1];
    division = 0.5 * (heights[i] + heights[i - 1]);
  }
  return division;
}

}  // namespace

std::optional<Ball> FitBall(const geometry::Points& points) {
  if (points.rows() < kFewestOfBall) return std::nullopt;
  // |p|^2 = 2 c.p + (r^2 - |c|^2), about the mean.
  const Eigen::RowVector3d mean = points.colwise().mean();
  const geometry::Points about = points.rowwise() - mean;
  Eigen::MatrixX4d system(points.rows(), 4);
  system << 2 * about, Eigen::VectorXd::Ones(points.rows());
  const Eigen::ColPivHouseholderQR<Eigen::MatrixX4d> qr(system);
  if (qr.rank() < 4) return std::nullopt;
  const Eigen::Vector4d solution = qr.solve(about.rowwise().squaredNorm());
  const geometry::Vector3 centre = solution.head<3>();
  const double squared = solution[3] + centre.squaredNorm();
  if (!(squared > 0)) return std::nullopt;
  const double radius = std::sqrt(squared);
  const Eigen::VectorXd off = (about.rowwise() - centre.transpose()).rowwise().norm().array() - radius;
  if (std::sqrt(off.squaredNorm() / double(points.rows())) > kOffBall * radius) return std::nullopt;
  return Ball{mean.transpose() + centre, radius};
}

HeadParts FindHeadParts(const TemplateMatch& match, const HeadSurface& head, const std::array<Ball, 2>& eyes) {
  const std::vector<Part> parts = PartsOf(head);
  HeadParts result;
  result.of_components.assign(parts.size(), HeadPart::kAttached);
  result.jaw_shares.assign(size_t(head.num_places()), 0.0f);

  std::vector<bool> is_sorted(parts.size(), false);
  const auto sort_into = [&](size_t part, HeadPart what) {
    result.of_components[part] = what;
    is_sorted[part] = true;
  };
  const FoundEye right = FindEye(head, parts, eyes[0]), left = FindEye(head, parts, eyes[1]);
  if (right.ball && left.ball) {
    result.eyes = {right.ball, left.ball};
    for (const size_t part : right.parts) sort_into(part, HeadPart::kRightEye);
    for (const size_t part : left.parts) sort_into(part, HeadPart::kLeftEye);
  }

  const SeamEdges& lips = match.slits()[size_t(FaceSlit::kMouth)];
  const geometry::Points& registered = match.surface().vertices;
  const Eigen::RowVector3d corner = registered.row(lips.upper.front()), other = registered.row(lips.upper.back()),
                           mouth = 0.5 * (corner + other);
  const double width = (other - corner).norm();
  const double line =
      0.5 * (registered(lips.upper[lips.upper.size() / 2], 1) + registered(lips.lower[lips.lower.size() / 2], 1));
  const double lips_z =
      std::min(registered(lips.upper[lips.upper.size() / 2], 2), registered(lips.lower[lips.lower.size() / 2], 2));
  std::vector<size_t> in_mouth;
  std::vector<double> heights;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (is_sorted[i]) continue;
    double most_front = -std::numeric_limits<double>::infinity();
    for (const int p : parts[i].places) most_front = std::max(most_front, head.mesh.vertices(p, 2));
    const Eigen::RowVector3d from = parts[i].middle - mouth;
    const bool is_behind = most_front < lips_z + kInFrontOfLips * width && from.z() > -kDeepInMouth * width;
    if (is_behind && std::abs(from.x()) < kInMouth * width && std::abs(parts[i].middle.y() - line) < kInMouth * width &&
        FarthestFrom(mouth.transpose(), head, parts[i]) < 2 * kDeepInMouth * width) {
      const auto [lowest, highest] = HeightsOf(head, parts[i]);
      if (lowest < line - kBothJaws * width && highest > line + kBothJaws * width) {
        if (WidthOf(head, parts[i]) >= width) {
          sort_into(i, HeadPart::kWholeMouth);
          ShareJaw(head, parts[i], line, kBothJaws * width, result.jaw_shares);
        } else {  // A tongue.
          sort_into(i, HeadPart::kLowerMouth);
          for (const int p : parts[i].places) result.jaw_shares[size_t(p)] = 1;
        }
        continue;
      }
      in_mouth.push_back(i);
      heights.push_back(parts[i].middle.y() - line);
    }
  }
  const double division = DivisionOf(heights, width);
  for (size_t k = 0; k < in_mouth.size(); ++k) {
    const bool is_lower = heights[k] < division;
    sort_into(in_mouth[k], is_lower ? HeadPart::kLowerMouth : HeadPart::kUpperMouth);
    if (!is_lower) continue;
    for (const int p : parts[in_mouth[k]].places) result.jaw_shares[size_t(p)] = 1;
  }

  // The part with most area on the template is skin, whatever else belongs to it: of a body, little of it is.
  std::vector<double> shares(parts.size(), 0.0);
  size_t main = parts.size();
  double most = 0;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (is_sorted[i]) continue;
    shares[i] = ShareOnTemplate(match, head, parts[i]);
    if (shares[i] * parts[i].area <= most) continue;
    most = shares[i] * parts[i].area;
    main = i;
  }
  DAUMIER_CHECK(main < parts.size(), "no part of the head lies on the registered face");
  for (size_t i = 0; i < parts.size(); ++i) {
    if (is_sorted[i]) continue;
    const bool is_between_lids = FarthestFrom(eyes[0].centre, head, parts[i]) < kBetweenLids * eyes[0].radius ||
                                 FarthestFrom(eyes[1].centre, head, parts[i]) < kBetweenLids * eyes[1].radius;
    if (i == main || shares[i] >= kSkinShare) {
      sort_into(i, HeadPart::kSkin);
    } else if (is_between_lids) {
      sort_into(i, HeadPart::kFlatEye);
    }
  }
  return result;
}

}  // namespace daumier::rig

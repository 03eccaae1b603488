#pragma once
#include "core/files.h"
#include "geometry/obj.h"
#include "geometry/triangulate.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

/// What the reference program for suggestive contours, rtsc 1.6, gives for one head, if it lies next to the checkout.
namespace daumier::testing {

struct RtscReference {
  geometry::TriangleMesh mesh;
  double feature_size = 0;
  Eigen::Vector3d eye;
  /// A row a vertex: position, normal, k1, k2, direction1, direction2, four derivatives, area, n.v, radial curvature,
  /// numerator, denominator.
  Eigen::Matrix<double, Eigen::Dynamic, 23> rows;
  /// Both ends of each segment of suggestive and of occluding contours.
  std::vector<std::array<Eigen::Vector3d, 2>> suggestive, occluding;

  /// `view`: "default" (perspective) or "ortho".
  static std::optional<RtscReference> Load(const std::string& view) {
    const auto data = SharedData();
    if (!data || !std::filesystem::exists(*data / "golden")) return std::nullopt;
    RtscReference reference;
    const geometry::PolygonMesh polygons = geometry::ReadObj(*data / "facewarehouse_topology/warehouse_0.obj");
    reference.mesh = {polygons.vertices, geometry::Triangulate(polygons)};
    const std::string prefix = (*data / ("golden/rtsc_warehouse0_" + view)).string();
    std::istringstream text(RunProcess({"/bin/gzip", "-dc", prefix + ".verts.txt.gz"}).out);
    std::string line, word;
    std::getline(text, line);
    std::istringstream header(line);
    while (header >> word) {
      if (word == "feature_size") header >> reference.feature_size;
      if (word == "eye") header >> reference.eye.x() >> reference.eye.y() >> reference.eye.z();
    }
    std::getline(text, line);
    reference.rows.resize(reference.mesh.vertices.rows(), 23);
    for (Eigen::Index v = 0; v < reference.rows.rows(); ++v) {
      for (int column = 0; column < 23; ++column) text >> reference.rows(v, column);
    }
    EXPECT_TRUE(text) << prefix << ".verts.txt.gz ends early";
    reference.suggestive = ReadSegments(prefix + ".sc.txt");
    reference.occluding = ReadSegments(prefix + ".c.txt");
    return reference;
  }

 private:
  static std::vector<std::array<Eigen::Vector3d, 2>> ReadSegments(const std::string& path) {
    std::istringstream text(ReadFile(path));
    std::vector<std::array<Eigen::Vector3d, 2>> segments;
    std::array<Eigen::Vector3d, 2> segment;
    std::string alpha;  // Not always a number.
    const auto read = [&](Eigen::Vector3d& end) { return bool(text >> end.x() >> end.y() >> end.z() >> alpha); };
    while (read(segment[0]) && read(segment[1])) segments.push_back(segment);
    return segments;
  }
};

/// Its 3 x 3 solver, which forgets to update its last pivot.
inline bool SolveWithStalePivot(const Eigen::Matrix3d& w, Eigen::Vector3d& m) {
  const double d0 = w(0, 0), l10 = w(0, 1) / d0, l20 = w(0, 2) / d0;
  const double d1 = w(1, 1) - l10 * w(0, 1), l21 = (w(1, 2) - l10 * w(0, 2)) / d1, d2 = w(2, 2);
  const double y0 = m[0], y1 = m[1] - l10 * y0, y2 = m[2] - l20 * y0 - l21 * y1;
  m[2] = y2 / d2;
  m[1] = y1 / d1 - l21 * m[2];
  m[0] = y0 / d0 - l10 * m[1] - l20 * m[2];
  return true;
}

/// Share of values that are within 1e-3 of max(|value|, median |value|) of the reference.
inline double ShareThatAgrees(const Eigen::VectorXd& ours, const Eigen::VectorXd& theirs) {
  std::vector<double> magnitudes(theirs.size());
  for (Eigen::Index v = 0; v < theirs.size(); ++v) magnitudes[v] = std::abs(theirs[v]);
  std::nth_element(magnitudes.begin(), magnitudes.begin() + theirs.size() / 2, magnitudes.end());
  const double median = magnitudes[theirs.size() / 2];
  int num_agree = 0;
  for (Eigen::Index v = 0; v < theirs.size(); ++v)
    num_agree += std::abs(ours[v] - theirs[v]) <= 1e-3 * std::max(std::abs(theirs[v]), median);
  return double(num_agree) / double(theirs.size());
}

}  // namespace daumier::testing

#include "rig/seam_line.h"

#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::rig {
namespace {

/// On a sheet of 10 cm a side with a slit of 5 cm; the lower edge is 0.2 cm lower.
SeamLine LineOfSheet() {
  testing::SlitSheet sheet = testing::MakeSlitSheet(16);
  sheet.mesh.vertices *= 10;
  const SeamEdges& edges = sheet.slits[0];
  for (size_t i = 1; i + 1 < edges.lower.size(); ++i) sheet.mesh.vertices(edges.lower[i], 1) -= 0.2;
  return MiddleOfSlit(edges, sheet.mesh.vertices);
}

/// With a groove 0.15 cm deep.
template <class Line>
HeadSurface SheetWithGroove(Line&& groove) {
  geometry::TriangleMesh mesh = testing::FlatSheet(160);
  mesh.vertices *= 10;
  for (auto p : mesh.vertices.rowwise()) {
    const double away = (p.y() - groove(p.x())) / 0.12;
    p.z() = -0.15 * std::exp(-away * away);
  }
  return MakeHeadSurface(mesh);
}

TEST(SeamLine, IsTheMiddleBetweenTheEdgesOfASlit) {
  const SeamLine line = LineOfSheet();
  EXPECT_NEAR(line.width, 5, 1e-12);
  EXPECT_NEAR(line.HeightAt(2.5), -0.1, 1e-9);
  EXPECT_NEAR(line.HeightAt(0), 0, 1e-9);
  EXPECT_NEAR(line.HeightAt(7), 0, 1e-9) << "beyond a corner that of the corner";
  EXPECT_NEAR(line.DepthAt(1), 0, 1e-9);
  EXPECT_LT((line.Coordinates({3.5, 5.25, 0.5}) - geometry::Vector3(1, 0.25, 0.5)).norm(), 1e-9);
}

TEST(SeamLine, IsDrawnToAGroove) {
  const auto groove = [](double x) { return 5.1 + 0.05 * std::sin(x); };
  SeamLine line = LineOfSheet();
  DrawToGroove(SheetWithGroove(groove), line);
  for (const double along : {0.5, 1.0, 2.0, 2.5, 3.0, 4.0, 4.5})
    EXPECT_NEAR(line.HeightAt(along), groove(2.5 + along) - 5, 0.05) << along;
}

TEST(SeamLine, StaysWithoutAGrooveWithinReach) {
  const SeamLine before = LineOfSheet();
  for (const double groove : {0.0, 6.5}) {
    SeamLine line = before;
    DrawToGroove(SheetWithGroove([&](double) { return groove; }), line);
    EXPECT_LT((line.heights - before.heights).cwiseAbs().maxCoeff(), 1e-9) << groove;
  }
}

}  // namespace
}  // namespace daumier::rig

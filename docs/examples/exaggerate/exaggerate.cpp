// Exaggerates a surface by its own curvature: of a cap of a ball with a bump for a nose, the bump grows.
#include <daumier/faces/exaggeration.h>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace daumier;

int main() {
  constexpr int kSide = 41;  // Vertices a row.
  faces::FaceTemplate cap;
  cap.neutral.resize(kSide * kSide, 3);
  std::vector<int> border, nose, none;
  for (int v = 0; v < kSide * kSide; ++v) {
    const double x = (v % kSide - kSide / 2) * 0.4, y = (v / kSide - kSide / 2) * 0.4, from_middle = std::hypot(x, y);
    cap.neutral.row(v) << x, y,
        std::sqrt(15 * 15 - from_middle * from_middle) + 1.5 * std::exp(-from_middle * from_middle);
    if (std::max(std::abs(x), std::abs(y)) > 7.5) border.push_back(v);
    if (from_middle < 1.5) nose.push_back(v);
  }
  for (int y = 0; y + 1 < kSide; ++y)
    for (int x = 0; x + 1 < kSide; ++x) {
      const int a = y * kSide + x, b = a + 1, c = a + kSide, d = c + 1;
      cap.triangles.conservativeResize(cap.triangles.rows() + 2, 3);
      cap.triangles.bottomRows(2) << a, b, d, a, d, c;
    }
  // What stays: eyes, mouth and the border of the neck; ears are damped, a nose grows as a whole.
  cap.annotation.regions = {{"eyes", none}, {"mouth", none}, {"neck_border", border}, {"ears", none}, {"nose", nose}};

  const std::vector<geometry::Points> levels = faces::Exaggerate(cap, cap.neutral, {.gammas = {0, 0.1, 0.2}});
  for (const geometry::Points& level : levels)
    std::printf("the tip is %.2f cm in front of the cap\n", level.col(2).maxCoeff() - level(kSide / 2 * kSide, 2));
}

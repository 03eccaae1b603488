#include "geometry/surface_samples.h"

#include "core/error.h"
#include "geometry/normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::geometry {

SurfaceSamples SampleSurface(const TriangleMesh& mesh, int count, Rng& rng) {
  const Eigen::VectorXd areas = TriangleAreas(mesh);
  std::vector<double> ends(size_t(areas.size()));  // Of each triangle's stretch of the total area.
  std::partial_sum(areas.begin(), areas.end(), ends.begin());
  DAUMIER_CHECK(!ends.empty() && ends.back() > 0 && std::isfinite(ends.back()),
                "a surface without area has no samples");
  SurfaceSamples samples;
  samples.triangles.reserve(size_t(count));
  samples.weights.reserve(2 * size_t(count));
  for (int s = 0; s < count; ++s) {
    const double at = rng.Uniform() * ends.back(), root = std::sqrt(rng.Uniform()), share = rng.Uniform();
    samples.triangles.push_back(static_cast<int>(std::upper_bound(ends.begin(), ends.end(), at) - ends.begin()));
    // Rounded so that the third weight is not negative either.
    const auto w0 = static_cast<float>(1 - root);
    samples.weights.push_back(w0);
    samples.weights.push_back(std::min(static_cast<float>(root * (1 - share)), 1 - w0));
  }
  return samples;
}

}  // namespace daumier::geometry

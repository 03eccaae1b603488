#include "fitting/texture_eyes.h"

#include "core/error.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace daumier::fitting {
namespace {

constexpr double kMostGaze = 35 * std::numbers::pi / 180;
/// Cosine to the viewer from which on the ball's side counts as seen.
constexpr double kSeenFacing = 0.2;
/// Iris of a plain eye: sines of the angles at the border of pupil and iris, and colours.
constexpr float kPlainPupil = 0.15F, kPlainIris = 0.36F;
const Eigen::Vector3f kWhite(0.95F, 0.945F, 0.935F), kBrown(0.36F, 0.22F, 0.11F), kBlack(0.03F, 0.03F, 0.04F);

struct EyePixel {
  float x, y, lightness;
};

float LightnessAt(const PictureLayer& layer, size_t pixel) {
  const float* const c = layer.colours.data() + 3 * pixel;
  return 0.299F * c[0] + 0.587F * c[1] + 0.114F * c[2];
}

std::vector<EyePixel> EyePixels(const PictureLayer& eyes, const Eigen::Vector2d& middle, double reach) {
  std::vector<EyePixel> pixels;
  const int top = std::max(0, int(middle.y() - reach)), bottom = std::min(eyes.height - 1, int(middle.y() + reach));
  const int left = std::max(0, int(middle.x() - reach)), right = std::min(eyes.width - 1, int(middle.x() + reach));
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const size_t pixel = size_t(row) * size_t(eyes.width) + size_t(column);
      const float x = float(column) + 0.5F, y = float(row) + 0.5F;
      if (eyes.confidence[pixel] <= 0 || std::hypot(x - middle.x(), y - middle.y()) > reach) continue;
      pixels.push_back({x, y, LightnessAt(eyes, pixel)});
    }
  }
  return pixels;
}

/// Mean colours by the distance from the iris' centre, in shares of its radius, of what the picture shows.
class IrisProfile {
 public:
  IrisProfile(const PictureLayer& eyes, const IrisDisc& iris) {
    std::array<float, kNumBins> counts{};
    means_.fill(Eigen::Vector3f::Zero());
    const double reach = iris.radius;
    for (const EyePixel& pixel : EyePixels(eyes, iris.centre, reach)) {
      const double share = std::hypot(pixel.x - iris.centre.x(), pixel.y - iris.centre.y()) / iris.radius;
      const size_t bin = std::min(kNumBins - 1, size_t(share * kNumBins));
      const size_t from = 3 * (size_t(pixel.y) * size_t(eyes.width) + size_t(pixel.x));
      means_[bin] += Eigen::Vector3f(eyes.colours[from], eyes.colours[from + 1], eyes.colours[from + 2]);
      ++counts[bin];
    }
    for (size_t bin = 0; bin < kNumBins; ++bin)
      if (counts[bin] > 0) means_[bin] /= counts[bin];
    for (size_t bin = 0; bin < kNumBins; ++bin) {
      for (size_t away = 1; counts[bin] == 0 && away < kNumBins; ++away) {
        if (bin >= away && counts[bin - away] > 0) means_[bin] = means_[bin - away], counts[bin] = -1;
        if (counts[bin] == 0 && bin + away < kNumBins && counts[bin + away] > 0)
          means_[bin] = means_[bin + away], counts[bin] = -1;
      }
    }
  }

  Eigen::Vector3f At(float share) const {
    const float place = std::clamp(share * kNumBins - 0.5F, 0.0F, float(kNumBins - 1));
    const auto first = std::min(size_t(place), kNumBins - 2);
    const float t = place - float(first);
    return (1 - t) * means_[first] + t * means_[first + 1];
  }

 private:
  static constexpr size_t kNumBins = 12;
  std::array<Eigen::Vector3f, kNumBins> means_;
};

}  // namespace

std::optional<IrisDisc> FindIris(const PictureLayer& eyes, const Eigen::Vector2d& middle, double reach) {
  constexpr size_t kLeastPixels = 20, kMostPixels = 700;
  constexpr double kLeastContrast = 0.06;
  constexpr int kNumRadii = 12;
  std::vector<EyePixel> pixels = EyePixels(eyes, middle, reach);
  if (pixels.size() < kLeastPixels) return std::nullopt;
  float left = pixels[0].x, right = left, top = pixels[0].y, bottom = top;
  for (const EyePixel& p : pixels) {
    left = std::min(left, p.x), right = std::max(right, p.x), top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  }
  const double width = right - left + 1, step = std::max(1.0, width / 28);
  if (const size_t stride = pixels.size() / kMostPixels + 1; stride > 1) {
    std::vector<EyePixel> some;
    for (size_t i = 0; i < pixels.size(); i += stride) some.push_back(pixels[i]);
    pixels = std::move(some);
  }
  double total = 0;
  for (const EyePixel& p : pixels) total += p.lightness;
  const auto count = double(pixels.size());

  std::optional<IrisDisc> best;
  double best_score = 0, contrast = 0;
  std::array<double, kNumRadii> sums{}, counts{};
  for (double y = top; y <= bottom; y += step) {
    for (double x = left; x <= right; x += step) {
      sums.fill(0), counts.fill(0);
      for (const EyePixel& p : pixels) {
        // The least radius that holds the pixel.
        const double share = std::hypot(p.x - x, p.y - y) / width;
        const int k = std::max(0, int(std::ceil((share - 0.12) / 0.38 * (kNumRadii - 1))));
        if (k < kNumRadii) sums[size_t(k)] += p.lightness, ++counts[size_t(k)];
      }
      double inside = 0, num_inside = 0;
      for (int k = 0; k < kNumRadii; ++k) {
        inside += sums[size_t(k)], num_inside += counts[size_t(k)];
        if (num_inside < 4 || count - num_inside < 4) continue;
        const double difference = (total - inside) / (count - num_inside) - inside / num_inside;
        const double score = num_inside * (count - num_inside) / (count * count) * difference * difference;
        if (difference <= 0 || score <= best_score) continue;
        best_score = score, contrast = difference;
        best = IrisDisc{{x, y}, width * (0.12 + 0.38 * k / (kNumRadii - 1))};
      }
    }
  }
  return contrast < kLeastContrast ? std::nullopt : best;
}

Eigen::Matrix3d TurnToIris(const ShownEye& eye, const PictureCamera& camera, const IrisDisc& iris) {
  const double radius = eye.points.col(2).maxCoeff();
  const Eigen::Vector2d in_view = camera.linear.inverse() * (iris.centre - camera.shift);
  const geometry::Vector3 viewer(0, 0, camera.view.distance);
  const geometry::Vector3 ray = geometry::Vector3((in_view.x() - camera.view.centre) / camera.view.focal,
                                                  (camera.view.centre - in_view.y()) / camera.view.focal, -1)
                                    .normalized();
  // The nearer point of the ray on the ball, or else that of the ray that is nearest to it.
  const geometry::Vector3 to_centre = eye.centre - viewer;
  const double along = ray.dot(to_centre), away = (to_centre - along * ray).squaredNorm();
  const geometry::Vector3 hit = viewer + (along - std::sqrt(std::max(0.0, radius * radius - away))) * ray;
  const geometry::Vector3 direction = (eye.rotation.transpose() * (hit - eye.centre)).normalized();
  const geometry::Vector3 ahead = geometry::Vector3::UnitZ();
  const double angle = std::acos(std::clamp(direction.z(), -1.0, 1.0));
  geometry::Vector3 axis = ahead.cross(direction);
  if (axis.norm() < 1e-9) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(std::min(angle, kMostGaze), axis.normalized()).toRotationMatrix();
}

EyeChart MakeEyeChart(const rig::TextureSpace& space, const rig::TexelMap& texels, rig::TextureChart chart) {
  EyeChart made;
  std::vector<int> row_of(space.charts.size(), -1), rows;
  for (size_t t = 0; t < space.charts.size(); ++t) {
    if (space.charts[t] != chart) continue;
    row_of[t] = int(rows.size());
    rows.push_back(int(t));
  }
  made.corners.resize(Eigen::Index(rows.size()), 3);
  for (size_t row = 0; row < rows.size(); ++row) made.corners.row(Eigen::Index(row)) = space.triangles.row(rows[row]);
  if (!rows.empty()) made.first_vertex = made.corners.minCoeff();
  made.corners.array() -= made.first_vertex;
  for (int i = 0; i < texels.num_texels(); ++i) {
    const int t = texels.triangles[size_t(i)];
    if (t < 0 || row_of[size_t(t)] < 0) continue;
    made.texels.push_back(i);
    made.triangles.push_back(row_of[size_t(t)]);
    made.weights.push_back(texels.weights[size_t(i)]);
  }
  return made;
}

std::vector<Eigen::Vector3f> PaintEye(const EyeChart& chart, const ShownEye& eye, const PictureCamera& camera,
                                      const PictureLayer& eyes, float shade) {
  const int num_vertices = int(eye.points.rows());
  DAUMIER_CHECK(chart.corners.size() > 0 && chart.corners.maxCoeff() < num_vertices,
                "an eye of {} points with a chart of {} triangles", num_vertices, chart.corners.rows());
  const geometry::Points at_centre = eye.centre.transpose();
  const Eigen::Vector2d middle = camera.PlacesOf(at_centre).row(0).transpose();
  const double pixels_per_cm = camera.scale() * camera.view.focal / (camera.view.distance - eye.centre.z());
  const double radius = eye.points.col(2).maxCoeff();
  const std::optional<IrisDisc> iris = FindIris(eyes, middle, 1.1 * radius * pixels_per_cm);
  const Eigen::Matrix3d turn = iris ? TurnToIris(eye, camera, *iris) : Eigen::Matrix3d::Identity();
  // Sine of the angle at the border of the iris.
  const auto border = iris ? float(std::min(0.95, iris->radius / (pixels_per_cm * radius))) : kPlainIris;
  const std::optional<IrisProfile> profile =
      iris ? std::optional<IrisProfile>(std::in_place, eyes, *iris) : std::nullopt;

  const Eigen::Matrix3d posed_from_eye = eye.rotation * turn;
  const size_t num_texels = chart.texels.size();
  std::vector<TexelSight> sights(num_texels);
  std::vector<float> distances(num_texels);  // Sine of the angle from the front pole; 2 behind.
  for (size_t i = 0; i < num_texels; ++i) {
    geometry::Vector3 point = geometry::Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      point += double(chart.weights[i][k]) * eye.points.row(chart.corners(chart.triangles[i], k)).transpose();
    const geometry::Vector3 direction = point.normalized();
    distances[i] = direction.z() > 0 ? float(std::hypot(direction.x(), direction.y())) : 2.0F;
    if (!iris) continue;
    const geometry::Vector3 posed = eye.centre + posed_from_eye * point;
    const geometry::Vector3 to_viewer = (geometry::Vector3(0, 0, camera.view.distance) - posed).normalized();
    const double facing = (posed_from_eye * direction).dot(to_viewer);
    const geometry::Points at_point = posed.transpose();
    sights[i].place = camera.PlacesOf(at_point).row(0).transpose().cast<float>();
    sights[i].sight = float(std::clamp((facing - kSeenFacing) / kSeenFacing, 0.0, 1.0));
    sights[i].shade = shade;
  }
  const TexelColours seen = SampleLayer(eyes, sights, true);

  // The white of the eye: what is seen of it, and white elsewhere.
  TexelColours white = seen;
  for (size_t i = 0; i < num_texels; ++i)
    if (distances[i] < 1.15F * border) white.weights[i] = 0;
  const VertexValues known = MeansAtVertices(chart.corners, num_vertices, chart.triangles, chart.weights, white);
  const Eigen::MatrixXf rest = kWhite.transpose().replicate(num_vertices, 1);
  const Eigen::MatrixXf fill = FillSurface(chart.corners, known, rest, {.stiffness = 1, .rest_weight = 0.05});

  std::vector<Eigen::Vector3f> colours(num_texels);
  for (size_t i = 0; i < num_texels; ++i) {
    Eigen::Vector3f& colour = colours[i];
    colour.setZero();
    for (int k = 0; k < 3; ++k)
      colour += chart.weights[i][k] * fill.row(chart.corners(chart.triangles[i], k)).transpose();
    const float soft = std::clamp((1.05F * border - distances[i]) / (0.1F * border), 0.0F, 1.0F);
    if (profile) {
      colour += soft * (profile->At(distances[i] / border) / shade - colour);
    } else {
      const float inner = std::clamp((kPlainPupil - distances[i]) / 0.02F + 0.5F, 0.0F, 1.0F);
      colour += soft * (kBrown + inner * (kBlack - kBrown) - colour);
    }
    colour += seen.weights[i] * (seen.colours[i] - colour);
  }
  return colours;
}

}  // namespace daumier::fitting

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
/// Whites of eyes lie in the shadow of lids and lashes: what is darker than this share of the bright ones is not theirs.
constexpr float kShadowed = 0.55F, kBright = 0.75F;
/// Whites that are darker than this are made lighter, up to so much.
constexpr float kDarkWhite = 0.6F, kMostLightening = 1.8F;
/// Least share of an opening that the mask must call eye.
constexpr double kLeastEyeShare = 0.4;
const Eigen::Vector3f kLightnessOf(0.299F, 0.587F, 0.114F);
const Eigen::Vector3f kWhite(0.95F, 0.945F, 0.935F), kBrown(0.36F, 0.22F, 0.11F), kBlack(0.03F, 0.03F, 0.04F);

/// An eyeball as a disc of a picture, pixels.
struct EyeInPicture {
  Eigen::Vector2d middle;
  double radius;
};

EyeInPicture PlaceOf(const ShownEye& eye, const PictureCamera& camera) {
  const geometry::Points at_centre = eye.centre.transpose();
  const double pixels_per_cm = camera.scale() * camera.view.focal / (camera.view.distance - eye.centre.z());
  return {camera.PlacesOf(at_centre).row(0).transpose(), pixels_per_cm * eye.points.col(2).maxCoeff()};
}

/// Whether a point lies in a polygon [even-odd rule].
bool IsInOpening(const PicturePoints& polygon, double x, double y) {
  bool is_inside = false;
  for (Eigen::Index i = 0, j = polygon.rows() - 1; i < polygon.rows(); j = i++) {
    const Eigen::RowVector2d a = polygon.row(i), b = polygon.row(j);
    if ((a.y() > y) != (b.y() > y) && x < a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()))
      is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace

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

render::Image EyesWithin(const render::Image& mask, std::span<const PicturePoints> openings) {
  render::Image eyes(mask.height, mask.width, 1, uint8_t(PictureClass::kBackground));
  const ClassSet open = {PictureClass::kEyes, PictureClass::kSkin, PictureClass::kBrows};
  for (const PicturePoints& polygon : openings) {
    if (polygon.rows() < 3) continue;
    const Eigen::RowVector2d low = polygon.colwise().minCoeff(), high = polygon.colwise().maxCoeff();
    std::vector<size_t> inside;
    size_t num_eye = 0;
    const int top = std::max(0, int(low.y())), bottom = std::min(mask.height - 1, int(high.y()));
    const int left = std::max(0, int(low.x())), right = std::min(mask.width - 1, int(high.x()));
    for (int row = top; row <= bottom; ++row) {
      for (int column = left; column <= right; ++column) {
        const size_t pixel = size_t(row) * size_t(mask.width) + size_t(column);
        if (!open.holds(mask.pixels[pixel]) || !IsInOpening(polygon, column + 0.5, row + 0.5)) continue;
        inside.push_back(pixel);
        num_eye += mask.pixels[pixel] == uint8_t(PictureClass::kEyes);
      }
    }
    const bool all = double(num_eye) < kLeastEyeShare * double(inside.size());
    for (const size_t pixel : inside)
      if (all || mask.pixels[pixel] == uint8_t(PictureClass::kEyes)) eyes.pixels[pixel] = uint8_t(PictureClass::kEyes);
  }
  return eyes;
}

std::vector<EyeLook> FindLooks(std::span<const ShownEye> shown, const PictureCamera& camera, const PictureLayer& eyes,
                               const Eigen::Vector3f& skin) {
  constexpr float kLightest = 0.75F, kLeastDifference = 0.06F;
  constexpr float kDarkest = 0.45F, kPaleSkin = 0.4F;
  constexpr double kLeastOfBest = 0.4;
  const auto find = [&](const EyeInPicture& eye, const IrisSizes& sizes) {
    std::optional<IrisDisc> disc = FindIris(eyes, eye.middle, eye.radius, sizes);
    if (!disc) return disc;
    const Eigen::Vector3f colour = IrisProfile(eyes, *disc).At(0.6F);
    const float lightness = colour.dot(kLightnessOf), of_skin = skin.dot(kLightnessOf);
    const float difference = (colour / (colour.sum() + 1e-3F) - skin / (skin.sum() + 1e-3F)).norm();
    if ((lightness > of_skin && of_skin > kPaleSkin) ||
        (difference < kLeastDifference && lightness > kLightest * of_skin))
      disc.reset();
    return disc;
  };
  std::vector<EyeLook> looks(shown.size());
  const EyeLook* best = nullptr;
  const auto is_better = [](const EyeLook& a, const EyeLook* b) {
    return a.disc && (b == nullptr || a.disc->score > b->disc->score);
  };
  for (size_t i = 0; i < shown.size(); ++i) {
    const EyeInPicture eye = PlaceOf(shown[i], camera);
    looks[i].disc = find(eye, {});
    if (looks[i].disc) looks[i].border = float(looks[i].disc->radius / eye.radius);
    if (is_better(looks[i], best)) best = &looks[i];
  }
  for (size_t i = 0; i < shown.size(); ++i) {
    EyeLook& look = looks[i];
    if (best == nullptr) {
      look.border = kPlainIris;
      const EyeInPicture eye = PlaceOf(shown[i], camera);
      look.cover = MedianOfEye(eyes, eye.middle, eye.radius);
      if (look.cover && look.cover->dot(kLightnessOf) > kDarkest * skin.dot(kLightnessOf)) look.cover.reset();
      continue;
    }
    if (&look != best) {
      const EyeInPicture eye = PlaceOf(shown[i], camera);
      const double size = best->border;
      look.disc = find(eye, {0.93 * size, 1.07 * size, size});
      look.border = best->border;
      if (look.disc && look.disc->score < kLeastOfBest * best->disc->score) look.disc.reset();
    }
    if (look.disc) look.profile.emplace(eyes, *look.disc);
  }
  for (EyeLook& look : looks)
    if (!look.profile && best != nullptr) look.profile = best->profile;
  return looks;
}

std::vector<Eigen::Vector3f> PaintEye(const EyeChart& chart, const ShownEye& eye, const PictureCamera& camera,
                                      const PictureLayer& eyes, const EyeLook& look, float shade, Gaze gaze) {
  const int num_vertices = int(eye.points.rows());
  DAUMIER_CHECK(chart.corners.size() > 0 && chart.corners.maxCoeff() < num_vertices,
                "an eye of {} points with a chart of {} triangles", num_vertices, chart.corners.rows());
  if (look.cover) return std::vector<Eigen::Vector3f>(chart.texels.size(), *look.cover / shade);
  const std::optional<IrisDisc>& iris = look.disc;
  const Eigen::Matrix3d turn = iris ? TurnToIris(eye, camera, *iris) : Eigen::Matrix3d::Identity();
  const float border = look.border;
  const EyeInPicture place = PlaceOf(eye, camera);

  const bool is_turned_back = gaze == Gaze::kAhead;
  const Eigen::Matrix3d posed_from_eye = is_turned_back ? Eigen::Matrix3d(eye.rotation * turn) : eye.rotation;
  const geometry::Vector3 axis = is_turned_back ? geometry::Vector3::UnitZ() : geometry::Vector3(turn.col(2));
  const size_t num_texels = chart.texels.size();
  std::vector<TexelSight> sights(num_texels);
  std::vector<float> distances(num_texels);  // Sine of the angle from the axis; 2 behind.
  for (size_t i = 0; i < num_texels; ++i) {
    geometry::Vector3 point = geometry::Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      point += double(chart.weights[i][k]) * eye.points.row(chart.corners(chart.triangles[i], k)).transpose();
    const geometry::Vector3 direction = point.normalized();
    distances[i] = direction.dot(axis) > 0 ? float(direction.cross(axis).norm()) : 2.0F;
    if (!iris) continue;
    const geometry::Vector3 posed = eye.centre + posed_from_eye * point;
    const geometry::Vector3 to_viewer = (geometry::Vector3(0, 0, camera.view.distance) - posed).normalized();
    const double facing = (posed_from_eye * direction).dot(to_viewer);
    const geometry::Points at_point = posed.transpose();
    sights[i].place = camera.PlacesOf(at_point).row(0).transpose().cast<float>();
    sights[i].sight = float(std::clamp((facing - kSeenFacing) / kSeenFacing, 0.0, 1.0));
  }
  TexelColours seen = SampleLayer(eyes, sights);
  const float bright = WhiteLightness(eyes, place.middle, 1.1 * place.radius, iris).value_or(kDarkWhite * shade);
  const float lightening = std::clamp(kDarkWhite * shade / std::max(bright, 1e-3F), 1.0F, kMostLightening);
  for (size_t i = 0; i < num_texels; ++i) {
    if (distances[i] < 1.1F * border) continue;
    const float lightness = seen.colours[i].dot(kLightnessOf) / std::max(bright, 1e-3F);
    seen.weights[i] *= std::clamp((lightness - kShadowed) / (kBright - kShadowed), 0.0F, 1.0F);
    seen.colours[i] *= lightening;
  }

  // The white of the eye: what is seen of it, and white elsewhere.
  TexelColours white = seen;
  for (size_t i = 0; i < num_texels; ++i) {
    const float grey = white.colours[i].dot(kLightnessOf);
    white.colours[i] = (white.colours[i] + Eigen::Vector3f::Constant(grey)) / (2 * shade);
    if (distances[i] < 1.15F * border) white.weights[i] = 0;
  }
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
    if (look.profile) {
      colour += soft * (look.profile->At(distances[i] / border) / shade - colour);
    } else {
      const float inner = std::clamp((kPlainPupil - distances[i]) / 0.02F + 0.5F, 0.0F, 1.0F);
      colour += soft * (kBrown + inner * (kBlack - kBrown) - colour);
    }
    if (distances[i] < 1.1F * border)
      colour += seen.weights[i] * (seen.colours[i] / shade - colour);
    else
      colour += seen.weights[i] * (white.colours[i] - colour);
  }
  return colours;
}

}  // namespace daumier::fitting

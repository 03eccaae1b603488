#include "fitting/texture_projection.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/normals.h"
#include "raster/camera.h"
#include "raster/visibility.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace daumier::fitting {
namespace {

/// Levels of mip maps: halves, quarters ... 1 / 16.
constexpr int kNumMips = 5;

/// Depths of a head in the view's own pixels, enlarged by `scale` about (left, top).
class DepthView {
 public:
  DepthView(const rig::TextureSpace& space, const geometry::Points& posed, const PortraitView& view, int side) {
    const PicturePoints places = Projected(posed, view);
    std::vector<char> is_used(size_t(posed.rows()), 0);
    for (const int v : space.triangles.reshaped()) is_used[size_t(v)] = 1;
    Eigen::AlignedBox2d box;
    for (Eigen::Index v = 0; v < places.rows(); ++v)
      if (is_used[size_t(v)] != 0) box.extend(places.row(v).transpose());
    const double longer = std::max(box.sizes().maxCoeff(), 1e-6);
    scale_ = (side - 4) / longer;
    origin_ = box.min().array() - 2 / scale_;
    camera_.focal = view.focal * scale_;
    camera_.centre_x = (view.centre - origin_.x()) * scale_;
    camera_.centre_y = (view.centre - origin_.y()) * scale_;
    camera_.distance = view.distance;
    raster::MeshTopology topology;  // Without edges, which visibility does not read.
    topology.num_vertices = int(posed.rows());
    topology.triangles.reserve(size_t(space.triangles.rows()));
    for (const auto& t : space.triangles.rowwise()) topology.triangles.push_back({t[0], t[1], t[2]});
    const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> points = posed.cast<float>();
    std::vector<float> positions(4 * size_t(posed.rows()));
    raster::Project(camera_, posed.rows(), points.data(), positions.data());
    const auto pixels = [&](double size) { return int(std::ceil(size * scale_)) + 4; };
    raster::FindVisibleTriangles(topology, positions.data(), pixels(box.sizes().y()), pixels(box.sizes().x()),
                                 raster::Facing::kFront, raster_);
  }

  /// 0 hidden .. 1: nothing lies in front of a point by more than `tolerance` cm and what a slope of `tangent` rises
  /// within one and a half pixels.
  float Seen(const Eigen::Vector3f& point, float tolerance, float tangent) const {
    const double w = camera_.distance - point.z(), to_pixels = camera_.focal / w;
    const double x = camera_.centre_x + to_pixels * point.x() - 0.5, y = camera_.centre_y - to_pixels * point.y() - 0.5;
    const double depth = -to_pixels * point.z() - to_pixels * tolerance - 1.5 * tangent;
    const int column = int(std::floor(x)), row = int(std::floor(y));
    const double on_x = x - column, on_y = y - row;
    double seen = 0;
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        const int at_row = std::clamp(row + r, 0, raster_.height - 1);
        const int at_column = std::clamp(column + c, 0, raster_.width - 1);
        const double nearest = raster_.depth[size_t(at_row) * size_t(raster_.width) + size_t(at_column)];
        if (depth <= nearest) seen += (c == 1 ? on_x : 1 - on_x) * (r == 1 ? on_y : 1 - on_y);
      }
    }
    return float(seen);
  }

 private:
  double scale_ = 1;
  Eigen::Vector2d origin_;
  raster::Camera camera_;
  raster::Raster<float> raster_;
};

/// log2 of the pixels of the picture that a texel covers along an axis, of each triangle.
std::vector<float> LevelsOfTriangles(const rig::TextureSpace& space, const PicturePoints& places, int size) {
  std::vector<float> levels(size_t(space.triangles.rows()));
  const auto area = [](const auto& a, const auto& b, const auto& c) {
    return std::abs((b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y()));
  };
  for (Eigen::Index t = 0; t < space.triangles.rows(); ++t) {
    const auto v = space.triangles.row(t), u = space.uv_triangles.row(t);
    const double pixels = area(places.row(v[0]), places.row(v[1]), places.row(v[2]));
    const double in_atlas = area(space.uv.row(u[0]), space.uv.row(u[1]), space.uv.row(u[2])) * size * size;
    if (pixels > in_atlas && in_atlas > 0) levels[size_t(t)] = float(0.5 * std::log2(pixels / in_atlas));
  }
  return levels;
}

float SmoothStep(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

}  // namespace

PicturePoints PictureCamera::PlacesOf(const geometry::Points& posed) const {
  PicturePoints places = Projected(posed, view) * linear.transpose();
  places.rowwise() += shift.transpose();
  return places;
}

double PictureCamera::scale() const {
  return std::sqrt(std::abs(linear.determinant()));
}

std::vector<TexelSight> FindTexelSights(const rig::TextureSpace& space, const rig::TexelMap& texels,
                                        const geometry::Points& posed, const PictureCamera& camera,
                                        const SightOptions& options) {
  DAUMIER_CHECK(space.triangles.size() > 0 && space.triangles.maxCoeff() < posed.rows(),
                "a texture space of {} triangles with {} vertices", space.triangles.rows(), posed.rows());
  const DepthView depths(space, posed, camera.view, options.side);
  const geometry::Points normals = geometry::VertexNormals({posed, space.triangles});
  const std::vector<float> levels = LevelsOfTriangles(space, camera.PlacesOf(posed), texels.size);
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Rows points = posed.cast<float>(), directions = normals.cast<float>();
  const Eigen::Matrix2f linear = camera.linear.cast<float>();
  const Eigen::Vector2f shift = camera.shift.cast<float>();
  const auto focal = float(camera.view.focal), centre = float(camera.view.centre),
             distance = float(camera.view.distance);

  std::vector<TexelSight> sights(size_t(texels.num_texels()));
  OnAllCores(texels.num_texels(), [&](int64_t i) {
    const int t = texels.triangles[size_t(i)];
    if (t < 0) return;
    const Eigen::Vector3f& w = texels.weights[size_t(i)];
    const int* const corner = space.triangles.data() + 3 * size_t(t);
    const auto mixed = [&](const Rows& of) -> Eigen::Vector3f {
      return w[0] * of.row(corner[0]) + w[1] * of.row(corner[1]) + w[2] * of.row(corner[2]);
    };
    const Eigen::Vector3f point = mixed(points), normal = mixed(directions).normalized();
    TexelSight& sight = sights[size_t(i)];
    const float to_pixels = focal / (distance - point.z());
    sight.place = linear * Eigen::Vector2f(centre + to_pixels * point.x(), centre - to_pixels * point.y()) + shift;
    sight.level = levels[size_t(t)];
    const float facing = normal.dot((Eigen::Vector3f(0, 0, distance) - point).normalized());
    sight.sight = SmoothStep(float(options.hidden_facing), float(options.full_facing), facing);
    if (sight.sight <= 0) return;
    const float tangent = std::sqrt(std::max(0.0F, 1 - facing * facing)) / facing;
    sight.sight *= depths.Seen(point, float(options.tolerance_cm), tangent);
  });
  return sights;
}

LayerSampler::LayerSampler(const PictureLayer& layer) : height_(layer.height), width_(layer.width) {
  // The sides are padded so that they can be halved; the border repeats.
  constexpr int kMultiple = 1 << (kNumMips - 1);
  const auto padded = [](int side) { return (side + kMultiple - 1) / kMultiple * kMultiple; };
  raster::Texture<float> texture{padded(height_), padded(width_), 4, {}};
  texture.texels.resize(size_t(texture.height) * size_t(texture.width) * 4);
  for (int row = 0; row < texture.height; ++row) {
    for (int column = 0; column < texture.width; ++column) {
      const size_t from = size_t(std::min(row, height_ - 1)) * size_t(width_) + size_t(std::min(column, width_ - 1));
      float* const to = texture.texels.data() + 4 * (size_t(row) * size_t(texture.width) + size_t(column));
      std::copy_n(layer.colours.data() + 3 * from, 3, to);
      to[3] = layer.confidence[from];
    }
  }
  mip_map_ = raster::MakeMipMap(texture);
  if (mip_map_.size() > kNumMips) mip_map_.resize(kNumMips);
}

TexelColours LayerSampler::Sample(const std::vector<TexelSight>& sights) const {
  TexelColours sampled{std::vector<Eigen::Vector3f>(sights.size(), Eigen::Vector3f::Zero()),
                       std::vector<float>(sights.size(), 0.0F)};
  OnAllCores(int64_t(sights.size()), [&](int64_t i) {
    const TexelSight& sight = sights[size_t(i)];
    if (sight.sight <= 0) return;
    const Eigen::Vector2f& p = sight.place;
    if (!(p.x() >= 0 && p.y() >= 0 && p.x() < float(width_) && p.y() < float(height_))) return;
    const std::array<float, 2> uv = {p.x() / float(mip_map_[0].width), 1 - p.y() / float(mip_map_[0].height)};
    std::array<float, 4> value{};
    raster::LookUpMipMap(mip_map_, raster::Wrap::kClamp, 1, uv.data(), &sight.level, nullptr, value.data());
    sampled.weights[size_t(i)] = sight.sight * value[3];
    sampled.colours[size_t(i)] = Eigen::Vector3f(value[0], value[1], value[2]);
  });
  return sampled;
}

}  // namespace daumier::fitting

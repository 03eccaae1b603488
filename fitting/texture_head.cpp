#include "fitting/texture_head.h"

#include "core/error.h"
#include "core/parallel.h"
#include "faces/appearance/scalp.h"
#include "faces/appearance/skin_fields.h"
#include "geometry/topology.h"
#include "render/draw.h"
#include "rig/material_colours.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace daumier::fitting {
namespace {

using rig::TextureChart;

/// Gutter, texels of 1024.
constexpr int kGutterReach = 8;
/// Longest side of a head in a picture, as multiples of the texture's; larger pictures are made smaller first.
constexpr double kLargestPicture = 1.5;
/// Least share of the head's pixels that hair must have to count.
constexpr double kLeastHair = 0.01;
/// Rims of lids and inner lips are darker than the skin next to them.
constexpr float kRimShade = 0.82F;
constexpr float kLeastEyeShade = 0.4F;
const Eigen::Vector3f kMouthColour(0.38F, 0.11F, 0.11F);

bool IsSkin(TextureChart chart) {
  return chart == TextureChart::kSkin || chart == TextureChart::kNeckCap || chart == TextureChart::kLidRim;
}

/// The part of a picture that holds the head, with its mask, and the camera that sees it.
struct HeadCut {
  render::Image picture, mask;
  PictureCamera camera;
  double head_height;  ///< Pixels.
};

HeadCut CutHead(const render::Image& picture, const render::Image& mask, const PictureCamera& camera,
                const geometry::Points& posed, const geometry::Triangles& triangles, double most_pixels) {
  const PicturePoints places = camera.PlacesOf(posed);
  Eigen::AlignedBox2d box;
  for (const int v : triangles.reshaped()) box.extend(places.row(v).transpose());
  const double border = 0.04 * box.sizes().maxCoeff() + 2;
  const auto side = [&](double low, double high, int size) {
    const int first = std::clamp(int(std::floor(low - border)), 0, size - 1);
    return std::pair(first, std::clamp(int(std::ceil(high + border)), first + 1, size));
  };
  const auto [left, right] = side(box.min().x(), box.max().x(), picture.width);
  const auto [top, bottom] = side(box.min().y(), box.max().y(), picture.height);
  const int factor = std::max(1, int(std::ceil(std::max(right - left, bottom - top) / most_pixels)));
  const int width = (right - left) / factor, height = (bottom - top) / factor;

  HeadCut cut{render::Image(bottom - top, right - left, 3), render::Image(height, width, 1), camera,
              box.sizes().y() / factor};
  render::Paste(cut.picture, render::ToRgb(picture), -top, -left);
  if (factor > 1) cut.picture = render::Resize(cut.picture, height, width);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      cut.mask.at(row, column) = mask.at(top + row * factor + factor / 2, left + column * factor + factor / 2);
  cut.camera.linear /= factor;
  cut.camera.shift = (camera.shift - Eigen::Vector2d(left, top)) / factor;
  return cut;
}

uint8_t ByteOf(float value) {
  return uint8_t(std::clamp(255 * value + 0.5F, 0.0F, 255.0F));
}

}  // namespace

TextureGuide MakeTextureGuide(const faces::FaceTemplate& face, const std::vector<int>& joined_from_face,
                              int num_vertices) {
  DAUMIER_CHECK(int(joined_from_face.size()) == face.num_vertices(), "numbers of {} vertices, expected {}",
                joined_from_face.size(), face.num_vertices());
  TextureGuide guide{std::vector<int>(size_t(num_vertices), -1), Eigen::VectorXf::Zero(num_vertices),
                     Eigen::VectorXf::Zero(num_vertices)};
  const Eigen::VectorXd scalp = faces::Scalp(face).weights(), beard = faces::SkinField(face, "beard");
  double brow = 0;
  for (int l = 17; l <= 26; ++l) brow += 0.1 * face.neutral(face.annotation.landmarks[size_t(l)], 1);
  const double forehead = face.neutral(face.annotation.hairline_vertex, 1) - brow;
  for (int v = 0; v < face.num_vertices(); ++v) {
    const int joined = joined_from_face[size_t(v)];
    if (joined < 0) continue;
    if (!face.annotation.mirror.empty())
      guide.mirror[size_t(joined)] = joined_from_face[size_t(face.annotation.mirror[size_t(v)])];
    guide.scalp[joined] = float(scalp[v]);
    const double above = faces::SmoothBetween(0.2, 0.5, (face.neutral(v, 1) - brow) / forehead);
    guide.hair_painted[joined] = float(std::max({scalp[v], beard[v], above}));
  }
  return guide;
}

TextureGuide MakeTextureGuide(const faces::FaceTemplate& face, const rig::HeadRig& rig) {
  std::vector<int> joined_from_face(size_t(face.num_vertices()), -1);
  const std::vector<int>& finished = rig.finished_vertices();
  for (size_t joined = 0; joined < finished.size(); ++joined)
    if (finished[joined] < face.num_vertices()) joined_from_face[size_t(finished[joined])] = int(joined);
  return MakeTextureGuide(face, joined_from_face, rig.texture_space().triangles.maxCoeff() + 1);
}

ShownHead ShownHeadOf(const rig::HeadRig& rig, const geometry::Points& face, const PortraitPose& pose,
                      const PictureCamera& camera, const std::optional<PortraitLight>& light) {
  const rig::RiggedHead head = rig.On(face, {{}, Eigen::MatrixXf(face.size(), 0)});
  ShownHead shown{rig::JoinedMesh(head).vertices, {}, pose, camera, light};
  for (size_t side = 0; side < std::min<size_t>(2, head.eyes.size()); ++side)
    shown.eye_centres[side] = head.eyes[side].centre;
  return shown;
}

HeadPainter::HeadPainter(rig::TextureSpace space, TextureGuide guide, const TextureOptions& options)
    : space_(std::move(space)), guide_(std::move(guide)), options_(options), texels_(space_.Rasterise(options.size)) {
  const int num_vertices = int(guide_.mirror.size());
  DAUMIER_CHECK(space_.triangles.maxCoeff() < num_vertices && guide_.scalp.size() == num_vertices &&
                    guide_.hair_painted.size() == num_vertices,
                "a texture space of {} vertices with a guide of {}, {} and {}", space_.triangles.maxCoeff() + 1,
                num_vertices, guide_.scalp.size(), guide_.hair_painted.size());
  DAUMIER_CHECK(space_.materials.empty() || Eigen::Index(space_.materials.size()) == space_.triangles.rows(),
                "{} materials for {} triangles", space_.materials.size(), space_.triangles.rows());
  gutter_ = rig::NearestShownTexels(texels_, std::max(1, kGutterReach * options.size / 1024));
  mirrored_ = FindMirroredCorners(space_, guide_.mirror);
  std::vector<int> skin, mouth;
  for (int t = 0; t < space_.triangles.rows(); ++t) {
    if (IsSkin(space_.charts[size_t(t)])) skin.push_back(t);
    if (space_.charts[size_t(t)] == TextureChart::kMouth) mouth.push_back(t);
  }
  const geometry::Triangles skin_triangles = space_.triangles(skin, Eigen::all);
  surface_.emplace(skin_triangles, num_vertices);
  eyes_ = {MakeEyeChart(space_, texels_, TextureChart::kRightEye),
           MakeEyeChart(space_, texels_, TextureChart::kLeftEye)};
  // Rings of the mouth from its vertices that are skin too.
  constexpr float kMouthRings = 4;
  mouth_depth_.setOnes(num_vertices);
  std::vector<char> is_skin(size_t(num_vertices), 0);
  for (const int v : skin_triangles.reshaped()) is_skin[size_t(v)] = 1;
  const geometry::Triangles mouth_triangles = space_.triangles(mouth, Eigen::all);
  std::vector<int> lips;
  for (const int v : mouth_triangles.reshaped())
    if (is_skin[size_t(v)] != 0) lips.push_back(v);
  if (lips.empty()) return;
  const std::vector<int> rings = geometry::RingsFrom(geometry::VertexNeighbours(mouth_triangles, num_vertices), lips);
  for (int v = 0; v < num_vertices; ++v)
    if (rings[size_t(v)] >= 0) mouth_depth_[v] = std::min(1.0F, float(rings[size_t(v)]) / kMouthRings);
}

HeadTexture HeadPainter::Paint(const ShownHead& head, const render::Image& picture, const render::Image& mask) const {
  const int num_vertices = int(guide_.mirror.size());
  DAUMIER_CHECK(head.vertices.rows() == num_vertices, "a head of {} vertices, expected {}", head.vertices.rows(),
                num_vertices);
  DAUMIER_CHECK(picture.height == mask.height && picture.width == mask.width && mask.channels == 1,
                "a picture of {} x {} with a mask of {} x {} x {}", picture.height, picture.width, mask.height,
                mask.width, mask.channels);
  DAUMIER_CHECK(!options_.delight || head.light, "a head has no light to delight its texture by");
  const geometry::Points posed = Posed(head.vertices, head.pose);
  const HeadCut cut =
      CutHead(picture, mask, head.camera, posed, space_.triangles, kLargestPicture * double(options_.size));
  const double margin = options_.margin * cut.head_height;
  using enum PictureClass;
  const std::vector<TexelSight> sights =
      FindTexelSights(space_, texels_, posed, cut.camera, options_.delight ? head.light : std::nullopt);

  const auto see = [&](const ClassSet& classes) {
    return SampleLayer(LayerOf(cut.picture, cut.mask, classes, margin), sights, options_.delight);
  };
  const TexelColours skin = see({kSkin, kBrows, kLips, kEars});
  const auto num_hair = std::ranges::count(cut.mask.pixels, uint8_t(kHair));
  std::optional<TexelColours> hair;
  if (double(num_hair) > kLeastHair * double(cut.mask.pixels.size())) {
    hair = see({kHair});
    for (size_t i = 0; i < hair->weights.size(); ++i)
      if (hair->weights[i] > 0) hair->weights[i] *= At(i, guide_.hair_painted);
  }
  const SurfaceTexture surface =
      CompleteSurface(space_, texels_, mirrored_, guide_, *surface_, skin, hair ? &*hair : nullptr, options_.fill);
  std::vector<Eigen::Vector3f> colours = surface.colours;
  PaintEyes(head, posed, cut.camera, LayerOf(cut.picture, cut.mask, {kEyes}, 0.5 * margin), colours);
  return TextureOf(surface, colours);
}

/// The value of a texel of numbers at vertices.
float HeadPainter::At(size_t i, const Eigen::VectorXf& values) const {
  const int* const corner = space_.triangles.data() + 3 * size_t(texels_.triangles[i]);
  const Eigen::Vector3f& w = texels_.weights[i];
  return w[0] * values[corner[0]] + w[1] * values[corner[1]] + w[2] * values[corner[2]];
}

void HeadPainter::PaintEyes(const ShownHead& head, const geometry::Points& posed, const PictureCamera& camera,
                            const PictureLayer& eyes, std::vector<Eigen::Vector3f>& colours) const {
  const Eigen::Matrix3d rotation = RotationOf(head.pose);
  float shade = 1;
  if (options_.delight) {
    const Eigen::Vector3f ahead = rotation.col(2).cast<float>();
    raster::Shade(*head.light, 1, ahead.data(), &shade);
  }
  for (size_t side = 0; side < 2; ++side) {
    const EyeChart& chart = eyes_[side];
    if (chart.texels.empty()) continue;
    const int num_points = chart.corners.maxCoeff() + 1;
    ShownEye eye{{}, rotation, head.vertices.middleRows(chart.first_vertex, num_points)};
    eye.points.rowwise() -= head.eye_centres[side].transpose();
    const geometry::Points centre = head.eye_centres[side].transpose();
    eye.centre = Posed(centre, head.pose).row(0).transpose();
    const std::vector<Eigen::Vector3f> painted = PaintEye(chart, eye, camera, eyes, std::max(shade, kLeastEyeShade));
    for (size_t i = 0; i < painted.size(); ++i) colours[size_t(chart.texels[i])] = painted[i];
  }
}

HeadTexture HeadPainter::TextureOf(const SurfaceTexture& surface, std::vector<Eigen::Vector3f> colours) const {
  HeadTexture texture{render::Image(options_.size, options_.size, 3),
                      render::Image(options_.size, options_.size, 3, 0)};
  double num_skin = 0;
  for (size_t i = 0; i < colours.size(); ++i) {
    const int t = texels_.triangles[i];
    if (t < 0) continue;
    Eigen::Vector3f& colour = colours[i];
    switch (space_.charts[size_t(t)]) {
      case TextureChart::kSkin: {
        const std::array<float, 3> shares = {1 - surface.seen[i] - surface.mirrored[i], surface.seen[i],
                                             surface.mirrored[i]};
        for (size_t k = 0; k < 3; ++k) texture.sources.pixels[3 * i + k] = ByteOf(shares[k]);
        ++num_skin;
        texture.filled += shares[0], texture.seen += shares[1], texture.mirrored += shares[2];
        break;
      }
      case TextureChart::kLidRim:
        colour *= kRimShade;
        break;
      case TextureChart::kMouth: {
        const float depth = At(i, mouth_depth_);
        colour = (1 - depth) * kRimShade * colour + depth * kMouthColour;
        break;
      }
      case TextureChart::kTeeth:
      case TextureChart::kTongue:
        if (!space_.materials.empty()) colour = rig::MaterialColour(space_.materials[size_t(t)]);
        break;
      default:
        break;
    }
  }
  for (double* const share : {&texture.seen, &texture.mirrored, &texture.filled}) *share /= std::max(num_skin, 1.0);
  for (size_t i = 0; i < colours.size(); ++i) {
    if (gutter_[i] < 0) continue;
    for (int k = 0; k < 3; ++k) texture.picture.pixels[3 * i + size_t(k)] = ByteOf(colours[size_t(gutter_[i])][k]);
  }
  return texture;
}

}  // namespace daumier::fitting

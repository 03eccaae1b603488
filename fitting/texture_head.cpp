#include "fitting/texture_head.h"

#include "core/error.h"
#include "core/parallel.h"
#include "faces/appearance/scalp.h"
#include "faces/appearance/skin_fields.h"
#include "geometry/normals.h"
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
/// Half the width of a chin, of the height of the forehead, and least share of hair there that makes a beard: other hair over
/// cheeks hangs before them.
constexpr double kChinShare = 0.5;
constexpr float kLeastBeard = 0.15F;
/// Rims of lids and inner lips are darker than the skin next to them.
constexpr float kRimShade = 0.82F;
constexpr float kLeastEyeShade = 0.4F;
/// An eye's opening is wider than the polygon of its six landmarks.
constexpr double kOpening = 1.03;
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
                     Eigen::VectorXf::Zero(num_vertices),        Eigen::VectorXf::Zero(num_vertices),
                     Eigen::VectorXf::Zero(num_vertices),        Eigen::VectorXf::Zero(num_vertices)};
  const Eigen::VectorXd scalp = faces::Scalp(face).weights(), beard = faces::SkinField(face, "beard");
  double brow = 0;
  for (int l = 17; l <= 26; ++l) brow += 0.1 * face.neutral(face.annotation.landmarks[size_t(l)], 1);
  const double middle = face.neutral(face.annotation.landmarks[30], 0);  // The tip of the nose.
  const double forehead = face.neutral(face.annotation.hairline_vertex, 1) - brow;
  for (int v = 0; v < face.num_vertices(); ++v) {
    const int joined = joined_from_face[size_t(v)];
    if (joined < 0) continue;
    if (!face.annotation.mirror.empty())
      guide.mirror[size_t(joined)] = joined_from_face[size_t(face.annotation.mirror[size_t(v)])];
    guide.scalp[joined] = float(scalp[v]);
    const double above = faces::SmoothBetween(0.2, 0.5, (face.neutral(v, 1) - brow) / forehead);
    guide.hair_painted[joined] = float(std::max(scalp[v], above));
    guide.beard[joined] = float(beard[v]);
    if (std::abs(face.neutral(v, 0) - middle) < kChinShare * forehead) guide.chin[joined] = float(beard[v]);
  }
  if (const auto ears = face.annotation.regions.find("ears"); ears != face.annotation.regions.end())
    for (const int v : ears->second)
      if (joined_from_face[size_t(v)] >= 0) guide.ears[joined_from_face[size_t(v)]] = 1;
  for (const size_t first : {size_t(36), size_t(42)}) {
    guide.lids.emplace_back();
    for (size_t l = first; l < first + 6; ++l)
      guide.lids.back().push_back(joined_from_face[size_t(face.annotation.landmarks[l])]);
    if (std::ranges::min(guide.lids.back()) < 0) guide.lids.pop_back();
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
                      const PictureCamera& camera, const std::optional<PortraitLight>& light,
                      const Eigen::MatrixXf& albedo) {
  const rig::RiggedHead head = rig.On(face, {{}, Eigen::MatrixXf(face.size(), 0)});
  ShownHead shown{rig::JoinedMesh(head).vertices, {}, pose, camera, light};
  for (size_t side = 0; side < std::min<size_t>(2, head.eyes.size()); ++side)
    shown.eye_centres[side] = head.eyes[side].centre;
  if (albedo.size() == 0) return shown;
  DAUMIER_CHECK(albedo.rows() == face.rows() && albedo.cols() == 3, "a face of {} vertices with an albedo of {} x {}",
                face.rows(), albedo.rows(), albedo.cols());
  const Eigen::RowVector3f mean = albedo.colwise().mean();
  shown.albedo = mean.replicate(shown.vertices.rows(), 1);
  for (size_t joined = 0; joined < rig.finished_vertices().size(); ++joined)
    if (const int v = rig.finished_vertices()[joined]; v < albedo.rows())
      shown.albedo.row(Eigen::Index(joined)) = albedo.row(v);
  return shown;
}

HeadPainter::HeadPainter(rig::TextureSpace space, TextureGuide guide, const TextureOptions& options)
    : space_(std::move(space)), guide_(std::move(guide)), options_(options), texels_(space_.Rasterise(options.size)) {
  const int num_vertices = int(guide_.mirror.size());
  DAUMIER_CHECK(space_.triangles.maxCoeff() < num_vertices && guide_.scalp.size() == num_vertices &&
                    guide_.hair_painted.size() == num_vertices && guide_.ears.size() == num_vertices &&
                    guide_.beard.size() == num_vertices && guide_.chin.size() == num_vertices,
                "a texture space of {} vertices with a guide of {}, {}, {} and {}", space_.triangles.maxCoeff() + 1,
                num_vertices, guide_.scalp.size(), guide_.hair_painted.size(), guide_.ears.size());
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
  const std::vector<TexelSight> sights = FindTexelSights(space_, texels_, posed, cut.camera);

  const auto see = [&](const ClassSet& classes) {
    PictureLayer layer = LayerOf(cut.picture, cut.mask, classes, margin);
    if (options_.delight) DoubtOverexposed(cut.picture, layer);
    return SampleLayer(layer, sights);
  };
  TexelColours skin;
  std::optional<TexelColours> hair;
  PictureLayer eyes;
  OnAllCores(2, [&](int64_t part) {
    if (part == 0) {
      skin = see({kSkin, kBrows, kLips, kEars});
      return;
    }
    eyes = LayerOf(cut.picture, EyesOf(posed, cut.camera, cut.mask), {kEyes}, 0.5 * margin);
    const auto num_hair = std::ranges::count(cut.mask.pixels, uint8_t(kHair));
    if (double(num_hair) <= kLeastHair * double(cut.mask.pixels.size())) return;
    hair = see({kHair});
  });
  const VertexValues skin_of_picture = AtVertices(skin);
  TextureGuide guide = guide_;
  if (hair) {
    guide = GuideFor(skin_of_picture, AtVertices(*hair));
    for (size_t i = 0; i < hair->weights.size(); ++i)
      if (hair->weights[i] > 0) hair->weights[i] *= At(i, guide.hair_painted);
    DoubtOutliers(AtVertices(*hair), nullptr, *hair);
  }
  DoubtOutliers(skin_of_picture, &guide_.ears, skin);
  std::optional<PortraitLight> light;
  if (options_.delight) {
    const geometry::Points normals = geometry::VertexNormals({posed, space_.triangles});
    light = head.light;
    if (options_.fit_light) light = FitLight(normals, skin_of_picture, *light);
    const Eigen::VectorXf shades = WithContrast(ShadesOf(normals, *light), options_.light_share);
    DivideByShades(space_, texels_, shades, skin);
    if (hair) DivideByShades(space_, texels_, shades, *hair);
  }
  const SurfaceTexture surface = CompleteSurface(space_, texels_, mirrored_, guide, *surface_, skin,
                                                 hair ? &*hair : nullptr, head.albedo, options_.fill);
  std::vector<Eigen::Vector3f> colours = surface.colours;
  PaintEyes(head, cut.camera, eyes, light, MedianColour(skin_of_picture, Eigen::Vector3f::Ones()), colours);
  HeadTexture texture = TextureOf(surface, colours);
  texture.light = light;
  return texture;
}

/// Hair is painted where beards grow, too, if the picture shows hair on the chin or the upper lip.
TextureGuide HeadPainter::GuideFor(const VertexValues& skin, const VertexValues& hair) const {
  TextureGuide guide = guide_;
  const float of_hair = hair.weights.dot(guide.chin), of_skin = skin.weights.dot(guide.chin);
  if (of_hair > kLeastBeard * (of_hair + of_skin)) guide.hair_painted = guide.hair_painted.cwiseMax(guide.beard);
  return guide;
}

/// The mask's eyes within the openings of lids, if the guide has these.
render::Image HeadPainter::EyesOf(const geometry::Points& posed, const PictureCamera& camera,
                                  const render::Image& mask) const {
  std::vector<PicturePoints> openings;
  for (const std::vector<int>& lids : guide_.lids) {
    openings.push_back(camera.PlacesOf(posed(lids, Eigen::all)));
    const Eigen::RowVector2d middle = openings.back().colwise().mean();
    openings.back() = ((openings.back().rowwise() - middle) * kOpening).rowwise() + middle;
  }
  return openings.empty() ? mask : EyesWithin(mask, openings);
}

VertexValues HeadPainter::AtVertices(const TexelColours& colours) const {
  return MeansAtVertices(space_.triangles, int(guide_.mirror.size()), texels_.triangles, texels_.weights, colours);
}

/// Reduces weights of colours that differ from the median: where `where` (a vertex; null: everywhere) is 1, and as far as
/// they are seen from the side, where pixels of what is behind get into them.
void HeadPainter::DoubtOutliers(const VertexValues& at_vertices, const Eigen::VectorXf* where,
                                TexelColours& colours) const {
  const InlierMeasure measure(at_vertices);
  OnAllCores(int64_t(colours.weights.size()), [&](int64_t texel) {
    const auto i = size_t(texel);
    if (colours.weights[i] <= 0) return;
    const float share = where == nullptr ? 1.0F : std::max(At(i, *where), 1 - colours.weights[i]);
    if (share > 0) colours.weights[i] *= 1 - share * (1 - measure(colours.colours[i]));
  });
}

/// The value of a texel of numbers at vertices.
float HeadPainter::At(size_t i, const Eigen::VectorXf& values) const {
  const int* const corner = space_.triangles.data() + 3 * size_t(texels_.triangles[i]);
  const Eigen::Vector3f& w = texels_.weights[i];
  return w[0] * values[corner[0]] + w[1] * values[corner[1]] + w[2] * values[corner[2]];
}

void HeadPainter::PaintEyes(const ShownHead& head, const PictureCamera& camera, const PictureLayer& eyes,
                            const std::optional<PortraitLight>& light, const Eigen::Vector3f& skin,
                            std::vector<Eigen::Vector3f>& colours) const {
  const Eigen::Matrix3d rotation = RotationOf(head.pose);
  const geometry::Points ahead = rotation.col(2).transpose();
  const float shade = light ? WithContrast(ShadesOf(ahead, *light), options_.light_share)[0] : 1.0F;
  std::vector<ShownEye> shown;
  std::vector<const EyeChart*> charts;
  for (size_t side = 0; side < 2; ++side) {
    const EyeChart& chart = eyes_[side];
    if (chart.texels.empty()) continue;
    ShownEye eye{{}, rotation, head.vertices.middleRows(chart.first_vertex, chart.corners.maxCoeff() + 1)};
    eye.points.rowwise() -= head.eye_centres[side].transpose();
    const geometry::Points centre = head.eye_centres[side].transpose();
    eye.centre = Posed(centre, head.pose).row(0).transpose();
    shown.push_back(std::move(eye)), charts.push_back(&chart);
  }
  const std::vector<EyeLook> looks = FindLooks(shown, camera, eyes, skin);
  for (size_t i = 0; i < shown.size(); ++i) {
    const std::vector<Eigen::Vector3f> painted =
        PaintEye(*charts[i], shown[i], camera, eyes, looks[i], std::max(shade, kLeastEyeShade),
                 options_.keep_gaze ? Gaze::kShown : Gaze::kAhead);
    for (size_t k = 0; k < painted.size(); ++k) colours[size_t(charts[i]->texels[k])] = painted[k];
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
    // Too bright a colour keeps its hue.
    const Eigen::Vector3f& colour = colours[size_t(gutter_[i])];
    const float brightest = std::max(1.0F, colour.maxCoeff());
    for (int k = 0; k < 3; ++k) texture.picture.pixels[3 * i + size_t(k)] = ByteOf(colour[k] / brightest);
  }
  return texture;
}

}  // namespace daumier::fitting

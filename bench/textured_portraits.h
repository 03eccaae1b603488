#pragma once
#include "datasets/build/portrait_buffers.h"
#include "datasets/build/portrait_pose.h"
#include "datasets/read/portrait_camera.h"
#include "faces/appearance/portrait_head.h"
#include "faces/morphable_model.h"
#include "fitting/texture_head.h"
#include "geometry/normals.h"
#include "raster/camera.h"
#include "raster/rasterise.h"
#include "raster/texture.h"
#include "rig/texture_space.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <vector>

/// Portraits of known heads for bench/head_textures.cpp: what they show from other sides, and what a texture shows there.
namespace daumier {

inline constexpr int kPortraitPixels = 448;
inline constexpr datasets::PortraitOptics kPortraitOptics = {kPortraitPixels, 1015.0 * kPortraitPixels / 224, 100};
using PoseNumbers = std::array<float, 6>;

/// A random head with all that is true of it.
struct KnownHead {
  geometry::Points face;  ///< V x 3 of the model.
  faces::Looks looks;
  faces::PortraitHead head;
  PoseNumbers pose{};
  datasets::SphericalLight light{};
};

/// Person i: identity N(0, 1), every second one with an expression; looks, pose within 30 degrees and light at random.
inline KnownHead MakeKnownHead(const faces::MorphableModel& model, const faces::HeadDresser& dresser, int i) {
  Rng rng = Stream(7, "head texture", uint64_t(i));
  std::vector<float> x(faces::kNumCoefficients, 0.0F);
  for (Eigen::Index k = 0; k < model.identity.cols(); ++k) x[size_t(k)] = float(rng.Normal());
  for (int k = 0; k < 3 && i % 2 == 1; ++k)
    x[faces::kExpressionSlot.first + size_t(rng.Below(model.expression_names.size()))] = float(rng.Uniform(0, 0.5));
  KnownHead known{faces::Reconstruct(model, x).vertices, faces::DrawLooks(rng), {}};
  known.head = dresser.Dress(known.face, known.looks);
  const geometry::Points landmarks = known.face(model.face_template.annotation.landmarks, Eigen::all);
  known.pose = datasets::DrawPose(landmarks, kPortraitOptics, {.yaw = 30, .pitch = 12, .roll = 8}, rng);
  known.light = datasets::DrawLight(rng);
  return known;
}

/// The pose turned about the vertical axis of the head.
template <class Pose>
Pose TurnedPose(Pose pose, double degrees) {
  pose[1] += float(degrees * std::numbers::pi / 180);
  return pose;
}

inline constexpr int kPortraitSamples = 2;

/// What the camera sees of a known head: colour = albedo x light, of 2 x 2 samples a pixel.
struct KnownView {
  render::Image picture, mask;
  std::vector<uint8_t> is_face, is_eye;  ///< A pixel: all samples are skin, brow, lip or ear; are eye.
};

inline KnownView ViewOf(const KnownHead& known, const PoseNumbers& pose) {
  const render::PictureBuffers buffers =
      datasets::DrawBuffers(known.head, datasets::PortraitCamera(kPortraitOptics, pose), known.light, kPortraitSamples);
  KnownView view{render::Image(kPortraitPixels, kPortraitPixels, 3), datasets::MaskOf(buffers), {}, {}};
  view.is_face.assign(size_t(kPortraitPixels) * kPortraitPixels, 1);
  view.is_eye = view.is_face;
  using enum PictureClass;
  const fitting::ClassSet face = {kSkin, kBrows, kLips, kEars};
  for (int row = 0; row < kPortraitPixels; ++row) {
    for (int column = 0; column < kPortraitPixels; ++column) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      const size_t pixel = size_t(row) * kPortraitPixels + size_t(column);
      for (int sample = 0; sample < 4; ++sample) {
        const size_t at = size_t(2 * row + sample / 2) * size_t(buffers.width) + size_t(2 * column + sample % 2);
        const float* const c = buffers.albedo.data() + 3 * at;
        const float shade = buffers.is_covered(at) ? buffers.shade[at] : 1;
        sum += buffers.is_covered(at) ? Eigen::Vector3f(c[0], c[1], c[2]) * shade : Eigen::Vector3f(0.55F, 0.6F, 0.65F);
        view.is_face[pixel] &= uint8_t(buffers.is_covered(at) && face.holds(buffers.classes[at]));
        view.is_eye[pixel] &= uint8_t(buffers.classes[at] == uint8_t(kEyes));
      }
      for (int k = 0; k < 3; ++k)
        view.picture.at(row, column, k) = uint8_t(std::clamp(255 * sum[k] / 4 + 0.5F, 0.0F, 255.0F));
    }
  }
  return view;
}

/// A textured head as a camera sees it.
struct TexturedView {
  render::Image picture;
  std::vector<uint8_t> source;  ///< A pixel: 0 neither skin nor eye, 1 seen, 2 mirrored, 3 filled, 4 eye.
};

/// texture.picture over posed vertices of the space; lit by shade^share of `light` where it is divided by that.
inline TexturedView DrawTextured(const rig::TextureSpace& space, const geometry::Points& vertices,
                                 const fitting::PortraitPose& pose, const fitting::HeadTexture& texture,
                                 const fitting::PortraitLight* light, double share = 1, int pixels = kPortraitPixels) {
  const geometry::Points posed = fitting::Posed(vertices, pose);
  const geometry::Points normals = geometry::VertexNormals({posed, space.triangles});
  const int side = pixels * kPortraitSamples;
  raster::Camera camera;
  camera.focal *= side / 224.0, camera.centre_x = camera.centre_y = side / 2.0;
  raster::MeshTopology topology;
  topology.num_vertices = int(posed.rows());
  for (const auto& t : space.triangles.rowwise()) topology.triangles.push_back({t[0], t[1], t[2]});
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> points = posed.cast<float>();
  std::vector<float> positions(4 * size_t(posed.rows()));
  raster::Project(camera, posed.rows(), points.data(), positions.data());
  raster::Raster<float> raster;
  raster::Rasterise(topology, positions.data(), side, side, raster::Facing::kFront, raster);
  raster::Texture<float> colours{texture.picture.height, texture.picture.width, 3, {}};
  for (const uint8_t byte : texture.picture.pixels) colours.texels.push_back(float(byte) / 255.0F);

  TexturedView view{render::Image(pixels, pixels, 3), std::vector<uint8_t>(size_t(pixels) * size_t(pixels), 0)};
  for (int row = 0; row < pixels; ++row) {
    for (int column = 0; column < pixels; ++column) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int sample = 0; sample < 4; ++sample) {
        const size_t at = size_t(2 * row + sample / 2) * size_t(side) + size_t(2 * column + sample % 2);
        const int t = raster.triangle[at];
        if (t < 0) {
          sum += Eigen::Vector3f(0.55F, 0.6F, 0.65F);
          continue;
        }
        const Eigen::Vector3d b(raster.barycentric[2 * at], raster.barycentric[2 * at + 1],
                                1 - raster.barycentric[2 * at] - raster.barycentric[2 * at + 1]);
        Eigen::Vector2d uv = Eigen::Vector2d::Zero();
        geometry::Vector3 normal = geometry::Vector3::Zero();
        for (int k = 0; k < 3; ++k) {
          uv += b[k] * space.uv.row(space.uv_triangles(t, k)).transpose();
          normal += b[k] * normals.row(space.triangles(t, k)).transpose();
        }
        const Eigen::Vector2f at_uv = uv.cast<float>();
        Eigen::Vector3f colour;
        raster::LookUpTexture(colours, raster::Wrap::kClamp, 1, at_uv.data(), nullptr, colour.data());
        const Eigen::Vector3f direction = normal.normalized().cast<float>();
        float shade = 1;
        if (light) raster::Shade(*light, 1, direction.data(), &shade);
        if (light && share < 1) shade = fitting::WithContrast(Eigen::VectorXf::Constant(1, shade), share)[0];
        sum += colour * std::max(shade, 0.0F);
        uint8_t& source = view.source[size_t(row) * size_t(pixels) + size_t(column)];
        const rig::TextureChart chart = space.charts[size_t(t)];
        if (chart == rig::TextureChart::kRightEye || chart == rig::TextureChart::kLeftEye) source = 4;
        if (sample != 0 || chart != rig::TextureChart::kSkin) continue;
        const int texel_row = std::clamp(int((1 - uv.y()) * texture.sources.height), 0, texture.sources.height - 1);
        const int texel_column = std::clamp(int(uv.x() * texture.sources.width), 0, texture.sources.width - 1);
        const auto share = [&](int k) { return texture.sources.at(texel_row, texel_column, k); };
        source = share(1) > 127 ? 1 : share(2) > 127 ? 2 : 3;
      }
      for (int k = 0; k < 3; ++k)
        view.picture.at(row, column, k) = uint8_t(std::clamp(255 * sum[k] / 4 + 0.5F, 0.0F, 255.0F));
    }
  }
  return view;
}

}  // namespace daumier

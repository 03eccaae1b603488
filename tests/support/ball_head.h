#pragma once
#include "rig/arkit_names.h"
#include "rig/rigged_head.h"

#include <cmath>
#include <numbers>
#include <string>

/// The simplest head that has everything a file of a head has: a ball with a UV seam, 52 targets and two eyes.
namespace daumier::testing {

/// A ball of `radius` cm in rings and segments, with a seam of UV at the back (-z) and u to the ball's own left.
inline geometry::TriangleMesh UvBall(double radius, int rings, int segments) {
  geometry::TriangleMesh ball;
  ball.vertices.resize((rings - 1) * segments + 2, 3);
  ball.uv.resize((rings - 1) * (segments + 1) + 2, 2);
  const int south = (rings - 1) * segments, north = south + 1;
  const int uv_south = (rings - 1) * (segments + 1), uv_north = uv_south + 1;
  for (int r = 1; r < rings; ++r) {
    const double latitude = std::numbers::pi * (double(r) / rings - 0.5);
    for (int s = 0; s <= segments; ++s) {
      const double longitude = 2 * std::numbers::pi * (double(s) / segments - 0.5);
      ball.uv.row((r - 1) * (segments + 1) + s) << double(s) / segments, double(r) / rings;
      if (s == segments) continue;
      ball.vertices.row((r - 1) * segments + s) << radius * std::sin(longitude) * std::cos(latitude),
          radius * std::sin(latitude), radius * std::cos(longitude) * std::cos(latitude);
    }
  }
  ball.vertices.row(south) << 0, -radius, 0;
  ball.vertices.row(north) << 0, radius, 0;
  ball.uv.row(uv_south) << 0.5, 0;
  ball.uv.row(uv_north) << 0.5, 1;
  ball.triangles.resize(2 * segments * (rings - 1), 3);
  ball.uv_triangles.resize(ball.triangles.rows(), 3);
  int t = 0;
  const auto add = [&](const std::array<int, 3>& corners, const std::array<int, 3>& uv_corners) {
    for (int c = 0; c < 3; ++c) {
      ball.triangles(t, c) = corners[size_t(c)];
      ball.uv_triangles(t, c) = uv_corners[size_t(c)];
    }
    ++t;
  };
  const auto at = [&](int r, int s) { return (r - 1) * segments + s % segments; };
  const auto uv_at = [&](int r, int s) { return (r - 1) * (segments + 1) + s; };
  for (int s = 0; s < segments; ++s) {
    add({south, at(1, s + 1), at(1, s)}, {uv_south, uv_at(1, s + 1), uv_at(1, s)});
    for (int r = 1; r + 1 < rings; ++r) {
      add({at(r, s), at(r, s + 1), at(r + 1, s + 1)}, {uv_at(r, s), uv_at(r, s + 1), uv_at(r + 1, s + 1)});
      add({at(r, s), at(r + 1, s + 1), at(r + 1, s)}, {uv_at(r, s), uv_at(r + 1, s + 1), uv_at(r + 1, s)});
    }
    add({at(rings - 1, s), at(rings - 1, s + 1), north}, {uv_at(rings - 1, s), uv_at(rings - 1, s + 1), uv_north});
  }
  return ball;
}

/// Radius 9 cm about (0, 2, 0). Target t moves a patch of its own outwards by 0.5 cm; jawOpen moves the lower front
/// down by up to 2 cm, tongueOut nothing.
inline rig::RiggedHead BallHead(int rings = 12, int segments = 18) {
  rig::RiggedHead head;
  head.mesh = UvBall(9, rings, segments);
  const geometry::Points& ball = head.mesh.vertices;
  head.materials.assign(size_t(head.mesh.triangles.rows()), faces::HeadMaterial::kSkin);
  head.materials[0] = faces::HeadMaterial::kThroat;
  head.targets.offsets = Eigen::MatrixXf::Zero(3 * ball.rows(), rig::kNumArkitNames);
  for (int t = 0; t < rig::kNumArkitNames; ++t) {
    const std::string name(rig::ArkitNames()[size_t(t)]);
    head.targets.names.push_back(name);
    if (name == "tongueOut") continue;
    for (Eigen::Index v = 0; v < ball.rows(); ++v) {
      const Eigen::RowVector3d direction = ball.row(v) / 9;
      auto offset = head.targets.offsets.col(t).segment<3>(3 * v);
      if (name == "jawOpen") {
        offset.y() = float(-2 * std::max(0.0, direction.z()) * std::max(0.0, -direction.y()));
      } else {
        const double angle = 2 * std::numbers::pi * t / rig::kNumArkitNames;
        const Eigen::RowVector3d middle(0.5 * std::sin(angle), 0.5 * std::cos(angle), std::sqrt(0.75));
        offset = (0.5 * std::exp(-20 * (direction - middle).squaredNorm()) * direction).cast<float>();
      }
    }
  }
  head.mesh.vertices.rowwise() += Eigen::RowVector3d(0, 2, 0);
  for (const double side : {-1.0, 1.0}) {
    rig::RiggedEye eye;
    eye.mesh = UvBall(1.2, 6, 8);
    eye.materials.assign(size_t(eye.mesh.triangles.rows()), faces::HeadMaterial::kSclera);
    eye.centre = {3 * side, 4, 7};
    head.eyes.push_back(std::move(eye));
  }
  head.head_pivot = {0, 1, -1};
  head.jaw_pivot = {0, -1, 1};
  head.source = "ball";
  head.licence = "CC0-1.0";
  return head;
}

}  // namespace daumier::testing

#pragma once
#include "rig/head_parts.h"

#include <Eigen/Geometry>

#include <vector>

namespace daumier::rig {

/// Lips come back while a jaw opens: how far the lower teeth have to be farther back, so that they stay behind the skin that
/// they are behind at rest.
class JawClearance {
 public:
  /// head: in the frame of the template. Considered are the skin within 0.9 of the mouth's width of its middle, and the
  /// places of the mouth that move with the jaw at least half.
  JawClearance(const HeadSurface& head, const HeadParts& parts, const TemplateMatch& match);

  /// cm along z before the motion `jaw`, 0 .. 1: the least with which each of those places keeps its distance
  /// along z from the skin in front of it, or 0.05 cm if that is less. offsets: 3P, of the skin.
  double PushOf(const Eigen::Isometry3d& jaw, const Eigen::Ref<const Eigen::VectorXf>& offsets) const;

 private:
  struct Pair {
    int tooth, skin;
    double gap;  ///< Along z at rest, cm.
  };
  geometry::Points vertices_;
  std::vector<Pair> pairs_;
};

}  // namespace daumier::rig

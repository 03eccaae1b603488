#pragma once
#include "render/filled_area.h"
#include "render/svg_path.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace daumier::render {

/// What a damaged file, or one made for it, may cost: elements, points and intersections.
class SvgWork {
 public:
  /// `file` is what the error names.
  explicit SvgWork(std::string file) : file_(std::move(file)) {}
  /// @throws Error once more than kLimit units were spent.
  void Spend(int64_t units);

 private:
  static constexpr int64_t kLimit = 4'000'000'000;
  std::string file_;
  int64_t spent_ = 0;
};

/// An area in sheet coordinates: what lies inside its rings, each of which is closed by its first point, by the rule.
struct SvgArea {
  std::vector<SvgPolyline> rings;
  FillRule rule = FillRule::kNonzero;
};

/// The union of areas as a clip [CSS Masking 1, 5].
class SvgClip {
 public:
  explicit SvgClip(std::vector<SvgArea> areas);

  const std::vector<SvgArea>& areas() const { return areas_; }
  bool Contains(const Eigen::Vector2d& point) const;
  /// The pieces of a polyline that lie inside; the polyline itself, unchanged, if it lies inside as a whole.
  std::vector<SvgPolyline> Clip(const SvgPolyline& polyline, SvgWork& work) const;

 private:
  struct Edge {
    Eigen::Vector2d from, to;
    int area;
  };

  int BandOf(double y) const;

  std::vector<SvgArea> areas_;
  Eigen::AlignedBox2d box_;
  std::vector<Edge> edges_;
  std::vector<std::vector<int>> bands_;  ///< Edges that reach into each of equally high bands of the box.
};

}  // namespace daumier::render

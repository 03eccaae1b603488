#include "render/faces_on_sheet.h"

#include "core/error.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;

constexpr double kLeastGap = 0.125;
constexpr size_t kFewestStrokes = 4;
constexpr double kLeastSize = 0.5, kLeastLength = 1.0 / 3.0, kGreatestAspect = 2.5, kLeastShare = 0.85;
/// Strokes are first gathered by the cells of a grid that their boxes' corners lie in, so that scribbles of thousands
/// are a few groups.
constexpr int kGatheringCells = 64;
/// Groups that are compared pair by pair.
constexpr size_t kMostGroups = 2000;

struct StrokeGroup {
  AlignedBox2d box;
  double length = 0.0;
  std::vector<size_t> strokes;

  double size() const { return box.sizes().maxCoeff(); }
  void Join(StrokeGroup&& other) {
    box.extend(other.box);
    length += other.length;
    strokes.insert(strokes.end(), other.strokes.begin(), other.strokes.end());
  }
};

/// Empty where the stroke has no points or one that is not finite.
std::optional<StrokeGroup> GroupOfStroke(const Stroke& stroke, size_t index) {
  StrokeGroup group;
  for (size_t i = 0; i < stroke.points.size(); ++i) {
    const Eigen::Vector2d point(stroke.points[i][0], stroke.points[i][1]);
    if (!point.allFinite()) return std::nullopt;
    group.box.extend(point);
    if (i > 0) group.length += std::hypot(point.x() - stroke.points[i - 1][0], point.y() - stroke.points[i - 1][1]);
  }
  if (group.box.isEmpty()) return std::nullopt;
  group.strokes.push_back(index);
  return group;
}

/// Strokes with their boxes' corners in the same cells are one group from the start: no gap within a cell is clear.
std::vector<StrokeGroup> Gathered(std::vector<StrokeGroup> groups) {
  AlignedBox2d whole;
  for (const StrokeGroup& group : groups) whole.extend(group.box);
  const double cell = std::max(whole.sizes().maxCoeff() / kGatheringCells, 1e-9);
  const auto key = [&](const StrokeGroup& group) {
    const Eigen::Array4d corners(
        (group.box.min().x() - whole.min().x()) / cell, (group.box.min().y() - whole.min().y()) / cell,
        (group.box.max().x() - whole.min().x()) / cell, (group.box.max().y() - whole.min().y()) / cell);
    int64_t number = 0;
    for (const double corner : corners) number = number * (kGatheringCells + 1) + static_cast<int64_t>(corner);
    return number;
  };
  std::vector<std::pair<int64_t, size_t>> order;
  for (size_t i = 0; i < groups.size(); ++i) order.emplace_back(key(groups[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<StrokeGroup> gathered;
  for (size_t i = 0; i < order.size(); ++i) {
    StrokeGroup& group = groups[order[i].second];
    if (i > 0 && order[i].first == order[i - 1].first) {
      gathered.back().Join(std::move(group));
    } else {
      gathered.push_back(std::move(group));
    }
  }
  return gathered;
}

/// Joins groups until all are clearly apart.
void JoinNeighbours(std::vector<StrokeGroup>& groups) {
  for (bool joined = true; joined;) {
    joined = false;
    for (size_t i = 0; i < groups.size(); ++i) {
      for (size_t k = i + 1; k < groups.size();) {
        const double gap = groups[i].box.exteriorDistance(groups[k].box);
        if (gap > kLeastGap * std::max(groups[i].size(), groups[k].size())) {
          ++k;
          continue;
        }
        groups[i].Join(std::move(groups[k]));
        if (k + 1 < groups.size()) groups[k] = std::move(groups.back());
        groups.pop_back();
        joined = true;
      }
    }
  }
}

/// The groups that are faces, or none where the drawing does not clearly hold several; the others are in `rest`.
std::vector<StrokeGroup> FaceGroups(std::vector<StrokeGroup> groups, std::vector<StrokeGroup>& rest) {
  double size = 0.0, length = 0.0, total = 0.0, of_faces = 0.0;
  for (const StrokeGroup& group : groups) {
    size = std::max(size, group.size()), length = std::max(length, group.length);
    total += group.length;
  }
  std::vector<StrokeGroup> faces;
  for (StrokeGroup& group : groups) {
    const Eigen::Vector2d sides = group.box.sizes();
    const bool is_face = group.strokes.size() >= kFewestStrokes && group.size() >= kLeastSize * size &&
                         group.length >= kLeastLength * length &&
                         sides.maxCoeff() <= kGreatestAspect * sides.minCoeff();
    if (is_face) of_faces += group.length;
    (is_face ? faces : rest).push_back(std::move(group));
  }
  if (of_faces < kLeastShare * total) faces.clear();
  return faces;
}

bool ComesBefore(const StrokeGroup& a, const StrokeGroup& b) {
  const bool same_column = a.box.min().x() < b.box.max().x() && b.box.min().x() < a.box.max().x();
  return same_column ? a.box.center().y() < b.box.center().y() : a.box.center().x() < b.box.center().x();
}

}  // namespace

std::vector<Drawing> FacesOnSheet(const Drawing& drawing) {
  std::vector<StrokeGroup> groups;
  for (size_t i = 0; i < drawing.strokes.size(); ++i)
    if (auto group = GroupOfStroke(drawing.strokes[i], i)) groups.push_back(std::move(*group));
  groups = Gathered(std::move(groups));
  if (groups.size() > kMostGroups) return {drawing};
  JoinNeighbours(groups);
  std::vector<StrokeGroup> rest, faces = FaceGroups(std::move(groups), rest);
  if (faces.size() < 2) return {drawing};

  // Few, and "before" is no order of all of them where columns overlap in a chain: an insertion sort takes any relation.
  for (size_t i = 1; i < faces.size(); ++i)
    for (size_t k = i; k > 0 && ComesBefore(faces[k], faces[k - 1]); --k) std::swap(faces[k], faces[k - 1]);
  for (StrokeGroup& group : rest) {
    const auto nearest = std::min_element(faces.begin(), faces.end(), [&](const StrokeGroup& a, const StrokeGroup& b) {
      return a.box.exteriorDistance(group.box) < b.box.exteriorDistance(group.box);
    });
    nearest->strokes.insert(nearest->strokes.end(), group.strokes.begin(), group.strokes.end());
  }
  std::vector<Drawing> drawings;
  for (StrokeGroup& face : faces) {
    std::sort(face.strokes.begin(), face.strokes.end());
    Drawing& one = drawings.emplace_back(Drawing{drawing.width, drawing.height, {}});
    for (const size_t index : face.strokes) one.strokes.push_back(drawing.strokes[index]);
  }
  return drawings;
}

const Drawing& LargestFace(const std::vector<Drawing>& faces) {
  DAUMIER_CHECK(!faces.empty(), "there is no face");
  const auto area = [](const Drawing& drawing) {
    AlignedBox2d box;
    for (const Stroke& stroke : drawing.strokes)
      for (const auto& [x, y] : stroke.points) box.extend(Eigen::Vector2d(x, y));
    return box.isEmpty() ? 0.0 : box.volume();
  };
  return *std::max_element(faces.begin(), faces.end(),
                           [&](const Drawing& a, const Drawing& b) { return area(a) < area(b); });
}

}  // namespace daumier::render

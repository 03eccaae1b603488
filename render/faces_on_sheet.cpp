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
constexpr double kLeastSize = 0.4, kSurelyLarge = 0.5, kLeastLength = 1.0 / 3.0, kGreatestAspect = 2.5,
                 kLeastShare = 0.85;
/// Share of both sides of a small face's box that one of its strokes, the outline, has at least.
constexpr double kLeastOutline = 0.7;
/// Rows of letters, in sizes of the face: the gap to it below and above it (hair is above), the largest size of a
/// stroke, the greatest height of a row; the fewest strokes of a row, and its width over its height at least.
constexpr double kGapBelow = 0.125, kGapAbove = 0.25, kLargestLetter = 0.2, kHighestRow = 0.3;
constexpr size_t kFewestLetters = 4;
constexpr double kLeastRowAspect = 2.0;
/// A signature is a stroke that turns up or down so often by a share of its height.
constexpr int kFewestTurns = 4;
constexpr double kLeastTurn = 0.2, kWidestSignature = 0.7;
/// Share of the length of all lines that are no rows, which heads with an outline have at least.
constexpr double kLeastHead = 0.6;
/// Share of both sides of the box of all that is no lettering which one group has that is the whole face.
constexpr double kWholeFace = 0.8;
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

/// Whether the group has an outline and features: a face however small.
bool HasOutline(const StrokeGroup& group, const Drawing& drawing) {
  return group.strokes.size() > kFewestStrokes &&
         std::any_of(group.strokes.begin(), group.strokes.end(), [&](size_t index) {
           const Eigen::Vector2d sides = GroupOfStroke(drawing.strokes[index], index)->box.sizes();
           return (sides.array() >= kLeastOutline * group.box.sizes().array()).all();
         });
}

/// The groups that are faces, or none where the drawing does not clearly hold several; the others are in `rest`.
std::vector<StrokeGroup> FaceGroups(std::vector<StrokeGroup> groups, const Drawing& drawing,
                                    std::vector<StrokeGroup>& rest) {
  double size = 0.0, length = 0.0, total = 0.0, of_faces = 0.0;
  for (const StrokeGroup& group : groups) {
    size = std::max(size, group.size()), length = std::max(length, group.length);
    total += group.length;
  }
  const auto largest = std::max_element(groups.begin(), groups.end(),
                                        [](const StrokeGroup& a, const StrokeGroup& b) { return a.size() < b.size(); });
  const bool may_be_small = largest != groups.end() && HasOutline(*largest, drawing);
  std::vector<StrokeGroup> faces;
  for (StrokeGroup& group : groups) {
    const Eigen::Vector2d sides = group.box.sizes();
    const bool is_face = group.strokes.size() >= kFewestStrokes && group.size() >= kLeastSize * size &&
                         group.length >= kLeastLength * length &&
                         sides.maxCoeff() <= kGreatestAspect * sides.minCoeff() &&
                         (group.size() >= kSurelyLarge * size || (may_be_small && HasOutline(group, drawing)));
    if (is_face) of_faces += group.length;
    (is_face ? faces : rest).push_back(std::move(group));
  }
  if (of_faces < kLeastShare * total) faces.clear();
  return faces;
}

/// How often the stroke turns up or down by a share of its height.
int NumTurns(const Stroke& stroke, double height) {
  int num_turns = 0, direction = 0;
  double extreme = stroke.points.front()[1];
  for (const auto& point : stroke.points) {
    const double step = point[1] - extreme;
    if (direction * step >= 0.0 && direction != 0) {
      extreme = point[1];
    } else if (std::abs(step) >= kLeastTurn * height) {
      num_turns += direction != 0;
      direction = step > 0.0 ? 1 : -1;
      extreme = point[1];
    }
  }
  return num_turns;
}

/// A row of groups side by side.
struct Row {
  AlignedBox2d box;
  std::vector<size_t> groups;
};

std::vector<Row> RowsOf(const std::vector<StrokeGroup>& groups, const std::vector<size_t>& members) {
  std::vector<size_t> order = members;
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return groups[a].box.min().y() < groups[b].box.min().y(); });
  std::vector<Row> rows;
  for (const size_t index : order) {
    if (rows.empty() || groups[index].box.min().y() > rows.back().box.max().y()) rows.emplace_back();
    rows.back().box.extend(groups[index].box);
    rows.back().groups.push_back(index);
  }
  return rows;
}

/// Whether a row of small groups, apart from a face of this box, is lettering.
bool IsLettering(const Row& row, const std::vector<StrokeGroup>& groups, const Drawing& drawing,
                 const AlignedBox2d& face) {
  const double size = face.sizes().maxCoeff();
  const bool is_below = row.box.min().y() >= face.max().y() + kGapBelow * size;
  const bool is_above = row.box.max().y() <= face.min().y() - kGapAbove * size;
  const Eigen::Vector2d row_sides = row.box.sizes();
  if ((!is_below && !is_above) || row_sides.y() > kHighestRow * size || row_sides.x() < kLeastRowAspect * row_sides.y())
    return false;
  size_t num_letters = 0;
  bool has_signature = false;
  for (const size_t group : row.groups) {
    for (const size_t index : groups[group].strokes) {
      const Eigen::Vector2d sides = GroupOfStroke(drawing.strokes[index], index)->box.sizes();
      const bool is_written = is_below && sides.x() <= kWidestSignature * size && sides.x() > sides.y() &&
                              sides.y() <= kLargestLetter * size &&
                              NumTurns(drawing.strokes[index], sides.y()) >= kFewestTurns;
      if (!is_written && sides.maxCoeff() > kLargestLetter * size) return false;
      has_signature = has_signature || is_written;
      ++num_letters;
    }
  }
  return has_signature || num_letters >= kFewestLetters;
}

/// Takes the groups that are lettering above or below the faces out. Nothing is taken unless heads with an
/// outline, or one group that is the whole face, have most of the other lines: of eyes, nose and mouth alone none is one.
void RemoveLettering(std::vector<StrokeGroup>& groups, const Drawing& drawing) {
  double size = 0.0;
  for (const StrokeGroup& group : groups) {
    if (group.strokes.size() >= kFewestStrokes && group.box.sizes().minCoeff() * kGreatestAspect >= group.size())
      size = std::max(size, group.size());
  }
  std::vector<size_t> small;
  std::vector<bool> is_left_out(groups.size(), false);
  for (size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].box.sizes().y() <= kHighestRow * size) small.push_back(i);
  }
  std::vector<Row> rows = RowsOf(groups, small);
  AlignedBox2d face;
  for (bool changed = true; changed && !rows.empty();) {
    is_left_out.assign(groups.size(), false);
    for (const Row& row : rows)
      for (const size_t index : row.groups) is_left_out[index] = true;
    face.setEmpty();
    for (size_t i = 0; i < groups.size(); ++i)
      if (!is_left_out[i]) face.extend(groups[i].box);
    if (face.isEmpty()) return;
    changed = std::erase_if(rows, [&](const Row& row) { return !IsLettering(row, groups, drawing, face); }) > 0;
  }
  if (rows.empty()) return;
  double length = 0.0, of_heads = 0.0;
  for (size_t i = 0; i < groups.size(); ++i) {
    if (is_left_out[i]) continue;
    length += groups[i].length;
    const bool is_head = groups[i].size() >= kLeastSize * size && HasOutline(groups[i], drawing);
    const bool is_whole_face = (groups[i].box.sizes().array() >= kWholeFace * face.sizes().array()).all();
    if (is_head || is_whole_face) of_heads += groups[i].length;
  }
  if (of_heads < kLeastHead * length) return;
  std::vector<StrokeGroup> kept;
  for (size_t i = 0; i < groups.size(); ++i)
    if (!is_left_out[i]) kept.push_back(std::move(groups[i]));
  groups = std::move(kept);
}

bool ComesBefore(const StrokeGroup& a, const StrokeGroup& b) {
  const bool same_column = a.box.min().x() < b.box.max().x() && b.box.min().x() < a.box.max().x();
  return same_column ? a.box.center().y() < b.box.center().y() : a.box.center().x() < b.box.center().x();
}

Drawing WithStrokes(const Drawing& drawing, std::vector<size_t> strokes) {
  std::sort(strokes.begin(), strokes.end());
  Drawing one{drawing.width, drawing.height, {}, drawing.picture_from_sheet};
  for (const size_t index : strokes) one.strokes.push_back(drawing.strokes[index]);
  return one;
}

}  // namespace

std::vector<Drawing> FacesOnSheet(const Drawing& drawing) {
  std::vector<StrokeGroup> groups;
  for (size_t i = 0; i < drawing.strokes.size(); ++i)
    if (auto group = GroupOfStroke(drawing.strokes[i], i)) groups.push_back(std::move(*group));
  groups = Gathered(std::move(groups));
  if (groups.size() > kMostGroups) return {drawing};
  JoinNeighbours(groups);
  const size_t num_groups = groups.size();
  RemoveLettering(groups, drawing);
  std::vector<size_t> kept;
  for (const StrokeGroup& group : groups) kept.insert(kept.end(), group.strokes.begin(), group.strokes.end());
  const bool is_whole = groups.size() == num_groups;
  std::vector<StrokeGroup> rest, faces = FaceGroups(std::move(groups), drawing, rest);
  if (faces.size() < 2) return {is_whole ? drawing : WithStrokes(drawing, std::move(kept))};

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
  for (StrokeGroup& face : faces) drawings.push_back(WithStrokes(drawing, std::move(face.strokes)));
  return drawings;
}

size_t NumLeftOut(const Drawing& drawing, const std::vector<Drawing>& faces) {
  size_t num_strokes = 0;
  const auto num_drawn = [](const Drawing& of) {
    return size_t(std::count_if(of.strokes.begin(), of.strokes.end(),
                                [](const Stroke& stroke) { return !stroke.points.empty(); }));
  };
  for (const Drawing& face : faces) num_strokes += num_drawn(face);
  return num_drawn(drawing) - num_strokes;
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

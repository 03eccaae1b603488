#include "fitting/label_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace daumier::fitting {
namespace {

using faces::FaceTemplate;
using faces::LineLabel;

const faces::FeatureCurve* CurveNamed(const FaceTemplate& face_template, std::string_view name) {
  for (const faces::FeatureCurve& curve : face_template.annotation.curves) {
    if (curve.name == name) return &curve;
  }
  return nullptr;
}

int NearestVertexOf(const std::vector<int>& path, const geometry::Points& neutral, int vertex) {
  return int(std::min_element(path.begin(), path.end(),
                              [&](int a, int b) {
                                return (neutral.row(a) - neutral.row(vertex)).squaredNorm() <
                                       (neutral.row(b) - neutral.row(vertex)).squaredNorm();
                              }) -
             path.begin());
}

/// The halves of the loop of the lips from the face's right corner to its left one; the first is the upper.
std::array<std::vector<int>, 2> HalvesOfLips(const FaceTemplate& face_template, std::vector<int> loop) {
  const auto& landmarks = face_template.annotation.landmarks;
  const geometry::Points& neutral = face_template.neutral;
  std::rotate(loop.begin(), loop.begin() + NearestVertexOf(loop, neutral, landmarks[48]), loop.end());
  const int left = NearestVertexOf(loop, neutral, landmarks[54]);
  std::array<std::vector<int>, 2> halves = {std::vector<int>(loop.begin(), loop.begin() + left + 1),
                                            std::vector<int>(loop.begin() + left, loop.end())};
  halves[1].push_back(loop.front());
  std::reverse(halves[1].begin(), halves[1].end());
  const auto mean_y = [&](const std::vector<int>& path) {
    double sum = 0;
    for (const int vertex : path) sum += neutral(vertex, 1);
    return sum / double(path.size());
  };
  if (mean_y(halves[0]) < mean_y(halves[1])) std::swap(halves[0], halves[1]);
  return halves;
}

std::vector<int> FromRightToLeft(std::vector<int> path, const geometry::Points& neutral) {
  if (neutral(path.front(), 0) > neutral(path.back(), 0)) std::reverse(path.begin(), path.end());
  return path;
}

/// Lengths on the neutral face up to each vertex.
std::vector<double> LengthsAlong(const std::vector<int>& path, const geometry::Points& neutral) {
  std::vector<double> lengths = {0};
  for (size_t i = 1; i < path.size(); ++i)
    lengths.push_back(lengths.back() + (neutral.row(path[i]) - neutral.row(path[i - 1])).norm());
  return lengths;
}

/// Vertices that belong together: positions along the upper and the lower line.
using Anchors = std::vector<std::pair<size_t, size_t>>;

Anchors AnchorsOf(const std::vector<int>& upper, const std::vector<int>& lower,
                  const std::vector<std::pair<int, int>>& landmarks) {
  Anchors anchors = {{0, 0}};
  for (const auto& [above, below] : landmarks) {
    const auto at_upper = std::find(upper.begin(), upper.end(), above),
               at_lower = std::find(lower.begin(), lower.end(), below);
    if (at_upper == upper.end() || at_lower == lower.end()) continue;
    const std::pair<size_t, size_t> anchor(at_upper - upper.begin(), at_lower - lower.begin());
    if (anchor.first > anchors.back().first && anchor.second > anchors.back().second) anchors.push_back(anchor);
  }
  const std::pair<size_t, size_t> end(upper.size() - 1, lower.size() - 1);
  while (anchors.size() > 1 && (anchors.back().first >= end.first || anchors.back().second >= end.second))
    anchors.pop_back();
  anchors.push_back(end);
  return anchors;
}

std::vector<GapPair> PairsOf(const std::vector<int>& upper, const std::vector<int>& lower, const Anchors& anchors,
                             const geometry::Points& neutral) {
  const std::vector<double> upper_lengths = LengthsAlong(upper, neutral), lower_lengths = LengthsAlong(lower, neutral);
  std::vector<GapPair> pairs;
  for (size_t part = 0; part + 1 < anchors.size(); ++part) {
    const auto [from, lower_from] = anchors[part];
    const auto [to, lower_to] = anchors[part + 1];
    for (size_t i = from; i < to + (part + 2 == anchors.size() ? 1 : 0); ++i) {
      const double share =
          (upper_lengths[i] - upper_lengths[from]) / std::max(upper_lengths[to] - upper_lengths[from], 1e-9);
      const double at = lower_lengths[lower_from] + share * (lower_lengths[lower_to] - lower_lengths[lower_from]);
      size_t k = lower_from;
      while (k + 2 <= lower_to && lower_lengths[k + 1] < at) ++k;
      const double step = std::max(lower_lengths[k + 1] - lower_lengths[k], 1e-9);
      pairs.push_back({upper[i],
                       {lower[k], lower[k + 1], std::clamp((at - lower_lengths[k]) / step, 0.0, 1.0)},
                       upper_lengths[i] / std::max(upper_lengths.back(), 1e-9)});
    }
  }
  return pairs;
}

}  // namespace

std::vector<LabelCurve> FindLabelCurves(const FaceTemplate& face_template, const faces::FacePointVertices& points) {
  std::vector<LabelCurve> result;
  const auto add = [&](std::string_view name, LineLabel label, double trust, int side = 0) {
    const faces::FeatureCurve* const curve = CurveNamed(face_template, name);
    if (curve == nullptr || curve->vertices.size() < 2) return false;
    std::vector<int> vertices = curve->vertices;
    if (curve->closed) vertices.push_back(vertices.front());
    result.push_back({label, std::move(vertices), curve->closed, side, trust});
    return true;
  };
  const bool has_cranium = add("cranium", LineLabel::kSilhouette, 0.3);
  if (CurveNamed(face_template, "jaw") != nullptr || !add("silhouette", LineLabel::kSilhouette, 1) || has_cranium) {
    for (const std::vector<int>& contour : points.contours) result.push_back({LineLabel::kSilhouette, contour});
  }
  add("nose_base", LineLabel::kNose, 0.5);
  for (const int side : {0, 1}) {
    const auto add_pair = [&](std::string_view name, LineLabel label, double trust) {
      add(fmt::format("{}_{}", name, side == 0 ? "right" : "left"), label, trust, side);
    };
    add_pair("ear", LineLabel::kEar, 0.2);
    add_pair("brow", LineLabel::kBrow, 0.5);
    add_pair("upper_eye", LineLabel::kUpperLid, 1);
    add_pair("lower_eye", LineLabel::kLowerLid, 1);
    add_pair("nose_wing", LineLabel::kNose, 0.5);
  }
  add("upper_mouth", LineLabel::kInnerMouth, 1);
  add("lower_mouth", LineLabel::kInnerMouth, 1);
  if (const faces::FeatureCurve* const lips = CurveNamed(face_template, "lips"); lips != nullptr && lips->closed) {
    auto halves = HalvesOfLips(face_template, lips->vertices);
    result.push_back({LineLabel::kUpperLip, std::move(halves[0])});
    result.push_back({LineLabel::kLowerLip, std::move(halves[1])});
  }
  return result;
}

std::vector<OpeningPairs> FindOpeningPairs(const FaceTemplate& face_template) {
  struct Lines {
    Opening opening;
    std::string_view upper, lower;
    std::vector<std::pair<size_t, size_t>> landmarks;  ///< From the face's right to its left.
  };
  static const std::array<Lines, kNumOpenings> kLines = {
      Lines{Opening::kMouth, "upper_mouth", "lower_mouth", {{61, 67}, {62, 66}, {63, 65}}},
      Lines{Opening::kRightEye, "upper_eye_right", "lower_eye_right", {{37, 41}, {38, 40}}},
      Lines{Opening::kLeftEye, "upper_eye_left", "lower_eye_left", {{43, 47}, {44, 46}}}};
  const geometry::Points& neutral = face_template.neutral;
  std::vector<OpeningPairs> result;
  for (const Lines& lines : kLines) {
    const faces::FeatureCurve *const upper = CurveNamed(face_template, lines.upper), *const lower = CurveNamed(
                                                                                         face_template, lines.lower);
    if (upper == nullptr || lower == nullptr || upper->vertices.size() < 3 || lower->vertices.size() < 3) continue;
    OpeningPairs pairs{
        lines.opening, FromRightToLeft(upper->vertices, neutral), FromRightToLeft(lower->vertices, neutral), {}};
    std::vector<std::pair<int, int>> landmarks;
    for (const auto& [above, below] : lines.landmarks)
      landmarks.emplace_back(face_template.annotation.landmarks[above], face_template.annotation.landmarks[below]);
    pairs.pairs = PairsOf(pairs.upper, pairs.lower, AnchorsOf(pairs.upper, pairs.lower, landmarks), neutral);
    result.push_back(std::move(pairs));
  }
  return result;
}

}  // namespace daumier::fitting

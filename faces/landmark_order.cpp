#include "faces/landmark_order.h"

#include "core/error.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>
#include <string_view>
#include <vector>

namespace daumier::faces {
namespace {

constexpr int kNumInner = kNumLandmarks - kNumContourLandmarks;
constexpr const char* kForms =
    "expected 68 points in iBUG order, the 51 without the contour (17 to 67), or points with their numbers: x y z or a "
    "vertex each, as rows of text (with or without a count, numbers, names, commas), iBUG .pts, MeshLab .pp, "
    "CSV, 3D Slicer .fcsv or .mrk.json, or a JSON list";

/// The number at the end of each label, behind the same text everywhere; nothing where they do not have one.
std::optional<std::vector<int>> NumbersOf(const std::vector<std::string>& labels) {
  std::vector<int> numbers;
  std::optional<std::string_view> prefix;
  for (const std::string_view label : labels) {
    const size_t last_other = label.find_last_not_of("0123456789");
    const size_t begin = last_other == std::string_view::npos ? 0 : last_other + 1;
    int number = 0;
    const auto [stop, error] = std::from_chars(label.data() + begin, label.data() + label.size(), number);
    if (error != std::errc() || (prefix && *prefix != label.substr(0, begin))) return std::nullopt;
    prefix = label.substr(0, begin);
    numbers.push_back(number);
  }
  return numbers;
}

/// Which landmark each point is; nothing where that is not clear.
std::optional<std::vector<int>> LandmarksOf(const MarkedPoints& marked) {
  const int count = static_cast<int>(marked.points.size());
  std::vector<int> in_order(static_cast<size_t>(count));
  std::iota(in_order.begin(), in_order.end(), count == kNumInner ? kNumContourLandmarks : 0);
  const bool is_whole = count == kNumLandmarks || count == kNumInner;
  auto numbers = marked.labels.empty() ? std::nullopt : NumbersOf(marked.labels);
  if (numbers && std::set<int>(numbers->begin(), numbers->end()).size() != numbers->size()) numbers.reset();
  if (!numbers) return is_whole ? std::optional(in_order) : std::nullopt;

  const auto [least, greatest] = std::minmax_element(numbers->begin(), numbers->end());
  const int low = *least, high = *greatest;
  int first = -1;  // The number of landmark 0.
  if (count == kNumInner && high - low == kNumInner - 1) {
    first = low - kNumContourLandmarks;
  } else if (low == 0 && high < kNumLandmarks) {
    first = 0;
  } else if (low >= 1 && high == kNumLandmarks) {
    first = 1;
  } else {
    return is_whole ? std::optional(in_order) : std::nullopt;
  }
  for (int& number : *numbers) number -= first;
  return numbers;
}

/// All numbers of 68 or 51 points as points.
MarkedPoints Grouped(const MarkedPoints& marked) {
  const size_t count = marked.points.size();
  for (const int size : {kNumLandmarks, kNumInner}) {
    for (const int dimension : {2, 3}) {
      if (marked.dimension != 1 || count != size_t(size * dimension)) continue;
      MarkedPoints grouped{.file = marked.file, .dimension = dimension};
      for (size_t i = 0; i < count; i += size_t(dimension)) {
        geometry::Vector3 place = geometry::Vector3::Zero();
        bool is_there = true;
        for (int axis = 0; axis < dimension; ++axis) {
          const auto& number = marked.points[i + size_t(axis)];
          is_there = is_there && number;
          if (number) place[axis] = number->x();
        }
        grouped.points.push_back(is_there ? std::optional(place) : std::nullopt);
      }
      return grouped;
    }
  }
  return marked;
}

}  // namespace

OrderedLandmarks OrderLandmarks(const MarkedPoints& given) {
  const MarkedPoints marked = Grouped(given);
  const auto landmarks = LandmarksOf(marked);
  DAUMIER_CHECK(landmarks, "{}: {} {}; {}", marked.file.string(), marked.points.size(),
                marked.dimension == 1 ? "numbers" : "points", kForms);
  OrderedLandmarks ordered{marked.file, marked.dimension, {}, marked.frame};
  for (size_t i = 0; i < landmarks->size(); ++i) ordered.points[size_t((*landmarks)[i])] = marked.points[i];
  return ordered;
}

int MirroredLandmark(int landmark) {
  struct Span {
    int first, last, sum;  ///< Both landmarks of a pair lie within, and their numbers have this sum.
  };
  static constexpr Span kSpans[] = {{0, 16, 16},   {17, 26, 43},  {31, 35, 66}, {48, 54, 102},
                                    {55, 59, 114}, {60, 64, 124}, {65, 67, 132}};
  static constexpr int kEyes[] = {45, 44, 43, 42, 47, 46, 39, 38, 37, 36, 41, 40};  // Of 36 .. 47.
  DAUMIER_CHECK(landmark >= 0 && landmark < kNumLandmarks, "landmark {} of {}", landmark, kNumLandmarks);
  if (landmark >= 36 && landmark <= 47) return kEyes[landmark - 36];
  for (const Span& span : kSpans) {
    if (landmark >= span.first && landmark <= span.last) return span.sum - landmark;
  }
  return landmark;  // The ridge of the nose.
}

}  // namespace daumier::faces

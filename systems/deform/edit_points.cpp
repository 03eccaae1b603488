#include "systems/deform/edit_points.h"

#include "core/error.h"
#include "faces/face_parts.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace daumier::deform {
namespace {

using geometry::Vector3;

constexpr int kNoseTip = 30, kNumLandmarks = 68;
constexpr int kBlendRings = 6;
constexpr double kPartShare = 0.1, kOutsideShare = 0.02;

constexpr const char* kExample =
    "expected a landmark as --handle 30=0,0,1, a vertex as --handle v1200=0,0.5,0, a point of a triangle as --handle "
    "t400:0.2,0.3=0,1,0, or a preset as --handle nose=1; lengths are centimetres, x to the face's left, y up, z to the "
    "front";

[[noreturn]] void Refuse(const std::string& word, const std::string& what) {
  throw UsageError(fmt::format("--handle {}: {} ({})", word, what, kExample));
}

/// A whole text as a finite number.
template <class Number>
std::optional<Number> NumberIn(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (!std::isfinite(double(number))) return std::nullopt;
  return number;
}

/// Numbers with commas between them. @throws UsageError if one is none.
std::vector<double> NumbersIn(const std::string& word, std::string_view text) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view cell = text.substr(begin, end - begin);
    const std::optional<double> number = NumberIn<double>(cell);
    if (!number) Refuse(word, fmt::format("'{}' is no number", cell));
    numbers.push_back(*number);
    begin = end + 1;
  }
  return numbers;
}

/// tNUMBER or tNUMBER:b,c.
fitting::TrianglePoint PointOnTriangle(const faces::FaceTemplate& face_template, const std::string& word,
                                       const std::string& point) {
  const size_t colon = std::min(point.find(':'), point.size());
  const Eigen::Index num_triangles = face_template.triangles.rows();
  const std::optional<int> triangle = NumberIn<int>(std::string_view(point).substr(1, colon - 1));
  if (!triangle || *triangle < 0 || *triangle >= num_triangles)
    Refuse(word,
           fmt::format("there is no triangle '{}' (expected 0 to {})", point.substr(1, colon - 1), num_triangles - 1));
  if (colon == point.size()) return {.triangle = *triangle};
  const std::vector<double> shares = NumbersIn(word, std::string_view(point).substr(colon + 1));
  if (shares.size() != 2 || shares[0] < 0 || shares[1] < 0 || shares[0] + shares[1] > 1)
    Refuse(word, fmt::format("'{}' are no two shares of corners, none negative and together at most 1",
                             point.substr(colon + 1)));
  return {*triangle, {1 - shares[0] - shares[1], shares[0], shares[1]}};
}

/// The right side's vertex moved to the right, the left side's to the left.
EditHandles Both(int right, int left, double amount_cm) {
  EditHandles handles{{right, left}, geometry::Points::Zero(2, 3)};
  handles.displacements(0, 0) = -amount_cm;
  handles.displacements(1, 0) = amount_cm;
  return handles;
}

EditHandles One(int vertex, const Vector3& displacement) {
  return {{vertex}, displacement.transpose()};
}

/// The vertex of the cheek between a landmark of the jaw and one of the nose's wing, two thirds of the way outwards.
int CheekVertex(const faces::FaceTemplate& face_template, int jaw, int wing) {
  const auto& landmarks = face_template.annotation.landmarks;
  const geometry::Points& neutral = face_template.neutral;
  const Eigen::RowVector3d place = (2 * neutral.row(landmarks[size_t(jaw)]) + neutral.row(landmarks[size_t(wing)])) / 3;
  Eigen::Index nearest = 0;
  (neutral.rowwise() - place).rowwise().squaredNorm().minCoeff(&nearest);
  return int(nearest);
}

/// Of the ears the vertex that is farthest to a side (-1: the face's right).
int OutermostEarVertex(const faces::FaceTemplate& face_template, double side) {
  const std::vector<int>& ears = faces::RegionFor(face_template.annotation, "ears", "the preset ears");
  return *std::max_element(ears.begin(), ears.end(), [&](int a, int b) {
    return side * face_template.neutral(a, 0) < side * face_template.neutral(b, 0);
  });
}

}  // namespace

const std::vector<std::string>& PresetNames() {
  static const std::vector<std::string> names = {"nose", "chin", "cheeks", "ears"};
  return names;
}

EditHandles PresetHandles(const faces::FaceTemplate& face_template, const std::string& name, double amount_cm) {
  const auto& landmarks = face_template.annotation.landmarks;
  if (name == "nose") return One(landmarks[kNoseTip], {0, 0, amount_cm});
  if (name == "chin") return One(landmarks[faces::kChinLandmark], {0, -amount_cm, 0});
  if (name == "cheeks") return Both(CheekVertex(face_template, 3, 31), CheekVertex(face_template, 13, 35), amount_cm);
  if (name == "ears")
    return Both(OutermostEarVertex(face_template, -1), OutermostEarVertex(face_template, 1), amount_cm);
  throw UsageError(fmt::format("there is no preset '{}' (there are: {})", name, fmt::join(PresetNames(), ", ")));
}

EditHandles ParseHandle(const faces::FaceTemplate& face_template, const std::string& word) {
  const size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0) Refuse(word, "there is no POINT=...");
  const std::string point = word.substr(0, equals);
  const std::vector<double> numbers = NumbersIn(word, std::string_view(word).substr(equals + 1));
  if (std::ranges::count(PresetNames(), point) > 0) {
    if (numbers.size() != 1) Refuse(word, fmt::format("{} numbers of a preset, expected one", numbers.size()));
    return PresetHandles(face_template, point, numbers[0]);
  }
  if (point.starts_with('t')) {
    const fitting::TrianglePoint place = PointOnTriangle(face_template, word, point);
    if (numbers.size() != 3) Refuse(word, fmt::format("{} numbers, expected three", numbers.size()));
    EditHandles handles = One(face_template.num_vertices(), {numbers[0], numbers[1], numbers[2]});
    handles.on_surface = {place};
    return handles;
  }
  const bool is_vertex = point.starts_with('v');
  const std::optional<int> index = NumberIn<int>(std::string_view(point).substr(is_vertex ? 1 : 0));
  if (!index)
    Refuse(word,
           fmt::format("'{}' is no landmark, vertex, triangle or preset ({})", point, fmt::join(PresetNames(), ", ")));
  if (numbers.size() != 3) Refuse(word, fmt::format("{} numbers, expected three", numbers.size()));
  const int most = is_vertex ? face_template.num_vertices() : kNumLandmarks;
  if (*index < 0 || *index >= most)
    Refuse(word,
           fmt::format("there is no {} {} (expected 0 to {})", is_vertex ? "vertex" : "landmark", *index, most - 1));
  const int vertex = is_vertex ? *index : face_template.annotation.landmarks[size_t(*index)];
  return One(vertex, {numbers[0], numbers[1], numbers[2]});
}

EditHandles JoinHandles(const std::vector<EditHandles>& handles, int num_vertices) {
  EditHandles all;
  const auto refuse = [](const std::string& point) {
    throw UsageError(fmt::format("{} has two handles: give each point once", point));
  };
  for (const EditHandles& some : handles) {
    for (size_t k = 0; k < some.points.size(); ++k) {
      int point = some.points[k];
      if (point >= num_vertices) {
        const fitting::TrianglePoint& place = some.on_surface[size_t(point - num_vertices)];
        for (const fitting::TrianglePoint& other : all.on_surface)
          if (other.triangle == place.triangle && other.weights == place.weights)
            refuse(fmt::format("a point of triangle {}", place.triangle));
        point = num_vertices + int(all.on_surface.size());
        all.on_surface.push_back(place);
      }
      if (std::ranges::count(all.points, point) > 0) refuse(fmt::format("vertex {}", point));
      all.points.push_back(point);
      all.displacements.conservativeResize(std::ssize(all.points), 3);
      all.displacements.bottomRows<1>() = some.displacements.row(Eigen::Index(k));
    }
  }
  return all;
}

std::vector<std::vector<int>> VerticesOfHandles(const faces::FaceTemplate& face_template, const EditHandles& handles) {
  std::vector<std::vector<int>> vertices;
  for (const int point : handles.points) {
    if (point < face_template.num_vertices()) {
      vertices.push_back({point});
      continue;
    }
    const fitting::TrianglePoint& place = handles.on_surface[size_t(point - face_template.num_vertices())];
    std::vector<int> order = {0, 1, 2};
    std::ranges::stable_sort(order, [&](int a, int b) { return place.weights[a] > place.weights[b]; });
    vertices.emplace_back();
    for (const int corner : order) vertices.back().push_back(face_template.triangles(place.triangle, corner));
  }
  return vertices;
}

LabelEdit ParseLabel(const std::string& word) {
  const size_t equals = word.rfind('=');
  if (equals == std::string::npos) return {word};
  const std::string text = word.substr(equals + 1);
  const std::optional<double> amount = NumberIn<double>(text);
  if (!amount)
    throw UsageError(
        fmt::format("--label {}: '{}' is no number (expected NAME=AMOUNT, in deviations of the label)", word, text));
  return {word.substr(0, equals), *amount};
}

std::vector<int> OutsideOfPart(const faces::FaceTemplate& face_template, const EditHandles& handles) {
  const faces::FaceParts parts = faces::MakeFaceParts(face_template, kBlendRings);
  std::vector<bool> is_inside(parts.names.size(), false);
  for (const std::vector<int>& vertices : VerticesOfHandles(face_template, handles))
    for (const int vertex : vertices)
      for (size_t p = 0; p < is_inside.size(); ++p)
        if (parts.weights(vertex, Eigen::Index(p)) >= kPartShare) is_inside[p] = true;
  DAUMIER_CHECK(std::ranges::count(is_inside, true) > 0,
                "the handles belong to no part of the face (they are on the skull or the neck): edit without --local");
  std::vector<int> outside;
  for (Eigen::Index v = 0; v < parts.weights.rows(); ++v) {
    double share = 0;
    for (size_t p = 0; p < is_inside.size(); ++p) share += is_inside[p] ? parts.weights(v, Eigen::Index(p)) : 0;
    if (share < kOutsideShare) outside.push_back(int(v));
  }
  return outside;
}

}  // namespace daumier::deform

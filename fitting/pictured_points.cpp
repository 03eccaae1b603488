#include "fitting/pictured_points.h"

#include "core/error.h"
#include "faces/landmark_order.h"
#include "fitting/forehead_landmarks.h"

#include <algorithm>
#include <cmath>

namespace daumier::fitting {
namespace {

using MarkedPoint = std::optional<geometry::Vector3>;

constexpr int kUnusedVertex = -1;

/// A vertex a point.
std::vector<int> ReadVertices(const std::filesystem::path& file, int num_vertices) {
  const faces::MarkedPoints marked = faces::ReadMarkedPoints(file);
  DAUMIER_CHECK(marked.dimension == 1, "{}: points with {} numbers, expected one vertex of the template each",
                file.string(), marked.dimension);
  std::vector<int> vertices;
  for (const MarkedPoint& point : marked.points) {
    const double number = point ? point->x() : kUnusedVertex;
    DAUMIER_CHECK(number == std::floor(number) && number >= kUnusedVertex && number < num_vertices,
                  "{}: {} is no vertex of the template (expected 0 to {}, or -1 for none)", file.string(), number,
                  num_vertices - 1);
    vertices.push_back(int(number));
  }
  return vertices;
}

std::vector<int> VerticesOf81(const faces::FaceTemplate& face_template) {
  const auto& landmarks = face_template.annotation.landmarks;
  const auto forehead = ForeheadLandmarks(face_template);
  std::vector<int> vertices(landmarks.begin(), landmarks.end());
  vertices.insert(vertices.end(), forehead.begin(), forehead.end());
  return vertices;
}

/// The landmark of the jaw at a vertex; -1: none.
int JawLandmarkAt(const faces::FaceTemplate& face_template, int vertex) {
  const auto begin = face_template.annotation.landmarks.begin(), end = begin + ContourPaths::kNumJaw;
  const auto found = std::find(begin, end, vertex);
  return found == end ? -1 : int(found - begin);
}

}  // namespace

std::vector<PicturedPoint> ReadPicturedPoints(const faces::FaceTemplate& face_template,
                                              const std::filesystem::path& landmarks,
                                              const std::filesystem::path& vertices) {
  const faces::MarkedPoints marked = faces::ReadMarkedPoints(landmarks);
  DAUMIER_CHECK(marked.dimension >= 2, "{}: points have one number each, expected x and y in pixels of the picture",
                landmarks.string());
  std::vector<MarkedPoint> places = marked.points;
  std::vector<int> shown;
  constexpr int kNumOf81 = faces::kNumLandmarks + kNumForeheadLandmarks;
  if (!vertices.empty()) {
    shown = ReadVertices(vertices, face_template.num_vertices());
    DAUMIER_CHECK(shown.size() == places.size(), "{} has {} points, but {} has {} vertices: expected one for each",
                  landmarks.string(), places.size(), vertices.string(), shown.size());
  } else if (std::ssize(places) == kNumOf81) {
    shown = VerticesOf81(face_template);
  } else {
    const faces::OrderedLandmarks ordered = faces::OrderLandmarks(marked);
    places.assign(ordered.points.begin(), ordered.points.end());
    shown.assign(face_template.annotation.landmarks.begin(), face_template.annotation.landmarks.end());
  }
  std::vector<PicturedPoint> points;
  for (size_t i = 0; i < places.size(); ++i)
    if (places[i] && shown[i] != kUnusedVertex)
      points.push_back({shown[i], places[i]->head<2>(), JawLandmarkAt(face_template, shown[i])});
  return points;
}

}  // namespace daumier::fitting

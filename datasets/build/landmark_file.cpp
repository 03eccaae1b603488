#include "datasets/build/landmark_file.h"

#include "core/error.h"
#include "core/log.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace daumier::datasets {
namespace {

constexpr double kTooLarge = 1e9;

int ToVertex(double number, const std::filesystem::path& path) {
  DAUMIER_CHECK(number == std::floor(number), "{}: {} is no vertex (expected an integer)", path.string(), number);
  DAUMIER_CHECK(std::abs(number) < kTooLarge,
                "{}: {:.0f} is no vertex: it is too large (expected the number of a vertex of the mesh)", path.string(),
                number);
  return static_cast<int>(number);
}

/// The vertex of each name; the first one where several have it.
std::map<int, int> ReadVertexMap(const std::filesystem::path& path) {
  const faces::MarkedPoints names = faces::ReadMarkedPoints(path);
  DAUMIER_CHECK(names.dimension == 1, "{}: {} numbers a row, expected one for each vertex", path.string(),
                names.dimension);
  std::map<int, int> vertex_of_name;
  for (size_t v = 0; v < names.points.size(); ++v) {
    if (names.points[v]) vertex_of_name.try_emplace(ToVertex(names.points[v]->x(), path), static_cast<int>(v));
  }
  return vertex_of_name;
}

/// Between LPS and RAS.
MeshLandmarks Turned(MeshLandmarks landmarks) {
  for (auto& place : landmarks) {
    if (place) place->head<2>() *= -1;
  }
  return landmarks;
}

/// Sum of the distances to the nearest vertex.
double DistanceTo(const MeshLandmarks& landmarks, const geometry::Points& vertices) {
  double sum = 0;
  for (const auto& place : landmarks) {
    if (place) sum += std::sqrt((vertices.rowwise() - place->transpose()).rowwise().squaredNorm().minCoeff());
  }
  return sum;
}

}  // namespace

LandmarkFile::LandmarkFile(const std::filesystem::path& path, const std::filesystem::path& vertex_map,
                           faces::ZeroPoints zero)
    : landmarks_(faces::OrderLandmarks(faces::ReadMarkedPoints(path, zero))) {
  DAUMIER_CHECK(landmarks_.dimension != 2,
                "{}: holds x and y of a picture, or z is missing (two numbers a point); expected x y z on the mesh, or "
                "vertices of it",
                path.string());
  if (landmarks_.dimension != 1) return;
  for (auto& number : landmarks_.points) {
    if (number && ToVertex(number->x(), path) == -1) number.reset();
  }
  if (!vertex_map.empty()) vertex_of_name_ = ReadVertexMap(vertex_map);
}

std::optional<int> LandmarkFile::VertexOf(int number) const {
  if (!vertex_of_name_) return number;
  const auto found = vertex_of_name_->find(number);
  return found == vertex_of_name_->end() ? std::nullopt : std::optional(found->second);
}

MeshLandmarks LandmarkFile::On(const geometry::Points& vertices) const {
  if (landmarks_.dimension == 3) {
    if (!landmarks_.frame || vertices.rows() == 0) return landmarks_.points;
    const MeshLandmarks turned = Turned(landmarks_.points);
    const bool is_turned = DistanceTo(turned, vertices) < DistanceTo(landmarks_.points, vertices);
    log::Info("{}: {} places, {}", landmarks_.file.string(),
              *landmarks_.frame == faces::PatientFrame::kLps ? "LPS" : "RAS",
              is_turned ? "x and y turned to the frame of the mesh" : "in the frame of the mesh as they are");
    return is_turned ? turned : landmarks_.points;
  }
  MeshLandmarks places;
  for (size_t l = 0; l < places.size(); ++l) {
    if (!landmarks_.points[l]) continue;
    const int number = static_cast<int>(landmarks_.points[l]->x());
    const auto vertex = VertexOf(number);
    if (!vertex) continue;
    const char* repair = number == vertices.rows() ? "are its numbers 1-based? Subtract 1 from each"
                                                   : "is a vertex map needed (--vertex-map)?";
    DAUMIER_CHECK(*vertex >= 0,
                  "{}: landmark {} is vertex {} (expected 0 or more; -1: absent). Was 1 subtracted twice from 1-based "
                  "numbers? Add 1 to each",
                  landmarks_.file.string(), l, *vertex);
    DAUMIER_CHECK(*vertex < vertices.rows(), "{}: landmark {} is vertex {}, but the mesh has {}; {}",
                  landmarks_.file.string(), l, *vertex, vertices.rows(), repair);
    places[l] = vertices.row(*vertex).transpose();
  }
  return places;
}

MeshLandmarks LandmarkFile::ShiftedBy(int step, const geometry::Points& vertices) const {
  MeshLandmarks places;
  for (size_t l = 0; l < places.size(); ++l) {
    if (!landmarks_.points[l]) continue;
    const auto vertex = VertexOf(static_cast<int>(landmarks_.points[l]->x()) + step);
    if (vertex && *vertex >= 0 && *vertex < vertices.rows()) places[l] = vertices.row(*vertex).transpose();
  }
  return places;
}

ShiftedNumbers LandmarkFile::ShiftedOn(const geometry::Points& vertices) const {
  if (landmarks_.dimension == 3) return {};
  const bool has_zero = std::any_of(landmarks_.points.begin(), landmarks_.points.end(),
                                    [](const auto& number) { return number && number->x() <= 0; });
  ShiftedNumbers shifted{std::nullopt, ShiftedBy(1, vertices)};
  if (!has_zero) shifted.one_less = ShiftedBy(-1, vertices);
  return shifted;
}

}  // namespace daumier::datasets

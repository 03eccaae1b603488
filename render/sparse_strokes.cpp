#include "render/sparse_strokes.h"

#include "core/error.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

constexpr size_t kMostPoints = 10000;
constexpr double kMostLengthPx = 12000.0;
constexpr size_t kMostPieces = 20000;
constexpr double kFirstCellPx = 1.0, kLastCellPx = 8.0;
/// Cells along a side of the grid, also of a drawing that is far larger than the canvas.
constexpr int kMostCells = 4096;

Vector2d PlaceOf(const std::array<float, 2>& point) {
  return {point[0], point[1]};
}

/// Which cells lines run through, for each range of directions.
class LineCells {
 public:
  LineCells(const Eigen::AlignedBox2d& box, double cell)
      : origin_(box.min()), cell_(std::max(cell, box.sizes().maxCoeff() / kMostCells)) {
    size_ = (box.sizes() / cell_).array().floor().cast<int>() + 1;
    directions_.resize(size_t(size_.x()) * size_t(size_.y()), 0);
  }

  bool Covered(const Vector2d& from, const Vector2d& to) {
    const uint8_t direction = DirectionOf(from, to);
    bool covered = true;
    ForEachCell(from, to, [&](uint8_t& cell) { covered = covered && (cell & direction); });
    return covered;
  }
  void Cover(const Vector2d& from, const Vector2d& to) {
    const uint8_t direction = DirectionOf(from, to);
    ForEachCell(from, to, [&](uint8_t& cell) { cell |= direction; });
  }

 private:
  /// A bit for each 45 degrees of the direction, either sense alike.
  static uint8_t DirectionOf(const Vector2d& from, const Vector2d& to) {
    Vector2d along = to - from;
    if (along.y() < 0 || (along.y() == 0 && along.x() < 0)) along = -along;
    if (along.x() > along.y()) return 1;
    if (along.x() > 0) return 2;
    return -along.x() < along.y() ? 4 : 8;
  }

  template <class Visit>
  void ForEachCell(const Vector2d& from, const Vector2d& to, const Visit& visit) {
    const int parts = std::max(1, static_cast<int>(std::ceil(2.0 * (to - from).norm() / cell_)));
    for (int part = 0; part < parts; ++part) {
      const Vector2d at = (from + (part + 0.5) / parts * (to - from) - origin_) / cell_;
      const Eigen::Array2i cell = at.array().floor().cast<int>().max(0).min(size_ - 1);
      visit(directions_[size_t(cell.y()) * size_t(size_.x()) + size_t(cell.x())]);
    }
  }

  Vector2d origin_;
  double cell_;
  Eigen::Array2i size_;
  std::vector<uint8_t> directions_;
};

/// The places of a stroke without those that are nearer than a cell to the last one; the last place stays.
std::vector<Vector2d> SparsePlaces(const Stroke& stroke, double cell) {
  std::vector<Vector2d> places;
  for (const auto& point : stroke.points) {
    const Vector2d place = PlaceOf(point);
    if (places.empty() || (place - places.back()).norm() >= cell) places.push_back(place);
  }
  if (const Vector2d last = PlaceOf(stroke.points.back()); places.back() != last) places.push_back(last);
  return places;
}

/// Collects the pieces of one stroke; a piece that is left out ends the polyline before it.
class PieceCollector {
 public:
  PieceCollector(LineCells& cells, std::vector<Stroke>& strokes, int kind, double cell, size_t& num_pieces)
      : cells_(cells), strokes_(strokes), kind_(kind), cell_(cell), num_pieces_(num_pieces) {}

  void Add(const Vector2d& from, const Vector2d& to) {
    if (cells_.Covered(from, to)) {
      continues_ = false;
    } else {
      if (!continues_) strokes_.push_back({kind_, {{float(from.x()), float(from.y())}}});
      if (to != from) strokes_.back().points.push_back({float(to.x()), float(to.y())});
      continues_ = true;
      ++num_pieces_;
    }
    // A piece covers its cells once the pen has left them, or every next piece would seem to be drawn already.
    recent_.push_back({from, to});
    recent_length_ += (to - from).norm();
    while (recent_length_ > kLag * cell_ && recent_.size() > 1) Leave();
  }
  void Finish() {
    while (!recent_.empty()) Leave();
  }

 private:
  struct Piece {
    Vector2d from, to;
  };
  static constexpr double kLag = 4.0;

  void Leave() {
    const auto [from, to] = recent_.front();
    cells_.Cover(from, to);
    recent_length_ -= (to - from).norm();
    recent_.pop_front();
  }

  LineCells& cells_;
  std::vector<Stroke>& strokes_;
  int kind_;
  double cell_;
  size_t& num_pieces_;
  bool continues_ = false;
  std::deque<Piece> recent_;
  double recent_length_ = 0.0;
};

/// Nothing once there are more than `most_pieces` pieces.
std::optional<std::vector<Stroke>> SparseOnCells(const std::vector<Stroke>& strokes, const Eigen::AlignedBox2d& box,
                                                 double cell, size_t most_pieces) {
  LineCells cells(box, cell);
  std::vector<Stroke> sparse;
  size_t num_pieces = 0;
  for (const Stroke& stroke : strokes) {
    if (stroke.points.empty()) continue;
    const std::vector<Vector2d> places = SparsePlaces(stroke, cell);
    PieceCollector collector(cells, sparse, stroke.kind, cell, num_pieces);
    if (places.size() == 1) collector.Add(places[0], places[0]);
    for (size_t i = 1; i < places.size(); ++i) {
      if (num_pieces > most_pieces) return std::nullopt;
      const Vector2d along = places[i] - places[i - 1];
      const int parts = std::max(1, static_cast<int>(std::floor(along.norm() / (2.0 * cell))));
      for (int part = 0; part < parts; ++part)
        collector.Add(places[i - 1] + double(part) / parts * along, places[i - 1] + double(part + 1) / parts * along);
    }
    collector.Finish();
  }
  return sparse;
}

}  // namespace

std::vector<Stroke> SparseStrokes(const std::vector<Stroke>& strokes, double scale) {
  DAUMIER_CHECK(scale > 0.0 && std::isfinite(scale), "strokes are scaled by {}, expected a positive number", scale);
  size_t num_points = 0;
  double length = 0.0;
  Eigen::AlignedBox2d box;
  for (const Stroke& stroke : strokes) {
    num_points += stroke.points.size();
    for (size_t i = 0; i < stroke.points.size(); ++i) {
      const Vector2d place = PlaceOf(stroke.points[i]);
      DAUMIER_CHECK(place.allFinite(), "a point of the drawing is ({}, {})", place.x(), place.y());
      box.extend(place);
      if (i > 0) length += scale * (place - PlaceOf(stroke.points[i - 1])).norm();
    }
  }
  if (num_points <= kMostPoints && length <= kMostLengthPx) return strokes;
  double cell_px = kFirstCellPx;
  for (; cell_px < kLastCellPx; cell_px *= 2.0)
    if (auto sparse = SparseOnCells(strokes, box, cell_px / scale, kMostPieces)) return std::move(*sparse);
  return *SparseOnCells(strokes, box, cell_px / scale, std::numeric_limits<size_t>::max());
}

}  // namespace daumier::render

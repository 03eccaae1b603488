#include "datasets/gallery/sketch_gallery.h"

#include "core/error.h"
#include "datasets/gallery/styled_sheet.h"
#include "datasets/read/augmentation.h"
#include "render/contour_strokes.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "reports/face_pictures.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

using faces::FaceDatabase;
using render::SheetCell;
using render::Stroke;

/// Faces in the order of the database's diagonal: person, level and expression all change from one to the next.
std::vector<int> Diagonal(const FaceDatabase& database, int count) {
  std::vector<int> indices;
  for (int i = 0; i < count; ++i) {
    indices.push_back(
        database.index({i % database.num_persons(), i % database.num_levels(), i % database.num_expressions()}));
  }
  return indices;
}

render::Image Drawn(const std::vector<Stroke>& strokes, int size = reports::kCell,
                    const render::StrokeStyle& style = {}) {
  return render::ToRgb(render::RasteriseStrokes(strokes, size, style));
}

std::string Title(const FaceDatabase& database, int face) {
  const faces::FaceId id = database.id(face);
  return fmt::format("{}, level {}", database.expression_names()[size_t(id.expression)], id.level + 1);
}

render::Image Sketches(const FaceDatabase& database, const SketchDatabase& sketches) {
  constexpr int kRows = 5, kPairs = 4;
  const std::vector<int> indices = Diagonal(database, kRows * kPairs);
  const render::Frame frame = reports::FrameOfFaces(database, indices);
  const faces::FinishedHead head(database.face_template());
  std::vector<SheetCell> cells;
  for (const int face : indices) {
    cells.push_back({reports::FrontView(head, database.points(face), frame), Title(database, face)});
    cells.push_back({Drawn(sketches.strokes(face))});
  }
  return render::MakeSheet(cells, 2 * kPairs);
}

render::Image LineKinds(const FaceDatabase& database, const SketchDatabase& sketches) {
  constexpr int kRows = 5, kMaxViews = 3;
  const auto is_of = [&](const Stroke& stroke, const std::string& group) {
    const std::string& kind = sketches.kinds()[size_t(stroke.kind)];
    const bool is_silhouette = kind == "silhouette" || kind == "side_silhouette";
    if (group == "silhouette") return is_silhouette;
    return IsWrinkleKind(kind) ? group == "wrinkles" : group == "features" && !is_silhouette;
  };
  const std::vector<int> indices = Diagonal(database, kRows);
  const render::Frame frame = reports::FrameOfFaces(database, indices);
  const faces::FinishedHead head(database.face_template());
  const int num_more_views = std::min(kMaxViews, sketches.num_views() - 1);
  render::SheetStyle style;
  style.column_titles = {"face", "silhouette", "features", "wrinkles", "all"};
  for (int view = 1; view <= num_more_views; ++view) style.column_titles.push_back(fmt::format("view {}", view));
  std::vector<SheetCell> cells;
  for (const int face : indices) {
    style.row_titles.push_back(Title(database, face));
    cells.push_back({reports::FrontView(head, database.points(face), frame)});
    const auto strokes = sketches.strokes(face);
    for (const char* group : {"silhouette", "features", "wrinkles"}) {
      std::vector<Stroke> some;
      std::copy_if(strokes.begin(), strokes.end(), std::back_inserter(some),
                   [&](const Stroke& stroke) { return is_of(stroke, group); });
      cells.push_back({Drawn(some)});
    }
    for (int view = 0; view <= num_more_views; ++view) cells.push_back({Drawn(sketches.strokes(face, view))});
  }
  return render::MakeSheet(cells, static_cast<int>(style.column_titles.size()), style);
}

render::Image Augmentation(const FaceDatabase& database, const SketchDatabase& sketches) {
  constexpr int kRows = 4, kColumns = 6, kSize = 220;
  constexpr double kStrengths[kColumns] = {0, 0.5, 1, 1, 2, 2};
  render::SheetStyle style;
  for (const double strength : kStrengths)
    style.column_titles.push_back(strength == 0 ? "as it is" : fmt::format("strength {:g}", strength));
  std::vector<SheetCell> cells;
  for (const int face : Diagonal(database, kRows)) {
    style.row_titles.push_back(Title(database, face));
    for (int column = 0; column < kColumns; ++column) {
      AugmentationOptions options;
      options.strength = kStrengths[column];
      Rng rng = Stream(uint64_t(column), "gallery", uint64_t(face));
      const auto augmented = Augment(sketches.strokes(face), options, rng);
      cells.push_back({Drawn(augmented.strokes, kSize, augmented.style)});
    }
  }
  return render::MakeSheet(cells, kColumns, style);
}

render::Image Contours(const FaceDatabase& database) {
  constexpr int kRows = 4;
  const std::vector<int> indices = Diagonal(database, kRows);
  const render::Frame frame = reports::FrameOfFaces(database, indices);
  const faces::FinishedHead head(database.face_template());
  const auto& triangles = database.face_template().triangles;
  render::SheetStyle style;
  style.column_titles = {"front", "its contours", "side", "its contours"};
  std::vector<SheetCell> cells;
  for (const int face : indices) {
    style.row_titles.push_back(Title(database, face));
    const geometry::TriangleMesh mesh{database.points(face), triangles};
    const auto lines = [&](const render::Camera& camera) { return Drawn(render::DrawContours(mesh, camera)); };
    cells.push_back({reports::FrontView(head, database.points(face), frame)});
    cells.push_back({lines(render::FrontalCamera(frame.centre, frame.half_height, render::kSketchCanvas))});
    cells.push_back({reports::SideView(head, database.points(face), frame)});
    cells.push_back({lines(render::SideCamera(frame.centre, frame.half_height, render::kSketchCanvas))});
  }
  return render::MakeSheet(cells, 4, style);
}

}  // namespace

std::vector<GalleryPicture> SketchPictures(const FaceDatabase& database, const SketchDatabase& sketches) {
  DAUMIER_CHECK(sketches.num_faces() == database.num_faces(),
                "there are {} sketches for {} faces: they belong to another database", sketches.num_faces(),
                database.num_faces());
  std::vector<GalleryPicture> pictures = {{"sketches.jpg", [&] { return Sketches(database, sketches); }},
                                          {"line_kinds.jpg", [&] { return LineKinds(database, sketches); }},
                                          {"augmentation.jpg", [&] { return Augmentation(database, sketches); }},
                                          {"contours.jpg", [&] { return Contours(database); }}};
  if (sketches.has_facts()) {
    pictures.push_back({"styled.jpg", [&] { return StyledSheet(sketches); }});
    pictures.push_back({"styled_labels.jpg", [&] { return StyledLabelSheet(sketches); }});
  }
  return pictures;
}

}  // namespace daumier::datasets

#include "datasets/gallery/face_gallery.h"

#include "core/files.h"
#include "core/manifest.h"
#include "core/output_place.h"
#include "datasets/gallery/sketch_gallery.h"
#include "render/draw.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "reports/face_pictures.h"
#include "reports/face_surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <string>

namespace daumier::datasets {

namespace {

using faces::FaceDatabase;

constexpr const char* kGalleryKind = "gallery";
const std::vector<std::string> kFacePictures = {"identities.jpg", "expressions.jpg", "levels.jpg", "caricatures.jpg",
                                                "curves.jpg"};
const std::vector<std::string> kSketchPictures = {"sketches.jpg", "line_kinds.jpg", "augmentation.jpg",
                                                  "contours.jpg", "styled.jpg",     "styled_labels.jpg"};
using render::SheetCell;

render::Image Identities(const FaceDatabase& database) {
  std::vector<int> indices;
  for (int person = 0; person < std::min(16, database.num_persons()); ++person)
    indices.push_back(database.index({person, 0, 0}));
  const render::Frame frame = reports::FrameOfFaces(database, indices);
  const faces::FinishedHead head(database.face_template());
  std::vector<SheetCell> cells;
  for (const int face : indices) {
    cells.push_back(
        {reports::FrontView(head, database.points(face), frame), fmt::format("person {}", database.id(face).person)});
  }
  return render::MakeSheet(cells, 8);
}

/// All expressions of the first three persons, each exaggerated by another level, the least first.
render::Image Expressions(const FaceDatabase& database) {
  constexpr int kColumns = 9;
  const int num_persons = std::min(3, database.num_persons()), num_expressions = database.num_expressions();
  const auto face = [&](int person, int expression) {
    const int level = num_persons > 1 ? person * (database.num_levels() - 1) / (num_persons - 1) : 0;
    return database.index({person, level, expression});
  };
  std::vector<int> indices;
  for (int person = 0; person < num_persons; ++person) {
    for (int expression = 0; expression < num_expressions; ++expression) indices.push_back(face(person, expression));
  }
  const render::Frame frame = reports::FrameOfFaces(database, indices);
  const faces::FinishedHead head(database.face_template());
  std::vector<SheetCell> cells;
  render::SheetStyle style;
  const int num_columns = std::min(kColumns, num_expressions);
  for (int begin = 0; begin < num_expressions; begin += num_columns) {
    for (int person = 0; person < num_persons; ++person) {
      style.row_titles.push_back(fmt::format("person {}, level {}", person, database.id(face(person, 0)).level + 1));
      for (int expression = begin; expression < begin + num_columns; ++expression) {
        if (expression >= num_expressions) {
          cells.push_back({});
          continue;
        }
        cells.push_back({reports::FrontView(head, database.points(face(person, expression)), frame),
                         person == 0 ? database.expression_names()[expression] : ""});
      }
    }
  }
  return render::MakeSheet(cells, num_columns, style);
}

render::Image Levels(const FaceDatabase& database) {
  const int num_persons = std::min(4, database.num_persons());
  std::vector<int> indices;
  for (int person = 0; person < num_persons; ++person) {
    for (int level = 0; level < database.num_levels(); ++level) indices.push_back(database.index({person, level, 0}));
  }
  const render::Frame frame = reports::FrameOfFaces(database, indices);
  const faces::FinishedHead head(database.face_template());
  render::SheetStyle style;
  std::vector<SheetCell> cells;
  for (int person = 0; person < num_persons; ++person) {
    style.row_titles.push_back(fmt::format("person {}", person));
    const auto row = indices.begin() + person * database.num_levels();
    for (int level = 0; level < database.num_levels(); ++level)
      cells.push_back({reports::FrontView(head, database.points(row[level]), frame)});
    for (int level = 0; level < database.num_levels(); ++level)
      cells.push_back({reports::SideView(head, database.points(row[level]), frame)});
  }
  for (int column = 0; column < 2 * database.num_levels(); ++column) {
    style.column_titles.push_back(fmt::format("level {}", column % database.num_levels() + 1));
  }
  return render::MakeSheet(cells, 2 * database.num_levels(), style);
}

/// 48 exaggerated faces, the first persons in turn at every level but the first, from the front and from three quarters.
render::Image Caricatures(const FaceDatabase& database) {
  constexpr int kNumFaces = 48, kPairsInARow = 6;
  constexpr double kTurn = -0.6;  // Radians.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(kTurn, geometry::Vector3::UnitY()).toRotationMatrix();
  const int num_exaggerated = database.num_levels() - 1;
  const auto& head = database.face_template();
  const faces::FinishedHead finished(head);
  const render::Frame frame = reports::FrameOfFaces({head.neutral}, 1.35);
  std::vector<SheetCell> cells;
  for (int i = 0; i < std::min(kNumFaces, database.num_persons() * num_exaggerated); ++i) {
    const geometry::Points face =
        database.points(database.index({i % database.num_persons(), 1 + i % num_exaggerated, 0}));
    cells.push_back({reports::FrontView(finished, face, frame)});
    const geometry::Points turned = (face.rowwise() - frame.centre.transpose()) * turn.transpose();
    cells.push_back({reports::FrontView(finished, turned.rowwise() + frame.centre.transpose(), frame)});
  }
  return render::MakeSheet(cells, 2 * kPairsInARow);
}

/// The mean face with the curves of one view drawn over it, and dots for landmarks.
render::Image AnnotatedView(const faces::FaceTemplate& face_template, faces::View view) {
  constexpr int kSide = 560;
  const render::Frame frame = render::FrameOf(face_template.neutral);
  const auto camera = view == faces::View::kFrontal ? render::FrontalCamera(frame.centre, frame.half_height, kSide)
                                                    : render::SideCamera(frame.centre, frame.half_height, kSide);
  render::Image image =
      render::RenderMesh(reports::InputOf(faces::FinishedHead(face_template), face_template.neutral), camera);
  const geometry::Points pixels = render::Project(camera, face_template.neutral);
  const auto dot = [&](int vertex, int radius, const render::Rgb& colour) {
    render::FillRectangle(image, static_cast<int>(pixels(vertex, 1)) - radius,
                          static_cast<int>(pixels(vertex, 0)) - radius, 2 * radius + 1, 2 * radius + 1, colour);
  };
  std::vector<render::Stroke> strokes;
  for (const faces::FeatureCurve& curve : face_template.annotation.curves) {
    if (curve.view != view) continue;
    render::Stroke& stroke = strokes.emplace_back();
    const auto add = [&](int vertex) {
      const double to_canvas = static_cast<double>(render::kSketchCanvas) / kSide;
      stroke.points.push_back(
          {static_cast<float>(pixels(vertex, 0) * to_canvas), static_cast<float>(pixels(vertex, 1) * to_canvas)});
    };
    for (const int vertex : curve.vertices) add(vertex);
    if (curve.closed) add(curve.vertices.front());
  }
  const render::Image ink = render::RasteriseStrokes(strokes, kSide);
  for (size_t pixel = 0; pixel < ink.pixels.size(); ++pixel) {
    for (int channel = 0; channel < 3; ++channel) {
      uint8_t& value = image.pixels[3 * pixel + channel];
      value = static_cast<uint8_t>(value * ink.pixels[pixel] / 255);
    }
  }
  if (view == faces::View::kFrontal) {
    for (const int vertex : face_template.annotation.landmarks) dot(vertex, 2, {200, 40, 40});
    dot(face_template.annotation.hairline_vertex, 3, {30, 90, 200});
  }
  return image;
}

render::Image Curves(const faces::FaceTemplate& face_template) {
  return render::MakeSheet(
      {{AnnotatedView(face_template, faces::View::kFrontal), "frontal curves, 68 landmarks (red), hairline (blue)"},
       {AnnotatedView(face_template, faces::View::kSide), "side-view curves"}},
      2);
}

}  // namespace

void CheckGalleryFolder(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs) {
  CheckOutputFolder(out, {kGalleryKind}, inputs);
  CheckOwnFiles(out, kFacePictures);
  CheckOwnFiles(out, kSketchPictures);
}

void WriteGallery(const FaceDatabase& database, const SketchDatabase* sketches, const std::filesystem::path& folder,
                  const Task& task) {
  std::vector<GalleryPicture> pictures = {
      {kFacePictures[0], [&] { return Identities(database); }},
      {kFacePictures[1], [&] { return Expressions(database); }},
      {kFacePictures[2], [&] { return Levels(database); }},
  };
  if (database.num_levels() > 1) pictures.push_back({kFacePictures[3], [&] { return Caricatures(database); }});
  pictures.push_back({kFacePictures[4], [&] { return Curves(database.face_template()); }});
  if (sketches != nullptr) std::ranges::move(SketchPictures(database, *sketches), std::back_inserter(pictures));
  Manifest manifest{.kind = kGalleryKind, .verb = "dataset gallery"};
  manifest.sources = database.manifest().sources;
  manifest.counts = {{"faces", database.num_faces()}};
  // Pictures of sketches of an earlier gallery stay, and stay listed.
  for (const std::string& name : kSketchPictures)
    if (sketches == nullptr && std::filesystem::exists(folder / name))
      manifest.checksums[name] = Sha256OfFile(folder / name);
  Manifest begun = manifest;
  Json& unfinished = begun.details[kUnfinishedFiles] = Json::array();
  for (const GalleryPicture& picture : pictures) unfinished.push_back(picture.name);
  WriteManifest(folder, begun);

  const auto num_pictures = int64_t(pictures.size());
  for (int64_t done = 0; done < num_pictures; ++done) {
    task.Report(done, num_pictures, "pictures");
    task.ThrowIfCancelled("stopped after {} of {} pictures in {}; the same command makes all of them", done,
                          num_pictures, folder.string());
    render::WriteImage(folder / pictures[done].name, pictures[done].draw());
  }
  for (const GalleryPicture& picture : pictures) manifest.checksums[picture.name] = Sha256OfFile(folder / picture.name);
  WriteManifest(folder, manifest);
  task.Report(num_pictures, num_pictures, "pictures");
}

}  // namespace daumier::datasets

#include "benchmark/inputs.h"

#include "core/random.h"
#include "datasets/read/portrait_camera.h"
#include "datasets/styles/draw_in_style.h"
#include "datasets/styles/drawing_raster.h"
#include "fitting/code_landmarks.h"

#include <cmath>
#include <numbers>

namespace daumier::benchmark {
namespace {

constexpr uint64_t kFacesOfPerson = 1000, kStyles = 3;
constexpr double kRadians = std::numbers::pi / 180;
/// Distance of the outer eye corners in space, as a share of the picture.
constexpr double kEyeShare = 0.2;
constexpr size_t kRightCorner = 36, kLeftCorner = 45;

struct NamedStyle {
  const char* name;
  const datasets::StyleOptions& options;
};

template <class T, size_t N>
Json NameOf(const datasets::ShownWith<T>& state, const std::array<std::string_view, N>& names) {
  return state.is_shown() ? Json(names[size_t(state.value)]) : Json();
}

/// The label of a drawing (eval/drawing_labels.h) in pixels of its picture. A drawing without both outer corners of the eyes
/// has no unit of errors.
Json LabelOf(const datasets::StyledDrawing& drawing, const std::string& file, int size) {
  const double pixels = double(size) / render::kSketchCanvas;
  Json points = Json::object();
  const auto place = [&](faces::FacePoint point) {
    const auto& shown = drawing.points[size_t(point)];
    return Eigen::Vector2d(pixels * shown.value[0], pixels * shown.value[1]);
  };
  for (size_t i = 0; i < drawing.points.size(); ++i) {
    if (!drawing.points[i].is_shown()) continue;
    const Eigen::Vector2d at = place(static_cast<faces::FacePoint>(i));
    points[faces::kFacePointNames[i]] = {std::round(100 * at.x()) / 100, std::round(100 * at.y()) / 100};
  }
  const auto is_shown = [&](faces::FacePoint point) { return drawing.points[size_t(point)].is_shown(); };
  using enum faces::FacePoint;
  const bool usable = is_shown(kEyeRightOuter) && is_shown(kEyeLeftOuter);
  Json label = {{"file", file}, {"usable", usable}, {"points", points}};
  if (usable) label["interocular"] = std::round(100 * (place(kEyeRightOuter) - place(kEyeLeftOuter)).norm()) / 100;
  label["mouth"] = NameOf(drawing.mouth, faces::kMouthStateNames);
  const bool same =
      drawing.eyes[0].is_shown() && drawing.eyes[1].is_shown() && drawing.eyes[0].value == drawing.eyes[1].value;
  label["eyes"] = same ? NameOf(drawing.eyes[0], faces::kEyeStateNames) : Json();
  return label;
}

/// A random view of a face: upright but for the greatest angles, in the middle of the picture.
fitting::ScaledView DrawView(const geometry::Points& landmarks, const CaricaturesOptions& options, Rng& rng) {
  const std::array<float, 3> angles = {float(kRadians * options.pitch * rng.Uniform(-1, 1)),
                                       float(kRadians * options.yaw * rng.Uniform(-1, 1)),
                                       float(kRadians * options.roll * rng.Uniform(-1, 1))};
  fitting::ScaledView view;
  view.rotation = datasets::PoseRotation(angles);
  view.scale = kEyeShare * options.size / (landmarks.row(kRightCorner) - landmarks.row(kLeftCorner)).norm();
  const Eigen::RowVector2d middle = view.Project(landmarks).colwise().mean();
  view.shift = Eigen::Vector2d::Constant(options.size / 2) - middle.transpose();
  return view;
}

/// Where a picture shows the 68 landmarks: those of the jaw on the silhouette, as people mark them.
fitting::PicturePoints SeenLandmarks(const faces::FaceTemplate& face_template, const geometry::Points& vertices,
                                     const fitting::ContourPaths& contour, const fitting::ScaledView& view) {
  fitting::PicturePoints seen(68, 2);
  const double roll = std::atan2(view.rotation(1, 0), view.rotation(0, 0));
  for (int i = 0; i < 68; ++i) {
    int vertex = face_template.annotation.landmarks[size_t(i)];
    if (i < fitting::ContourPaths::kNumJaw) {
      const std::vector<int>& path = contour.vertices(i);
      vertex = path[size_t(contour.Outermost(i, view.Project(vertices(path, Eigen::all)), roll))];
    }
    seen.row(i) = view.Project(vertices.row(vertex)).row(0);
  }
  return seen;
}

}  // namespace

std::string FaceName(int person, int face) {
  return fmt::format("person-{:03}-{}", person, char('a' + face % 26));
}

std::vector<KitDrawing> DrawingsOf(const faces::FaceDatabase& faces, const datasets::SketchDatabase& sketches,
                                   const DrawingsOptions& options, int person, uint64_t seed) {
  const NamedStyle styles[kStyles] = {{"clean", options.clean}, {"drawn", options.drawn}, {"rough", options.rough}};
  std::vector<KitDrawing> drawings;
  for (int k = 0; k < options.per_person; ++k) {
    const uint64_t stream = uint64_t(person) * kFacesOfPerson + uint64_t(k);
    Rng rng = Stream(seed, "benchmark drawing", stream);
    const int face = faces.index({person, k % faces.num_levels(), int(rng.Below(uint64_t(faces.num_expressions())))});
    for (uint64_t s = 0; s < kStyles; ++s) {
      Rng hand = Stream(seed, "benchmark style", stream * kStyles + s);
      const datasets::StyledDrawing drawing =
          datasets::DrawInStyle(datasets::ShapeOf(sketches, face), styles[s].options, hand);
      KitDrawing& made = drawings.emplace_back();
      made.face = face;
      made.item = {FaceName(person, k) + "-" + styles[s].name, person, FaceName(person, k), styles[s].name};
      made.picture = datasets::RasteriseDrawing(drawing, options.size, datasets::PenView::kAsDrawn);
      made.label = LabelOf(drawing, made.item.name + ".png", options.size);
    }
  }
  return drawings;
}

std::vector<KitCaricature> CaricaturesOf(const faces::FaceDatabase& faces, const CaricaturesOptions& options,
                                         int person, uint64_t seed) {
  const faces::FaceTemplate& face_template = faces.face_template();
  const fitting::ContourPaths contour(face_template);
  const std::vector<int> landmarks(face_template.annotation.landmarks.begin(),
                                   face_template.annotation.landmarks.end());
  std::vector<KitCaricature> caricatures;
  for (int k = 0; k < options.per_person; ++k) {
    Rng rng = Stream(seed, "benchmark caricature", uint64_t(person) * kFacesOfPerson + uint64_t(k));
    KitCaricature& made = caricatures.emplace_back();
    const int level = faces.num_levels() - 1;
    made.face = faces.index({person, level, int(rng.Below(uint64_t(faces.num_expressions())))});
    made.item = {FaceName(person, k), person, FaceName(person, k), fmt::format("level-{}", level + 1)};
    const geometry::Points vertices = faces.points(made.face);
    made.places = vertices(landmarks, Eigen::all);
    const fitting::PicturePoints seen =
        SeenLandmarks(face_template, vertices, contour, DrawView(made.places, options, rng));
    const double deviation = options.noise * (seen.row(kRightCorner) - seen.row(kLeftCorner)).norm();
    for (size_t i = 0; i < made.pixels.size(); ++i)
      made.pixels[i] = seen(Eigen::Index(i / 2), Eigen::Index(i % 2)) + deviation * rng.Normal();
  }
  return caricatures;
}

}  // namespace daumier::benchmark

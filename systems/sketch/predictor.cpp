#include "systems/sketch/predictor.h"

#include "core/error.h"
#include "core/log.h"
#include "geometry/coordinates.h"
#include "render/faces_on_sheet.h"
#include "render/line_drawing.h"
#include "render/sparse_strokes.h"
#include "systems/predict_each.h"
#include "systems/training_library.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace daumier::sketch {
namespace {

using Strokes = std::vector<render::Stroke>;

/// Of a frame search; a task is cancelled between them.
constexpr size_t kSketchesAtOnce = 16;

geometry::Points LandmarksOf(const faces::FaceTemplate& face_template, const geometry::Points& vertices) {
  const auto& landmarks = face_template.annotation.landmarks;
  geometry::Points points(Eigen::Index(landmarks.size()), 3);
  for (size_t i = 0; i < landmarks.size(); ++i) {
    const Eigen::Index row(i), vertex = landmarks[i];
    if (vertex >= 0 && vertex < vertices.rows()) {
      points.row(row) = vertices.row(vertex);
    } else {
      points.row(row).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return points;
}

render::Drawing DrawingOf(const systems::Input& input) {
  if (const auto* drawing = std::get_if<render::Drawing>(&input)) return *drawing;
  if (const auto* image = std::get_if<render::Image>(&input)) return render::TraceLineDrawing(*image).drawing;
  throw Error(
      "a mesh is no input of a sketch run (expected a drawing or an image of one). Draw it first: daumier draw");
}

std::string BadFit(double distance_px, bool is_framed) {
  return fmt::format(
      "the predicted face fits the drawing badly: its lines are {:.1f} pixels from the drawn ones, of a canvas of {} "
      "(faces have {} or less). {}",
      distance_px, render::kSketchCanvas, kBadFitPx,
      is_framed
          ? "Is it one frontal face, drawn by lines?"
          : "Is it a face in the frame of the training sketches? Without framing=keep (--keep-frame) its frame is "
            "found");
}

}  // namespace

render::Placement SheetPlacement(const render::Drawing& drawing) {
  const double side = std::max(drawing.width, drawing.height), scale = render::kSketchCanvas / side;
  return {scale, 0.5 * scale * Eigen::Vector2d(side - drawing.width, side - drawing.height)};
}

SketchPredictor::SketchPredictor(SketchRunFolder run, std::shared_ptr<const runtime::NetworkRunner> network,
                                 const PredictOptions& options)
    : run_(std::move(run)),
      options_(options),
      face_template_(std::make_shared<const faces::FaceTemplate>(run_.face_template)),
      network_(run_, std::move(network)),
      refiner_(run_.models.bilinear, network_.curves(), options.refinement) {
  if (options.deform) {
    deformer_.emplace(run_.face_template.triangles, run_.face_template.num_vertices(), network_.curves(),
                      options.deformation);
  }
}

fitting::PredictedFace SketchPredictor::Refined(const fitting::PredictedFace& face, const Strokes& strokes) const {
  return refiner_.Refine(face, strokes);
}

fitting::PredictedFace SketchPredictor::Deformed(fitting::PredictedFace face, const Strokes& strokes) const {
  DAUMIER_CHECK(deformer_.has_value(), "the predictor was opened without deform=true");
  face.vertices = deformer_->Deform(face.vertices, strokes);
  return face;
}

fitting::PredictedFace SketchPredictor::MeanFace(const Strokes& strokes,
                                                 std::span<const fitting::WeightedFrame> frames) const {
  std::vector<Strokes> sketches;
  for (const fitting::WeightedFrame& frame : frames) sketches.push_back(render::MapToCanvas(strokes, frame.placement));
  const std::vector<fitting::PredictedFace> faces = FromStrokes(sketches);
  if (faces.size() == 1) return faces.front();
  const auto of = [](const std::vector<float>& vertices) {
    return Eigen::Map<const Eigen::VectorXf>(vertices.data(), Eigen::Index(vertices.size()));
  };
  Eigen::VectorXf u = Eigen::VectorXf::Zero(faces[0].u.size()), v = Eigen::VectorXf::Zero(faces[0].v.size()),
                  vertices = Eigen::VectorXf::Zero(of(faces[0].vertices).size());
  for (size_t i = 0; i < faces.size(); ++i) {
    const auto weight = static_cast<float>(frames[i].weight);
    u += weight * faces[i].u;
    v += weight * faces[i].v;
    vertices += weight * of(faces[i].vertices);
  }
  return {std::move(u), std::move(v), {vertices.data(), vertices.data() + vertices.size()}};
}

std::vector<systems::Input> SketchPredictor::Separate(systems::Input input) const {
  if (options_.faces != "all" || options_.framing == "keep" || std::holds_alternative<geometry::PolygonMesh>(input))
    return {std::move(input)};
  std::vector<systems::Input> inputs;
  const render::Drawing sheet = DrawingOf(input);
  std::vector<render::Drawing> faces = render::FacesOnSheet(sheet);
  if (const size_t num_left_out = render::NumLeftOut(sheet, faces); num_left_out > 0)
    log::Warn("{} strokes apart from the faces are left out", num_left_out);
  for (render::Drawing& face : faces) inputs.emplace_back(std::move(face));
  return inputs;
}

std::vector<systems::FaceResult> SketchPredictor::Predict(std::span<const systems::Input> inputs,
                                                          const Task& task) const {
  return systems::PredictEach(inputs, task, "drawings",
                              [&](const systems::Input& input) { return PredictOne(DrawingOf(input), task); });
}

systems::FaceResult SketchPredictor::PredictOne(const render::Drawing& sheet, const Task& task) const {
  const bool fit = options_.framing == "fit";
  const std::vector<render::Drawing> on_sheet = fit ? render::FacesOnSheet(sheet) : std::vector<render::Drawing>{sheet};
  const render::Drawing& drawing = render::LargestFace(on_sheet);
  task.ThrowIfCancelled("stopped before the drawing was framed");
  render::FramedDrawing framed =
      fit ? render::FrameDrawing(drawing) : render::FramedDrawing{drawing.strokes, {}, SheetPlacement(drawing)};
  const Strokes drawn = std::exchange(framed.strokes, render::SparseStrokes(framed.strokes, framed.placement.scale));
  task.ThrowIfCancelled("stopped before the drawing was framed");
  fitting::FoundFrame found{.placement = framed.placement, .near = {{framed.placement, 1.0}}};
  if (fit) {
    const fitting::CurvesOfSketches curves_of = [&](const std::vector<Strokes>& sketches) {
      std::vector<Strokes> curves;
      for (size_t first = 0; first < sketches.size(); first += kSketchesAtOnce) {
        task.ThrowIfCancelled("stopped while the frame of the drawing was searched");
        const auto last = sketches.begin() + ptrdiff_t(std::min(first + kSketchesAtOnce, sketches.size()));
        for (const fitting::PredictedFace& face : FromStrokes({sketches.begin() + ptrdiff_t(first), last}))
          curves.push_back(CurvesOf(face));
      }
      return curves;
    };
    found = fitting::FindFrame(framed, curves_of, options_.search, task);
  }
  const render::Placement& placement = found.placement;
  const Strokes before = render::MapToCanvas(framed.strokes, framed.placement),
                strokes = render::MapToCanvas(framed.strokes, placement);
  task.ThrowIfCancelled("stopped before the face was predicted");
  const fitting::PredictedFace of_box = FromStrokes({before}).front(), predicted = MeanFace(framed.strokes, found.near);
  fitting::PredictedFace face = options_.refine ? Refined(predicted, strokes) : predicted;
  task.ThrowIfCancelled("stopped before the face was complete");
  const auto distance = [&](const Strokes& drawn, const fitting::PredictedFace& of) {
    return fitting::DistanceBetween(drawn, CurvesOf(of)).two_way();
  };
  const double fit_px = distance(strokes, face);
  if (options_.deform) face = Deformed(std::move(face), strokes);

  systems::FaceResult result;
  result.face_template = face_template_;
  result.vertices = geometry::PointsFrom(face.vertices);
  result.identity = face.u;
  result.expression = face.v;
  result.landmarks = LandmarksOf(*face_template_, result.vertices);
  result.frame = placement;
  result.drawn = render::MapToCanvas(drawn, placement);
  result.curves = CurvesOf(face);
  const fitting::FrameSearchOptions& search = options_.search;
  if (on_sheet.size() > 1)
    result.warnings.push_back(fmt::format(
        "the sheet holds {} faces, of which the largest is predicted (`daumier predict --all` predicts each)",
        on_sheet.size()));
  if (const size_t num_left_out = render::NumLeftOut(sheet, on_sheet); num_left_out > 0)
    result.warnings.push_back(fmt::format("{} strokes apart from the face are left out", num_left_out));
  if (fit_px > kBadFitPx) result.warnings.push_back(BadFit(fit_px, fit));
  result.record = {
      {"frame", {{"scale", placement.scale}, {"shift", {placement.shift.x(), placement.shift.y()}}}},
      {"two_way_distance_px",
       {{"before", distance(before, of_box)},
        {"framed", distance(strokes, predicted)},
        {"after", options_.deform ? distance(strokes, face) : fit_px},
        {"after_trimmed",
         fitting::DistanceBetween(strokes, result.curves, search.drawn_trim, search.projected_trim).two_way()}}}};
  return result;
}

std::unique_ptr<systems::Predictor> OpenSketchPredictor(const std::filesystem::path& run, const Device& device,
                                                        const Json& options) {
  SketchRunFolder folder = ReadSketchRunFolder(run);
  const auto parsed = ParseOptions<PredictOptions>(options, "options of predict");
  return std::make_unique<SketchPredictor>(std::move(folder), systems::LoadTrainingLibrary().open_network(run, device),
                                           parsed);
}

}  // namespace daumier::sketch

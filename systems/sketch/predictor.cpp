#include "systems/sketch/predictor.h"

#include "core/error.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/weights_folder.h"
#include "geometry/coordinates.h"
#include "render/faces_on_sheet.h"
#include "render/heat_map_decoding.h"
#include "render/sparse_strokes.h"
#include "systems/open_network.h"
#include "systems/predict_each.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/input_drawing.h"
#include "systems/sketch/parsed_face.h"
#include "systems/sketch/parser_predictor.h"
#include "systems/sketch/parser_run_folder.h"
#include "systems/sketch/sketch_weights.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace daumier::sketch {
namespace {

using Strokes = std::vector<render::Stroke>;

constexpr double kFarPoints = 0.4;  // Of the eye distance, likewise.
constexpr double kWildDrawing = 3;  // Residual scale from which a drawing hardly looks like a face.

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

Json StatesToJson(const ParsedDrawing& parsed) {
  return {{"mouth", faces::kMouthStateNames[render::Likeliest(parsed.mouth)]},
          {"eye_right", faces::kEyeStateNames[render::Likeliest(parsed.eyes[0])]},
          {"eye_left", faces::kEyeStateNames[render::Likeliest(parsed.eyes[1])]},
          {"view", faces::kDrawnViewNames[render::Likeliest(parsed.view)]}};
}

}  // namespace

render::Placement SheetPlacement(const render::Drawing& drawing) {
  const double side = std::max(drawing.width, drawing.height), scale = render::kSketchCanvas / side;
  return {scale, 0.5 * scale * Eigen::Vector2d(side - drawing.width, side - drawing.height)};
}

SketchPredictor::SketchPredictor(SketchRunFolder run, std::shared_ptr<const runtime::NetworkRunner> network,
                                 std::shared_ptr<const DrawingParser> parser, const PredictOptions& options)
    : run_(std::move(run)),
      options_(options),
      face_template_(std::make_shared<const faces::FaceTemplate>(run_.face_template)),
      network_(run_, std::move(network)) {
  if (options_.framing == "keep") {
    if (!options_.refine) return;
    DAUMIER_CHECK(run_.models.bilinear.num_coordinates() > 0,
                  "{}: shipped weights have no bilinear model, by which contours are matched: give refine=false",
                  run_.directory.string());
    refiner_.emplace(run_.models.bilinear, network_.curves(), options.refinement);
    return;
  }
  DAUMIER_CHECK(parser != nullptr, "a drawing is framed by a parser of drawings, and there is none");
  fitter_.emplace(run_, std::move(parser), options.fitting);
}

fitting::PredictedFace SketchPredictor::Refined(const fitting::PredictedFace& face, const Strokes& strokes) const {
  DAUMIER_CHECK(refiner_.has_value(), "the predictor was opened without framing=keep and refine=true");
  return refiner_->Refine(face, strokes);
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

SketchPredictor::Found SketchPredictor::OfCanvas(const Strokes& strokes, const render::Placement& placement) const {
  const Strokes on_canvas = render::MapToCanvas(strokes, placement);
  Found found{.face = FromStrokes({on_canvas}).front(), .placement = placement};
  if (options_.refine) found.face = Refined(found.face, on_canvas);
  return found;
}

SketchPredictor::Found SketchPredictor::OfParsed(const Strokes& strokes, const Task& task) const {
  const ParsedDrawing parsed = fitter_->Parse(strokes);
  RefuseProfile(parsed);
  task.ThrowIfCancelled("stopped before the face was predicted");
  Found found;
  found.warnings = ParseWarnings(parsed);
  found.placement = fitter_->FrameOf(parsed);
  found.face = FromStrokes({render::MapToCanvas(LinesOfFace(parsed), found.placement)}).front();
  found.record["states"] = StatesToJson(parsed);
  found.record["drawn_parts"] = DrawnParts(parsed);
  task.ThrowIfCancelled("stopped before the face was complete");
  if (options_.fit) FitTo(parsed, found);
  return found;
}

void SketchPredictor::FitTo(const ParsedDrawing& parsed, Found& found) const {
  const fitting::LabelledFit fit = fitter_->Fit(parsed, found.placement, found.face.vertices);
  const bool is_front = render::Likeliest(parsed.view) == size_t(faces::DrawnView::kFront);
  // A turned face is written upright, in the frame where it is nearest to the drawing; its turn is in the record.
  found.face.vertices = is_front ? fit.vertices : fitting::Upright(fit);
  found.placement = is_front ? render::Composed(render::Inverse(fit.frame), found.placement)
                             : fitter_->FrameOf(parsed, found.face.vertices);
  found.record["fit"] = {{"points_rms_share", fit.rms},          {"residual_scale", fit.residual_scale},
                         {"yaw_degrees", fit.yaw_degrees},       {"pitch_degrees", fit.pitch_degrees},
                         {"flipped_triangles", fit.num_flipped}, {"crossed_lips", fit.num_crossed_lips},
                         {"crossed_lids", fit.num_crossed_lids}};
  if (fit.residual_scale <= kWildDrawing && fit.rms > kFarPoints)
    found.warnings.push_back(fmt::format(
        "the points of the drawing are {:.0f} % of the distance of the eyes from those of the face (faces by "
        "most people less than {:.0f} %). Is it one face, upright, drawn by lines?",
        100 * fit.rms, 100 * kFarPoints));
  if (fit.residual_scale > kWildDrawing)
    found.warnings.push_back(
        fmt::format("the drawing differs from any face: {:.1f} times as much as careful drawings (faces by most people "
                    "less than {}). Is it one face, drawn by lines?",
                    fit.residual_scale, kWildDrawing));
}

systems::FaceResult SketchPredictor::PredictOne(const render::Drawing& sheet, const Task& task) const {
  const bool is_framed = options_.framing == "fit";
  const std::vector<render::Drawing> on_sheet =
      is_framed ? render::FacesOnSheet(sheet) : std::vector<render::Drawing>{sheet};
  const render::Drawing& drawing = render::LargestFace(on_sheet);
  task.ThrowIfCancelled("stopped before the drawing was read");
  const render::FramedDrawing framed =
      is_framed ? render::FrameDrawing(drawing) : render::FramedDrawing{drawing.strokes, {}, SheetPlacement(drawing)};
  const Strokes strokes = render::SparseStrokes(framed.strokes, framed.placement.scale);
  task.ThrowIfCancelled("stopped before the drawing was read");
  Found found = is_framed ? OfParsed(strokes, task) : OfCanvas(strokes, framed.placement);

  systems::FaceResult result;
  result.face_template = face_template_;
  result.vertices = geometry::PointsFrom(found.face.vertices);
  result.identity = found.face.u;
  result.expression = found.face.v;
  result.landmarks = LandmarksOf(*face_template_, result.vertices);
  result.frame = found.placement;
  result.drawn = render::MapToCanvas(framed.strokes, found.placement);
  result.curves = CurvesOf(found.face);
  result.warnings = std::move(found.warnings);
  if (on_sheet.size() > 1)
    result.warnings.push_back(fmt::format(
        "the sheet holds {} faces, of which the largest is predicted (`daumier predict --all` predicts each)",
        on_sheet.size()));
  if (const size_t num_left_out = render::NumLeftOut(sheet, on_sheet); num_left_out > 0)
    result.warnings.push_back(fmt::format("{} strokes apart from the face are left out", num_left_out));
  result.record = std::move(found.record);
  result.record["frame"] = render::PlacementToJson(found.placement);
  if (sheet.picture_from_sheet)
    result.record["picture_from_sheet"] = render::HomographyToJson(*sheet.picture_from_sheet);
  return result;
}

std::unique_ptr<systems::Predictor> OpenSketchPredictor(const std::filesystem::path& run, const Device& device,
                                                        const Json& options) {
  const auto parsed = ParseOptions<PredictOptions>(options, "options of predict");
  const bool is_framed = parsed.framing != "keep";
  if (!is_framed && parsed.refine && IsWeightsFolder(run))
    throw UsageError(
        fmt::format("{}: shipped weights have no bilinear model, by which contours are matched: give "
                    "refine=false",
                    run.string()));
  const std::filesystem::path of_parser = is_framed ? ParserFolder(parsed.parser) : std::filesystem::path();
  std::optional<SketchRunFolder> folder;
  std::unique_ptr<runtime::NetworkRunner> network;
  std::shared_ptr<const DrawingParser> parser;
  OnAllCores(3, [&](int64_t part) {  // On two cores the first next to the others, which take as long.
    if (part == 0) folder = ReadSketchFolder(run);
    if (part == 1) network = systems::OpenNetwork(run, device);
    if (part == 2 && is_framed) {
      parser = std::make_shared<DrawingParser>(OpenDrawingParser(of_parser, device, parsed.parsing));
    }
  });
  return std::make_unique<SketchPredictor>(std::move(*folder), std::move(network), std::move(parser), parsed);
}

}  // namespace daumier::sketch

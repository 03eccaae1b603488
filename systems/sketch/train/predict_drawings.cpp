#include "systems/sketch/train/predict_drawings.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/manifest.h"
#include "reports/face_surface.h"
#include "systems/sketch/train/sketch_predictor.h"
#include "geometry/coordinates.h"
#include "geometry/obj.h"
#include "render/camera.h"
#include "render/read_drawing.h"
#include "render/shading.h"
#include "render/sheet.h"
#include "render/stroke_overlay.h"
#include "render/svg.h"

#include <optional>
#include <set>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;
using render::Image;
using Strokes = std::vector<render::Stroke>;

constexpr int kPictureSide = 360;

struct NamedDrawing {
  std::string name;
  fs::path file;
  render::Drawing drawing;
};

/// A drawing on the canvas and the face that was found for it.
struct Prediction {
  std::string name;
  Strokes strokes, curves;
  geometry::Points face;
  Json record;
};

std::vector<NamedDrawing> ReadAll(const std::vector<fs::path>& files) {
  std::set<std::string> taken;
  std::vector<NamedDrawing> all;
  for (const fs::path& file : files) {
    for (render::Drawing& drawing : render::ReadDrawings(file)) {
      const std::string stem = file.stem().string();
      std::string name = stem;
      for (int copy = 2; !taken.insert(name).second; ++copy) name = fmt::format("{}-{}", stem, copy);
      all.push_back({name, file, std::move(drawing)});
    }
  }
  return all;
}

Image SheetOf(const faces::FaceTemplate& face_template, const Prediction& prediction) {
  const render::RenderInput input = reports::SurfaceOf(face_template, prediction.face);
  const auto frame = render::FrameOf(prediction.face);
  return render::MakeSheet(
      {{render::DrawnWithCurves(prediction.strokes, prediction.curves, kPictureSide), "sketch, and the face's curves"},
       {RenderMesh(input, render::FrontalCamera(frame.centre, frame.half_height, kPictureSide)), "front"},
       {RenderMesh(input, render::SideCamera(frame.centre, frame.half_height, kPictureSide)), "side"}},
      3);
}

class DrawingPrediction {
 public:
  DrawingPrediction(SketchPredictor& predictor, const PredictOptions& options)
      : predictor_(predictor),
        options_(options),
        refiner_(predictor.run().models.bilinear, predictor.curves(), options.refinement) {
    const faces::FaceTemplate& face_template = predictor.run().face_template;
    if (options.deform)
      deformer_.emplace(face_template.triangles, face_template.num_vertices(), predictor.curves(), options.deformation);
  }

  Prediction Predict(const NamedDrawing& named) {
    const bool fit = options_.framing == Framing::kFit;
    const render::FramedDrawing framed =
        fit ? render::FrameDrawing(named.drawing)
            : render::FramedDrawing{named.drawing.strokes, {}, SheetPlacement(named.drawing)};
    render::Placement placement = framed.placement;
    if (fit) placement = fitting::FindFrame(framed, Curves(), options_.search).placement;

    Prediction result;
    result.name = named.name;
    result.strokes = render::Place(framed.strokes, placement);
    const Strokes before = render::Place(framed.strokes, framed.placement);
    const std::vector<fitting::PredictedFace> faces = predictor_.Predict({before, result.strokes});
    fitting::PredictedFace face = options_.refine ? refiner_.Refine(faces[1], result.strokes) : faces[1];
    if (deformer_) face.vertices = deformer_->Deform(face.vertices, result.strokes);
    result.curves = predictor_.CurvesOf(face);
    result.face = geometry::PointsFrom(face.vertices);

    const auto distance = [&](const Strokes& strokes, const fitting::PredictedFace& of) {
      return fitting::DistanceBetween(strokes, predictor_.CurvesOf(of)).two_way();
    };
    const auto& search = options_.search;
    result.record = {
        {"frame", {{"scale", placement.scale}, {"shift", {placement.shift.x(), placement.shift.y()}}}},
        {"two_way_distance_px",
         {{"before", distance(before, faces[0])},
          {"framed", distance(result.strokes, faces[1])},
          {"after", distance(result.strokes, face)},
          {"after_trimmed",
           fitting::DistanceBetween(result.strokes, result.curves, search.drawn_trim, search.projected_trim).two_way()}}}};
    return result;
  }

 private:
  fitting::CurvesOfSketches Curves() {
    return [this](const std::vector<Strokes>& sketches) {
      std::vector<Strokes> curves;
      for (const fitting::PredictedFace& face : predictor_.Predict(sketches)) curves.push_back(predictor_.CurvesOf(face));
      return curves;
    };
  }

  SketchPredictor& predictor_;
  const PredictOptions& options_;
  fitting::ContourRefiner refiner_;
  std::optional<fitting::StrokeDeformer> deformer_;
};

}  // namespace

render::Placement SheetPlacement(const render::Drawing& drawing) {
  const double side = std::max(drawing.width, drawing.height), scale = render::kSketchCanvas / side;
  return {scale, 0.5 * scale * Eigen::Vector2d(side - drawing.width, side - drawing.height)};
}

void PredictSketches(const fs::path& run_directory, const std::vector<fs::path>& files, const fs::path& out_directory,
                     const PredictOptions& options) {
  SketchPredictor predictor(run_directory);
  const auto& run = predictor.run();
  DrawingPrediction prediction(predictor, options);
  std::vector<Prediction> predictions;
  Json records = Json::object();
  for (const NamedDrawing& drawing : ReadAll(files)) {
    try {
      predictions.push_back(prediction.Predict(drawing));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", drawing.file.string(), error.what()));
    }
    const Json& record = records[drawing.name] = predictions.back().record;
    const Json& distance = record.at("two_way_distance_px");
    log::Info("{}: {:.1f} pixels from the face's curves, {:.1f} before it was framed", drawing.name,
              distance.at("after").get<double>(), distance.at("before").get<double>());
  }

  Manifest manifest;
  manifest.kind = "predictions";
  manifest.verb = "predict";
  manifest.config = {{"framing", options.framing == Framing::kFit ? "fit" : "keep"},
                     {"refine", options.refine},
                     {"deform", options.deform}};
  manifest.seed = run.manifest.seed;
  manifest.sources = run.manifest.sources;
  manifest.counts = {{"drawings", predictions.size()}};
  manifest.details = {{"run_data_hash", DataHash(run_directory)}, {"drawings", records}};
  MakeDirectory(out_directory);
  for (const Prediction& one : predictions) {
    const std::string mesh = one.name + ".obj", lines = one.name + ".svg", sheet = one.name + ".png";
    geometry::WriteObj(out_directory / mesh, {one.face, run.face_template.triangles});
    render::WriteSvg(out_directory / lines, one.strokes, {"line"});
    render::WriteImage(out_directory / sheet, SheetOf(run.face_template, one));
    for (const auto& file : {mesh, lines, sheet}) manifest.checksums[file] = Sha256OfFile(out_directory / file);
  }
  WriteManifest(out_directory, manifest);
}

}  // namespace daumier::sketch

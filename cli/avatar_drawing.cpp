#include "cli/avatar_drawing.h"

#include "cli/system_table.h"
#include "cli/weights_model.h"
#include "core/error.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/process_task.h"
#include "core/stopwatch.h"
#include "render/framing.h"
#include "render/stroke_overlay.h"
#include "render/svg_color.h"
#include "render/svg_picture.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"
#include "systems/predict_inputs.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/drawing_colours.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/run_folder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kDrawnSide = 360;

fs::path SketchWeights() {
  const std::vector<fs::path> places = systems::WeightsPlaces();
  for (const systems::ShippedWeights& weights : systems::ListWeights(places))
    if (weights.system == sketch::kSystem) return weights.directory;
  throw UsageError(fmt::format(
      "there are no weights of the task '{}' among the shipped ones, which make faces of drawings", sketch::kSystem));
}

/// The only drawing of a file, or its first one.
systems::Input ReadOneDrawing(const fs::path& file) {
  std::vector<systems::Input> inputs = SystemNamed(sketch::kSystem).read_inputs(file);
  if (inputs.size() > 1)
    log::Warn("{} holds {} drawings, of which the first becomes a head (`daumier predict` reads all)", file.string(),
              inputs.size());
  return std::move(inputs.front());
}

/// A drawing as a picture; nothing of formats without colours.
std::optional<render::Image> ColouredPicture(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return char(std::tolower(uint8_t(c))); });
  if (extension == ".svg" || extension == ".svgz") return render::PaintSvg(file);
  const systems::System& pictures = SystemNamed("landmarks");
  return systems::IsInputFile(pictures, file) ? std::optional(render::ReadImage(file)) : std::nullopt;
}

/// All frontal curves of the face, on the canvas: a network may have learnt few of them.
std::vector<render::Stroke> FrontalCurves(const systems::FaceResult& face, const render::Camera& camera) {
  std::vector<std::string> names;
  for (const faces::FeatureCurve& curve : face.face_template->annotation.curves)
    if (curve.view == faces::View::kFrontal) names.push_back(curve.name);
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> vertices = face.vertices.cast<float>();
  return fitting::SeenStrokes(fitting::SeeCurves(*face.face_template, names, camera),
                              {vertices.data(), size_t(vertices.size())});
}

/// Curves of the canvas in pixels of the picture of a drawing.
std::vector<render::Stroke> CurvesInPicture(const std::vector<render::Stroke>& on_canvas,
                                            const systems::FaceResult& face, const render::Drawing& drawing,
                                            const render::Image& picture) {
  std::vector<render::Stroke> curves = render::MapToCanvas(on_canvas, render::Inverse(*face.frame));
  for (render::Stroke& curve : curves) {
    for (std::array<float, 2>& point : curve.points) {
      Eigen::Vector2d p(point[0], point[1]);
      p = drawing.picture_from_sheet ? (*drawing.picture_from_sheet * p.homogeneous()).eval().hnormalized().eval()
                                     : Eigen::Vector2d(p * (picture.width / drawing.width));
      point = {float(p.x()), float(p.y())};
    }
  }
  return curves;
}

std::string HexOf(const Eigen::Vector3f& colour) {
  const auto byte = [&](int c) { return std::lround(255 * std::clamp(colour[c], 0.0F, 1.0F)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
}

/// A colour by the option, else as it is drawn, else plain; the record says which.
void ChooseColour(const std::string& name, const std::string& given, const std::optional<Eigen::Vector3f>& drawn,
                  Eigen::Vector3f& colour, Json& record) {
  const char* from = "plain";
  if (!given.empty()) {
    const auto parsed = render::ParseSvgColor(given);
    if (!parsed)
      throw UsageError(fmt::format(
          "palette.{}={}: is no colour (expected #e0ac8c, rgb(224, 172, 140) or a name of CSS)", name, given));
    colour = parsed->rgb.cast<float>();
    from = "given";
  } else if (drawn) {
    colour = *drawn;
    from = "drawing";
  }
  record[name] = {{"colour", HexOf(colour)}, {"from", from}};
}

fitting::HeadPalette ChoosePalette(const PaletteOptions& options, const sketch::DrawnColours& drawn, Json& record) {
  fitting::HeadPalette palette;
  ChooseColour("skin", options.skin, drawn.skin, palette.skin, record);
  ChooseColour("lips", options.lips, drawn.lips, palette.lips, record);
  ChooseColour("brows", options.brows, drawn.brows, palette.brows, record);
  ChooseColour("iris", options.iris, drawn.iris, palette.iris, record);
  return palette;
}

double MillisecondsSince(Stopwatch& watch) {
  return 1e3 * std::exchange(watch, {}).seconds();
}

}  // namespace

DrawnHead MakeDrawnHead(const fs::path& file, const PaletteOptions& options, int texture_size,
                        const portrait::FaceEdit& edit, const Device& device) {
  Stopwatch watch;
  DrawnHead drawn;
  ChoosePalette(options, {}, drawn.facts["palette"]);  // Refuses what is no colour before the work begins.
  const systems::Input input = ReadOneDrawing(file);
  const systems::System& system = SystemNamed(sketch::kSystem);
  const fs::path weights = SketchWeights();
  const auto predictor =
      system.open(weights, device, system.resolve_prediction(Json::object(), "options of a prediction"));
  systems::FaceResult face;
  std::optional<rig::ExpressionTargets> expressions;
  std::optional<rig::HeadRig> head_rig;
  OnAllCores(2, [&](int64_t part) {
    if (part == 0) {
      face = std::move(predictor->Predict({&input, 1}, TaskOfProcess()).front());
    } else {
      const faces::FaceModel model = FaceModelOfWeights(weights);
      expressions.emplace(model);
      head_rig.emplace(model.face_template);
    }
  });
  for (const std::string& warning : face.warnings) log::Warn("{}: {}", file.string(), warning);
  drawn.milliseconds["face"] = MillisecondsSince(watch);

  drawn.face_template = face.face_template;
  drawn.neutral = edit ? edit(face.vertices) : face.vertices;
  const rig::MorphTargets targets = expressions->On(drawn.neutral);
  drawn.milliseconds["targets"] = MillisecondsSince(watch);
  drawn.head = head_rig->On(drawn.neutral, targets);
  drawn.milliseconds["head"] = MillisecondsSince(watch);

  const std::optional<render::Image> picture = ColouredPicture(file);
  sketch::DrawnColours colours;
  const auto* const drawing = std::get_if<render::Drawing>(&input);
  if (picture && drawing != nullptr && face.frame) {
    const auto& camera = dynamic_cast<const sketch::SketchPredictor&>(*predictor).curves().camera;
    colours =
        sketch::FindDrawnColours(*picture, CurvesInPicture(FrontalCurves(face, camera), face, *drawing, *picture));
  }
  const fitting::HeadPalette palette = ChoosePalette(options, colours, drawn.facts["palette"]);
  drawn.texture = std::make_shared<const render::Image>(
      fitting::PaletteTexture(*head_rig, *face.face_template, palette, texture_size));
  drawn.milliseconds["texture"] = MillisecondsSince(watch);
  drawn.stages.push_back({render::DrawnWithCurves(face.drawn, face.curves, kDrawnSide), "drawing"});
  return drawn;
}

}  // namespace daumier::cli

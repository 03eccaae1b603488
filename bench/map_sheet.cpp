// Named expressions of a face model above the weights that a map makes of them, on the shipped head:
//   map_sheet MAP.json SOURCE PATH OUT.jpg [PIXELS]
// MAP.json is of `daumier rig --map` for that model; SOURCE is makehuman or ict, PATH as source.path. Above the model, below
// the mean head of weights/face-ict with weights of least squares, and with kept strength. Prints the weights of at least 0.05.
#include "core/error.h"
#include "core/json.h"
#include "faces/face_model_file.h"
#include "faces/source.h"
#include "render/camera.h"
#include "render/sheet.h"
#include "reports/rigged_head.h"
#include "rig/arkit_names.h"
#include "rig/expression_map_file.h"
#include "rig/expression_targets.h"
#include "rig/head_rig.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace daumier {
namespace {

constexpr int kMostExpressions = 11;

/// A face model's mean head, close to its face.
class Pictures {
 public:
  Pictures(const faces::FaceTemplate& face, const rig::MorphTargets& targets, int size)
      : names_(targets.names), pictures_(rig::HeadRig(face).On(face.neutral, targets)) {
    const auto& landmarks = face.annotation.landmarks;
    const double height = face.neutral(landmarks[27], 1) - face.neutral(landmarks[8], 1);
    camera_ = render::TurnedCamera(
        {face.neutral(landmarks[29], 0), face.neutral(landmarks[29], 1), face.neutral(landmarks[29], 2) - 0.6 * height},
        0.95 * height, size, 15);
  }

  render::Image Draw(const Eigen::RowVectorXf& weights) const {
    rig::WeightsClip clip;
    clip.names = names_;
    clip.weights = weights;
    return pictures_.Draw(rig::PosesOf(clip, names_).front(), camera_);
  }

 private:
  std::vector<std::string> names_;
  reports::RiggedHeadPictures pictures_;
  render::Camera camera_;
};

int Run(const std::vector<std::string>& words) {
  if (words.size() < 4) throw UsageError("map_sheet MAP.json SOURCE PATH OUT.jpg [PIXELS]");
  const rig::ExpressionMap map = rig::ParseExpressionMap(ReadJson(words[0]), words[0]);
  const faces::FaceModel model = faces::LoadFaceModel({.name = words[1], .path = words[2]});
  const faces::FaceModel own = faces::ReadFaceModelWeights("weights/face-ict");
  const int size = words.size() > 4 ? std::stoi(words[4]) : 210;
  const Pictures above(model.face_template, {model.expression_shape_names, model.expression_shapes}, size),
      below(own.face_template, rig::ExpressionTargets(own).On(own.face_template.neutral), size);
  const rig::ExpressionMap kept = rig::WithKeptStrength(map);
  std::vector<render::SheetCell> first, second, third;
  for (const faces::Expression& expression : model.expressions) {
    if (int(first.size()) == kMostExpressions) break;
    const Eigen::RowVectorXf weights = rig::WeightsOf(map, expression.weights.transpose());
    first.push_back({above.Draw(expression.weights.transpose()), expression.name});
    second.push_back({below.Draw(weights), ""});
    third.push_back({below.Draw(rig::WeightsOf(kept, expression.weights.transpose())), ""});
    fmt::print("{}:", expression.name);
    for (int t = 0; t < rig::kNumArkitNames; ++t)
      if (weights[t] >= 0.05f) fmt::print(" {} {:.2f}", rig::ArkitNames()[size_t(t)], weights[t]);
    fmt::print("\n");
  }
  const int columns = int(first.size());
  for (const auto* row : {&second, &third}) first.insert(first.end(), row->begin(), row->end());
  render::WriteImage(words[3],
                     render::MakeSheet(first, columns, {.row_titles = {words[1], "weights", "kept strength"}}), 82);
  return 0;
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  try {
    return daumier::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

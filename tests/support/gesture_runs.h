#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "runtime/network_runner.h"
#include "systems/sketch/gesture_options.h"
#include "systems/sketch/gesture_recogniser.h"

#include <filesystem>

namespace daumier::testing {

/// A network of gestures that sees how much of a picture is ink: a stroke without ink right of the middle is a left
/// arrow, one without ink left of it a right arrow, others are none.
class HalvesNetwork : public runtime::NetworkRunner {
 public:
  NamedArrays Run(const NamedArrays& inputs) const override {
    const FloatArray& pictures = inputs.at("pictures");
    const int64_t side = pictures.shape[2];
    double left = 0, right = 0;
    for (int64_t i = 0; i < side * side; ++i) (i % side < side / 2 ? left : right) += pictures.values[size_t(i)];
    FloatArray scores({1, sketch::kNumGestureClasses});
    const double lean = (right - left) / (left + right);
    scores.values[size_t(datasets::Gesture::kRightArrow)] = float(20 * lean);
    scores.values[size_t(datasets::Gesture::kLeftArrow)] = float(-20 * lean);
    scores.values[size_t(datasets::Gesture::kNone)] = 3;
    return {{"scores", scores}};
  }
};

/// A finished run of gestures but for its weights, which are no network.
inline void WriteGestureRunFolder(const std::filesystem::path& directory, const Json& rejection) {
  sketch::GestureTrainingOptions options;
  options.data.gestures = "/gestures";
  MakeDirectory(directory / "best");
  WriteFileAtomically(ResolvedConfig(directory), ToToml(ToJson(options)));
  WriteFileAtomically(BestWeights(directory), "no network");
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.config = ToJson(options);
  manifest.config.erase("data");
  manifest.counts = {{"best_epoch", 1}};
  manifest.details = {{"system", sketch::kGestureSystem}, {"rejection", rejection}};
  manifest.checksums[kBestFile] = Sha256OfFile(BestWeights(directory));
  WriteManifest(directory, manifest);
}

}  // namespace daumier::testing

#include "datasets/build/gestures.h"

#include "core/files.h"
#include "datasets/build/sharded_build.h"
#include "datasets/gallery/gesture_sheet.h"
#include "datasets/read/gesture_database.h"
#include "render/png_writer.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

constexpr int kHandsInAShard = 50, kHandsOfExamples = 4;

std::vector<LabelledStroke> StrokesOfHands(const GesturesOptions& options, int begin, int end) {
  std::vector<LabelledStroke> strokes;
  for (int hand = begin; hand < end; ++hand)
    for (LabelledStroke& stroke : StrokesOfHand(options.hand, {options.per_gesture, options.none}, options.seed, hand))
      strokes.push_back(std::move(stroke));
  return strokes;
}

template <class Kind>
std::vector<std::string> NamesOf(int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(NameOf(Kind(i)));
  return names;
}

}  // namespace

void BuildGestures(const GesturesOptions& options, const std::filesystem::path& directory, const Task& task) {
  if (options.per_gesture == 0 && options.none == 0)
    throw UsageError("dataset gestures: per_gesture=0 and none=0 leave no stroke (give at least one of them)");
  ShardedBuild build;
  build.num_shards = (options.num_hands + kHandsInAShard - 1) / kHandsInAShard;
  build.manifest.kind = "gestures";
  build.manifest.verb = "dataset gestures";
  build.manifest.config = ToJson(options);
  build.manifest.seed = options.seed;
  build.manifest.sources = {{{"name", "Daumier's generator of gestures"},
                             {"version", "1"},
                             {"checksum", ""},
                             {"licence", "of Daumier itself: no data of others are used"}}};
  build.manifest.counts = {{"hands", options.num_hands},
                           {"shards", build.num_shards},
                           {"strokes", options.num_hands * (kNumGestures * options.per_gesture + options.none)}};
  build.manifest.details = {{"gestures", NamesOf<Gesture>(kNumGestures + 1)},
                            {"other_strokes", NamesOf<OtherStrokeKind>(kNumOtherStrokeKinds)}};
  build.num_units = options.num_hands;
  build.unit = "hands";
  build.units_per_shard = kHandsInAShard;
  build.shard_name = GestureShardName;
  build.write_shard = [&](int shard, const std::filesystem::path& file) {
    const int begin = shard * kHandsInAShard, end = std::min(begin + kHandsInAShard, options.num_hands);
    return WriteGestureShard(file, StrokesOfHands(options, begin, end));
  };
  build.write_rest = [&](const std::filesystem::path& folder) {
    const render::Image sheet = GestureSheet(StrokesOfHands(options, 0, std::min(kHandsOfExamples, options.num_hands)));
    const std::string bytes = render::EncodePng(sheet);
    WriteFileAtomically(folder / "examples.png", bytes);
    return std::map<std::string, std::string>{{"examples.png", Sha256(bytes)}};
  };
  BuildShards(directory, build, task);
}

}  // namespace daumier::datasets

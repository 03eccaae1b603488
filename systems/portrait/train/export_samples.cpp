#include "systems/portrait/train/export_samples.h"

#include "core/error.h"
#include "core/log.h"
#include "datasets/read/portrait_database.h"
#include "datasets/read/run_data.h"
#include "render/draw.h"
#include "systems/portrait/landmark_crop.h"
#include "systems/portrait/portrait_crop.h"
#include "systems/portrait/train/portrait_samples.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace daumier::portrait {
namespace {

using Portraits = std::shared_ptr<const datasets::PortraitDatabase>;
/// The numbers that a network reads of a portrait.
using CropNumbers = std::function<std::vector<float>(const datasets::PortraitDatabase& portraits, int image)>;

/// Null where they are not there.
Portraits FindPortraits(const std::filesystem::path& run, const Manifest& manifest, const Json& config) {
  try {
    return std::make_shared<const datasets::PortraitDatabase>(datasets::FindRunData(run, manifest, config, "portraits"),
                                                              Checksums::kSkip);
  } catch (const Error& error) {
    log::Info("Outputs are compared on random inputs, for the portraits of the run are not there: {}", error.what());
    return nullptr;
  }
}

void SampleCrops(const Portraits& portraits, const CropNumbers& numbers_of, exporting::ExportedFunction& function) {
  if (portraits == nullptr || portraits->size() == 0) return;
  exporting::ExportedInput& input = function.inputs.at(0);
  input.sample_text = "crops of portraits";
  input.sample = [portraits, numbers_of, shape = input.shape](int64_t batch, Rng& rng) {
    std::vector<int64_t> sizes = {batch};
    sizes.insert(sizes.end(), shape.begin(), shape.end());
    torch::Tensor crops = torch::empty(sizes);
    for (int64_t b = 0; b < batch; ++b) {
      const std::vector<float> numbers = numbers_of(*portraits, int(rng.Below(uint64_t(portraits->size()))));
      DAUMIER_CHECK(int64_t(numbers.size()) == crops[b].numel(), "a crop has {} numbers, expected {}", numbers.size(),
                    crops[b].numel());
      std::ranges::copy(numbers, crops[b].data_ptr<float>());
    }
    return crops;
  };
}

}  // namespace

void SampleLandmarkCrops(const LandmarkRunFolder& run, exporting::ExportedFunction& function) {
  const int resolution = run.network_options.resolution;
  SampleCrops(
      FindPortraits(run.directory, run.manifest, run.config),
      [resolution](const datasets::PortraitDatabase& portraits, int image) {
        return SampleCrop(PicturePyramid(portraits.picture(image)),
                          FrameOfBox(BoxOf(portraits.landmarks(image)), resolution));
      },
      function);
}

void SamplePortraitCrops(const PortraitRunFolder& run, exporting::ExportedFunction& function) {
  const int resolution = run.options.network.resolution;
  SampleCrops(
      FindPortraits(run.directory, run.manifest, run.config),
      [resolution, pictures = run.options.pictures](const datasets::PortraitDatabase& portraits, int image) {
        const PictureMap map = PlainCrop(portraits, image, pictures);
        return NetworkPicture(render::ToRgb(WarpPicture(portraits.picture(image), map)), resolution);
      },
      function);
}

}  // namespace daumier::portrait

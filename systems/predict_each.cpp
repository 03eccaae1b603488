#include "systems/predict_each.h"

#include "core/error.h"

namespace daumier::systems {

std::vector<FaceResult> PredictEach(std::span<const Input> inputs, const Task& task, std::string_view unit,
                                    const std::function<FaceResult(const Input&)>& predict_one) {
  std::vector<FaceResult> results;
  for (size_t i = 0; i < inputs.size(); ++i) {
    task.ThrowIfCancelled("stopped after {} of {} {}", i, inputs.size(), unit);
    try {
      results.push_back(predict_one(inputs[i]));
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      if (inputs.size() == 1) throw;
      throw Error(fmt::format("input {} of {}: {}", i + 1, inputs.size(), error.what()));
    }
    task.Report(int64_t(i + 1), int64_t(inputs.size()), unit);
  }
  return results;
}

const render::Image& PictureOf(const Input& input) {
  const auto* const picture = std::get_if<render::Image>(&input);
  DAUMIER_CHECK(picture != nullptr, "this is no picture (expected PNG, JPEG, WebP, BMP or TIFF)");
  return *picture;
}

}  // namespace daumier::systems

#pragma once
#include "core/task.h"
#include "systems/predictor.h"

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace daumier::systems {

/// Predictor::Predict by a function of one input. `unit` is what is counted, the plural: "drawings". The error of one of
/// several inputs begins with its position in the list ("input 2 of 5: ...").
/// @throws Cancelled if the task is, before the next input or from `predict_one`; Error of `predict_one`.
std::vector<FaceResult> PredictEach(std::span<const Input> inputs, const Task& task, std::string_view unit,
                                    const std::function<FaceResult(const Input&)>& predict_one);

/// The picture of an input. @throws Error if it is none.
const render::Image& PictureOf(const Input& input);

}  // namespace daumier::systems

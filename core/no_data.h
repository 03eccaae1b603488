#pragma once

namespace daumier {

/// In place of a folder under `data` of a training's config: the training does without these data (core/training.h).
inline constexpr const char* kNoData = "none";

}  // namespace daumier

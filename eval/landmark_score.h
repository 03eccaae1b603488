#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Errors of 68 landmarks of a picture against true ones, pixels.
namespace daumier::eval {

/// 68 x 2: x0 y0 x1 y1 ..., iBUG order, pixels.
using LandmarkRow = std::array<double, 136>;

/// Normalised mean error: mean of |p_i - g_i| / |g_36 - g_45|, the true distance of the outer corners of the eyes.
/// `counts` (68 or none): landmarks that count. @throws Error if the corners coincide or no landmark counts.
double NormalisedMeanError(const LandmarkRow& predicted, const LandmarkRow& truth,
                           std::span<const uint8_t> counts = {});

/// Predicted and true landmarks of a picture of size x size pixels.
struct LandmarkPair {
  LandmarkRow predicted, truth;
  double size = 0;
};

/// What is wrong with the numbers of all predictions, with the repair: shares of the picture instead of pixels, y upwards, x and
/// y exchanged, pixels of another size of picture. Absent if none of these lowers the median error to less than a third of what
/// it is, or that is below 0.2. A method of large errors of its own has none of these.
std::optional<std::string> UnitMistake(std::span<const LandmarkPair> pairs);

}  // namespace daumier::eval

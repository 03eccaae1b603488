#pragma once
#include "render/image.h"
#include "render/shading.h"

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace daumier::render {

/// kViridis is perceptually uniform, light for large values; kTurbo has more hues and is not.
enum class ColourMap { kViridis, kTurbo };

struct ValueRange {
  double low = 0.0, high = 1.0;
};

/// The colour of a value: the map's first at range.low and below, its last at range.high and above, neutral grey for
/// NaN.
/// @throws Error unless low < high.
Rgb ColourOf(double value, const ValueRange& range, ColourMap map = ColourMap::kViridis);

/// One colour a value, V.
std::vector<Rgb> ColoursOf(const Eigen::VectorXd& values, const ValueRange& range, ColourMap map = ColourMap::kViridis);

/// The surface coloured by a value a vertex (V), lit only a little, so that colours can be compared with the bar's.
/// Closing triangles are grey. @throws Error as ColourOf and RenderMesh.
Image RenderHeatMap(const RenderInput& input, const Eigen::VectorXd& values, const ValueRange& range,
                    const Camera& camera, ColourMap map = ColourMap::kViridis);

/// Width of the strip at the right edge that DrawColourBar fills.
inline constexpr int kColourBarWidth = 74;

/// Draws into the last kColourBarWidth columns a bar with low at the bottom and high on top, ticks at round values with
/// labels, and the unit above. The strip is made white first.
/// @throws Error unless low < high, or if the image is not RGB, narrower than the strip or less than 60 rows high.
void DrawColourBar(Image& image, const ValueRange& range, std::string_view unit, ColourMap map = ColourMap::kViridis);

}  // namespace daumier::render

#include "render/styles/toon_picture.h"

#include "core/error.h"
#include "core/parallel.h"
#include "render/styles/colour_planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

constexpr int kToonRounds = 3;

/// Distances of neighbours in the transformed domain, 1 + reach / contrast sum_c |difference|: of each pixel from the one
/// before it in its row, and from the one above it.
struct DomainSteps {
  Plane along_rows, along_columns;
};

DomainSteps StepsOf(const ColourPlanes& colours, float reach, float contrast) {
  const int height = colours[0].height, width = colours[0].width;
  DomainSteps steps{Plane(height, width, 1), Plane(height, width, 1)};
  OnAllCores(height, [&](int64_t row) {
    float* along = steps.along_rows.row(int(row));
    float* down = steps.along_columns.row(int(row));
    for (const Plane& plane : colours) {
      const float* values = plane.row(int(row));
      const float* above = plane.row(std::max(int(row) - 1, 0));
      for (int i = 1; i < width; ++i) along[i] += reach / contrast * std::abs(values[i] - values[i - 1]);
      for (int i = 0; i < width; ++i) down[i] += reach / contrast * std::abs(values[i] - above[i]);
    }
  });
  return steps;
}

/// base^step of each pixel.
Plane Feedback(const Plane& steps, float base) {
  Plane powers(steps.height, steps.width);
  const float exponent = std::log(base);
  OnAllCores(steps.height, [&](int64_t row) {
    const float* from = steps.row(int(row));
    float* to = powers.row(int(row));
    for (int i = 0; i < steps.width; ++i) to[i] = std::exp(exponent * from[i]);
  });
  return powers;
}

/// J_i += a_i (J_{i-1} - J_i) along each row, forth and back; a_i belongs to the step from i - 1 to i.
void SmoothRows(const Plane& feedback, Plane& plane) {
  OnAllCores(plane.height, [&](int64_t row) {
    float* values = plane.row(int(row));
    const float* a = feedback.row(int(row));
    for (int i = 1; i < plane.width; ++i) values[i] += a[i] * (values[i - 1] - values[i]);
    for (int i = plane.width - 2; i >= 0; --i) values[i] += a[i + 1] * (values[i + 1] - values[i]);
  });
}

/// The same along columns, a row at a time.
void SmoothColumns(const Plane& feedback, Plane& plane) {
  const auto pull = [&](int row, int neighbour, int step) {
    float* values = plane.row(row);
    const float* from = plane.row(neighbour);
    const float* a = feedback.row(step);
    for (int i = 0; i < plane.width; ++i) values[i] += a[i] * (from[i] - values[i]);
  };
  for (int row = 1; row < plane.height; ++row) pull(row, row - 1, row);
  for (int row = plane.height - 2; row >= 0; --row) pull(row, row + 1, row + 1);
}

void SmoothWithinBorders(float reach, float contrast, ColourPlanes& colours) {
  const DomainSteps steps = StepsOf(colours, reach, contrast);
  for (int round = 0; round < kToonRounds; ++round) {
    const double deviation = reach * std::numbers::sqrt3 * std::pow(2.0, kToonRounds - 1 - round) /
                             std::sqrt(std::pow(4.0, kToonRounds) - 1);
    const float base = float(std::exp(-std::numbers::sqrt2 / deviation));
    const Plane rows = Feedback(steps.along_rows, base), columns = Feedback(steps.along_columns, base);
    for (Plane& plane : colours) SmoothRows(rows, plane);
    OnAllCores(std::ssize(colours), [&](int64_t c) { SmoothColumns(columns, colours[size_t(c)]); });
  }
}

float Banded(float value, float height) {
  const float border = height * std::round(value / height);
  static const float kWhole = std::tanh(2.0F);
  return border + height / 2 * std::tanh(4 * (value - border) / height) / kWhole;
}

}  // namespace

Image ToonPicture(const Image& picture, const ToonPictureOptions& options) {
  DAUMIER_CHECK(picture.height > 0 && picture.width > 0, "there is no picture to be made a cartoon: it is empty");
  ColourPlanes colours = ToPlanes(picture);
  const double reach = options.reach * std::max(picture.height, picture.width);
  if (reach > 0) SmoothWithinBorders(float(reach), float(options.contrast), colours);
  const Plane luma = Luma(colours);
  OnAllCores(picture.height, [&](int64_t row) {
    const float* y = luma.row(int(row));
    for (int i = 0; i < picture.width; ++i) {
      const float level = options.bands > 0 ? Banded(y[i], 1 / float(options.bands)) : y[i];
      for (Plane& plane : colours) {
        float& value = plane.row(int(row))[i];
        value = level + float(options.saturation) * (value - y[i]);
      }
    }
  });
  return ToImage(colours);
}

}  // namespace daumier::render

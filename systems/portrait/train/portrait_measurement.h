#pragma once
#include "datasets/read/portrait_database.h"
#include "reports/metric_table.h"
#include "systems/portrait/portrait_measures.h"
#include "systems/portrait/portrait_picture.h"
#include "systems/portrait/train/portrait_samples.h"

#include <functional>
#include <string>
#include <vector>

namespace daumier::portrait {

/// A portrait that a predictor is measured on.
struct MeasuredPortrait {
  int image = 0, person = 0;
  PictureMap map;
  render::Image crop;
  std::vector<float> shown;      ///< 224 x 224: FaceMask of the crop.
  std::vector<float> landmarks;  ///< 68 x 2, pixels of the crop.
  geometry::Points vertices;
  std::array<float, 3> angles{}, states{};
};

/// Coefficients (239) of the portraits' crops, one after the other, and how long one took.
struct PortraitGuesses {
  std::vector<std::vector<float>> coefficients;  ///< Of the first portraits.
  std::optional<double> ms = {};
};

/// The rows of a table of errors on some portraits.
class CropMeasurement {
 public:
  /// Databases and model have to outlive it. maps: the crop of each image.
  CropMeasurement(const faces::MorphableModel& model, const datasets::PortraitDatabase& portraits,
                  const std::vector<int>& images, const std::vector<PictureMap>& maps, uint64_t seed);

  /// Adds a row. @throws Error if there are no guesses or more than portraits.
  void AddRow(const std::string& name, const PortraitGuesses& guesses, bool baseline = false);

  const std::vector<MeasuredPortrait>& portraits() const { return portraits_; }
  const reports::MetricTable& table() const { return table_; }
  const FacePainter& painter() const { return painter_; }

 private:
  const FacePainter painter_;
  const ShapeMeasure measure_;
  const uint64_t seed_;
  std::vector<MeasuredPortrait> portraits_;
  reports::MetricTable table_;
};

}  // namespace daumier::portrait

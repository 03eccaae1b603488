#pragma once
#include "core/sample_batch.h"
#include "datasets/gestures/gesture_raster.h"
#include "datasets/read/gesture_database.h"

#include <span>
#include <vector>

namespace daumier::datasets {

/// Some strokes of a database as pictures with their gestures, drawn by all cores.
class GestureDataset {
 public:
  /// Sample s is stroke `strokes[s]`. @throws Error if a stroke is not there.
  GestureDataset(const GestureDatabase& database, std::vector<int> strokes, const GestureRaster& raster);

  int size() const { return int(strokes_.size()); }

  /// Of B samples:
  ///   pictures  B x 1 x side x side, RasteriseGesture
  ///   gestures  B indices: Gesture
  /// May be called from several threads. @throws Error if a sample is not one of 0..size()-1.
  SampleBatch Get(std::span<const int> samples) const;

 private:
  GestureDatabase database_;  ///< Shares the mapped files.
  std::vector<int> strokes_;
  GestureRaster raster_;
};

}  // namespace daumier::datasets

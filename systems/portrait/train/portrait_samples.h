#pragma once
#include "core/sample_batch.h"
#include "datasets/read/portrait_database.h"
#include "systems/portrait/portrait_crop.h"
#include "systems/portrait/portrait_options.h"
#include "systems/portrait/portrait_picture.h"

#include <cstdint>
#include <span>
#include <vector>

namespace daumier::portrait {

enum class Jitter { kNone, kRandom };

/// Which arrays a batch has besides those that it always has.
struct PortraitArrays {
  bool picture = false, vertices = false;
};

/// Some portraits of a database, and pictures without known faces after them, cropped as PortraitPictureOptions say.
/// Of B portraits a batch has
///   input (B, 3, R, R)                colours 0 .. 1: what the network reads; with random jitter also brightness and contrast
///   landmarks (B, 68, 2)              pixels of the crop
///   landmark_weights (B, 68)          losses::PortraitLandmarkWeights, of hidden landmarks times loss.hidden
///   known (B)                         1 for a portrait whose face is known, else 0
///   expression (B, 64), albedo (B, 80), light (B, 9), angles (B, 3)   0 where they are not known; angles as seen in the crop
///   picture (B, 3, 224, 224), skin (B, 1, 224, 224)   the crop, and A_m: 1 where the mask has skin, brows, lips or ears
///   vertices (B, V, 3)                cm
class CropSamples {
 public:
  /// Databases have to outlive it. real: null, or a database all of whose pictures are samples.
  /// @throws Error if vertices are needed and not stored.
  CropSamples(const datasets::PortraitDatabase& portraits, std::vector<int> images,
              const datasets::PortraitDatabase* real, const PortraitTrainingOptions& options, Jitter jitter,
              PortraitArrays arrays);

  int size() const;
  /// Samples 0 .. size() - 1. A function of its arguments and the options' seed. Thread-safe.
  SampleBatch Get(std::span<const int> samples, int64_t epoch) const;

 private:
  struct Row {
    const datasets::PortraitDatabase* database;
    int image;
    bool known;
  };
  Row RowOf(int sample) const;
  void Fill(SampleBatch& batch, int64_t b, int sample, int64_t epoch) const;

  const datasets::PortraitDatabase& portraits_;
  const std::vector<int> images_;
  const datasets::PortraitDatabase* const real_;
  const PortraitTrainingOptions options_;
  const Jitter jitter_;
  const PortraitArrays arrays_;
  const std::vector<float> landmark_weights_;
};

/// The crop of an image without jitter: CropOfLandmarks, or of the whole picture.
PictureMap PlainCrop(const datasets::PortraitDatabase& database, int image, const PortraitPictureOptions& options);

/// Of `leave_out`: heads of clay without hair, in addition to the styles of a database.
inline constexpr const char* kBaldStyle = "bald";

/// Images of the persons whose neutral faces these are (of a split), but those of styles that are left out.
/// @throws UsageError naming a style that the database does not have, and those that it has.
std::vector<int> ImagesOfPersons(const datasets::PortraitDatabase& portraits, const std::vector<int>& persons,
                                 const std::vector<std::string>& leave_out = {});

}  // namespace daumier::portrait

#pragma once
#include "core/picture_parts.h"
#include "render/image.h"

#include <array>
#include <cstdint>
#include <vector>

namespace daumier::portrait {

inline constexpr int kNumLandmarks = 68;

/// A picture of a face with what is true of it.
struct LandmarkSample {
  render::Image picture;              ///< RGB
  render::Image mask;                 ///< Grey, of the picture's size: PictureClass.
  std::vector<float> landmarks;       ///< 68 x 2, pixels (x0 y0 x1 y1 ...).
  std::vector<uint8_t> visibility;    ///< 68: 1 seen, 0 hidden or outside.
  std::array<float, 3> gaps_mm = {};  ///< Right eye, left eye, mouth.
  int skin_tone = 0;                  ///< 0, the lightest, to 5.
};

/// Where samples come from. Functions may be called from several threads.
class LandmarkSource {
 public:
  virtual ~LandmarkSource() = default;
  virtual int size() const = 0;
  /// @throws Error if there is no such sample.
  virtual LandmarkSample Get(int i) const = 0;
  /// The person of a sample: those of a person are on one side of a split.
  virtual int person(int i) const = 0;
};

/// States of a face that the network returns, in its order, of two classes each.
enum class FaceState { kIsFace, kRightEyeClosed, kLeftEyeClosed, kMouthOpen };
inline constexpr int kNumFaceStates = 4;

/// Gaps at which an eye counts as closed or open, and a mouth; between them the state is unknown.
inline constexpr float kClosedEyeMm = 1.0f, kOpenEyeMm = 2.5f, kClosedMouthMm = 2.0f, kOpenMouthMm = 4.0f;

}  // namespace daumier::portrait

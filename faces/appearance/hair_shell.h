#pragma once
#include "faces/appearance/hats.h"
#include "faces/appearance/looks.h"
#include "faces/appearance/scalp.h"

#include <array>

namespace daumier::faces {

/// Waves of hair: a sum of sines along the azimuth, whole numbers of periods, mean 0, about 1 high.
class HairWaves {
 public:
  explicit HairWaves(uint64_t seed);
  /// `share`: from the crown (0) to the ends of the hair (1), along which waves drift; they fade to the crown.
  double At(double azimuth, double share) const;
  double Fine(double azimuth, double share) const;

 private:
  static constexpr int kWaves = 6;
  std::array<double, kWaves> number_, phase_, drift_;
};

/// The shape of hair as numbers of a direction.
struct HairShape {
  HairStyle style;
  ScalpLines lines;
  const Looks* looks;
  HairWaves waves;
  double size;
  bool tucked;  ///< Long hair behind the ears.

  HairShape(const ScalpLines& scalp_lines, const Looks& of, double head_size);

  /// Elevation at which hair on the skull ends.
  double EndAt(double azimuth) const;
  /// How far it hangs down from the height of the eyes, cm; 0 where it ends on the skull.
  double HangAt(double azimuth) const;
  /// Height over the skull at a direction before it falls to its ends, cm.
  double HeightAt(double azimuth, double elevation) const;
  bool HangsAtAll() const;
};

}  // namespace daumier::faces

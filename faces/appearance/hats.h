#pragma once
#include "faces/appearance/head_soup.h"
#include "faces/appearance/looks.h"
#include "faces/appearance/scalp.h"

namespace daumier::faces {

/// How a hat sits: its lower border and its distance from the skull.
class HatFit {
 public:
  HatFit(HatStyle style, const ScalpLines& lines, double size);

  bool is_there() const { return style_ != HatStyle::kNone; }
  /// Elevation of the lower border at an azimuth, degrees.
  double BorderAt(double azimuth) const;
  /// Distance of its outside from the skull, cm.
  double Offset(double azimuth, double elevation) const;
  /// What is left of hair `height` cm high at a direction: it stays under the hat.
  double Pressed(double height, double azimuth, double elevation) const;

 private:
  HatStyle style_;
  double front_, back_, size_;
};

/// A closed shell over the skull, with a peak (cap), a rolled border (beanie) or a brim all round.
void AddHat(const SkullGrid& skull, const HatFit& fit, double size, const Looks& looks, HeadSoup& soup);

}  // namespace daumier::faces

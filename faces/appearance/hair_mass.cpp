#include "faces/appearance/hair_mass.h"

#include "core/error.h"
#include "faces/appearance/hair.h"
#include "faces/appearance/hats.h"
#include "faces/appearance/head_soup.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace daumier::faces {

HairMaker::HairMaker(const FaceTemplate& face_template) : scalp_(face_template) {}

HairMass HairMaker::Make(const geometry::Points& face, const Looks& looks) const {
  HairMass hair;
  if (looks.hair == HairStyle::kBald) return hair;
  const SkullGrid skull = scalp_.GridOf(face);
  const double size = skull.radius() / kUsualSkullRadius;
  HeadSoup soup(geometry::Points(0, 3), Eigen::MatrixXf(0, 3));
  AddHair(skull, scalp_.lines(), HatFit(HatStyle::kNone, scalp_.lines(), size), size, looks, soup);
  PortraitHead shells = soup.Take();
  hair.mesh.vertices = std::move(shells.vertices);
  hair.mesh.triangles = std::move(shells.triangles);
  hair.colours = std::move(shells.colours);
  return hair;
}

HairStyle HairStyleNamed(const std::string& name) {
  const auto found = std::ranges::find(kHairStyleNames, name);
  DAUMIER_CHECK(found != kHairStyleNames.end(), "there is no hair '{}' (expected {})", name,
                fmt::join(kHairStyleNames, ", "));
  return HairStyle(found - kHairStyleNames.begin());
}

}  // namespace daumier::faces

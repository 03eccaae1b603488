#include "faces/annotation.h"

#include "core/error.h"

namespace daumier::faces {

const std::vector<std::string>& CurveKinds() {
  static const std::vector<std::string> kinds = {"silhouette",  "brow", "upper_eye", "lower_eye", "upper_mouth",
                                                 "lower_mouth", "lips", "ear",       "nose",      "side_silhouette"};
  return kinds;
}

const std::vector<int>& RegionFor(const Annotation& annotation, const std::string& name, std::string_view purpose) {
  const auto found = annotation.regions.find(name);
  DAUMIER_CHECK(found != annotation.regions.end(),
                "{} needs the region '{}', which this face does not have: add it to 'regions' of its annotation "
                "(docs/annotation.md) and build the faces again",
                purpose, name);
  return found->second;
}

}  // namespace daumier::faces

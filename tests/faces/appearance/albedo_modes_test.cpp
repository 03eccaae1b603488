#include "faces/appearance/albedo_modes.h"

#include "faces/appearance/skin_fields.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::faces {
namespace {

TEST(AlbedoModes, HaveFieldsAndSmallSteps) {
  const FaceTemplate face = testing::SyntheticFace();
  std::set<std::string> names;
  for (const auto* list : {&NamedAlbedoModes(), &MeanAlbedoParts()}) {
    for (const AlbedoModeSpec& mode : *list) {
      EXPECT_EQ(SkinField(face, mode.field).size(), face.num_vertices()) << mode.name;
      EXPECT_LT(mode.step.cwiseAbs().maxCoeff(), 0.25f) << mode.name;
      EXPECT_TRUE(names.insert(mode.name).second) << mode.name;
    }
  }
  EXPECT_EQ(NamedAlbedoModes()[0].name, "melanin");
  EXPECT_LT(kMelaninStep.maxCoeff(), 0) << "positive is darker";
}

}  // namespace
}  // namespace daumier::faces

#include "faces/drawing_terms.h"

#include "core/json.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

namespace daumier::faces {
namespace {

TEST(DrawingTerms, MirroringPointsIsAnInvolutionThatSwapsSides) {
  for (int i = 0; i < kNumFacePoints; ++i) {
    const FacePoint mirrored = MirroredPoint(FacePoint(i));
    EXPECT_EQ(MirroredPoint(mirrored), FacePoint(i));
    std::string name(kFacePointNames[size_t(i)]);
    if (const auto at = name.find("right"); at != std::string::npos)
      name.replace(at, 5, "left");
    else if (const auto left = name.find("left"); left != std::string::npos)
      name.replace(left, 4, "right");
    EXPECT_EQ(kFacePointNames[size_t(mirrored)], name);
  }
}

TEST(DrawingTerms, LabelsHaveNamesAndColoursOfTheirOwn) {
  std::set<std::string_view> names(kLineLabelNames.begin(), kLineLabelNames.end());
  EXPECT_EQ(names.size(), size_t(kNumLineLabels));
  std::set<std::array<uint8_t, 3>> colours;
  for (int i = 0; i < kNumLineLabels; ++i) colours.insert(ColourOf(LineLabel(i)));
  EXPECT_EQ(colours.size(), size_t(kNumLineLabels));
}

TEST(DrawingTerms, PointsStatesAndViewsAreThoseOfLabelledDrawings) {
  const auto data = testing::SharedData();
  const auto file = data ? *data / "sketches/landmarks.json" : std::filesystem::path();
  if (!data || !std::filesystem::exists(file)) GTEST_SKIP() << "needs sketches/landmarks.json of the shared data";
  std::ifstream stream(file);
  const Json labels = Json::parse(stream);
  std::set<std::string> points;
  for (const auto& [name, value] : labels.at("points_of").items()) points.insert(name);
  EXPECT_EQ(points, (std::set<std::string>(kFacePointNames.begin(), kFacePointNames.end())));
  const auto holds = [](const auto& names, const Json& word) {
    return word.is_null() || std::find(names.begin(), names.end(), word.get<std::string>()) != names.end();
  };
  for (const auto& [name, drawing] : labels.at("drawings").items()) {
    EXPECT_TRUE(holds(kMouthStateNames, drawing.at("mouth"))) << name;
    EXPECT_TRUE(holds(kEyeStateNames, drawing.at("eyes"))) << name;
    EXPECT_TRUE(holds(kDrawnViewNames, drawing.at("view"))) << name;
  }
}

}  // namespace
}  // namespace daumier::faces

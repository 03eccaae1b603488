#include "export/weights_card.h"

#include "core/weights_folder.h"

#include <gtest/gtest.h>

namespace daumier::exporting {
namespace {

Manifest ManifestOfCard() {
  Manifest manifest{.kind = kWeightsKind, .verb = "export", .seed = 3};
  manifest.sources = Json::array({{{"name", "Faces"}, {"licence", "CC0-1.0"}}});
  manifest.details = {
      {"training_seconds", 90},
      {"recipe", Json::array()},
      {"float16",
       {{"samples", "`x`: crops"}, {"num_samples", 8}, {"tolerance", 0.01}, {"largest_difference", {{"y", 0.00123}}}}}};
  return manifest;
}

TEST(WeightsCard, HasTheEffectOfFloat16OnEachOutput) {
  const std::string card = WeightsCard({.title = "A"}, ManifestOfCard(), Json::object(), "");
  EXPECT_NE(card.find("Input: 8 samples, `x`: crops. At most 0.01 is allowed."), std::string::npos);
  EXPECT_NE(card.find("| `y` | 0.0012 |"), std::string::npos);
}

TEST(WeightsCard, HasNoEmptySections) {
  const CardText text{
      .title = "A", .summary = "It computes.", .inputs_and_outputs = "x, y\n\n", .limits = {"It errs."}};
  const std::string card = WeightsCard(text, ManifestOfCard(), Json::object(), "");
  EXPECT_EQ(card.find("| command |"), std::string::npos) << "there is no recipe";
  EXPECT_EQ(card.find("It needs"), std::string::npos);
  EXPECT_EQ(card.find("\n\n\n"), std::string::npos);
}

}  // namespace
}  // namespace daumier::exporting

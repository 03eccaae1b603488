#include "systems/prediction_options.h"

#include <gtest/gtest.h>

namespace daumier::systems {
namespace {

System Drawings() {
  System system{};
  system.resolve_prediction = [](const Json&, const std::string&) -> Json {
    return {{"fit", true}, {"refine", true}, {"parsing", {{"rounds", 2}}}};
  };
  return system;
}

System Portraits() {
  System system{};
  system.resolve_prediction = [](const Json&, const std::string&) -> Json { return {{"refine", true}, {"crop", 1}}; };
  return system;
}

TEST(PredictionOptions, AreFoundByDottedKeys) {
  EXPECT_TRUE(HasPredictionOption(Drawings(), "fit"));
  EXPECT_TRUE(HasPredictionOption(Drawings(), "parsing.rounds"));
  EXPECT_FALSE(HasPredictionOption(Drawings(), "parsing.round"));
  EXPECT_FALSE(HasPredictionOption(Drawings(), "fit.rounds"));
  EXPECT_FALSE(HasPredictionOption(System{}, "fit")) << "a task that predicts nothing";
}

TEST(PredictionOptions, ATaskGetsItsOwnAndThoseThatNoneHas) {
  const System drawings = Drawings(), portraits = Portraits();
  const std::vector<const System*> both = {&drawings, &portraits};
  const std::vector<std::string> words = {"fit=false", "refine=false", "crop=2", "parsing.rounds=1", "fitt=false"};
  EXPECT_EQ(OverridesOf(drawings, both, words),
            (std::vector<std::string>{"fit=false", "refine=false", "parsing.rounds=1", "fitt=false"}));
  EXPECT_EQ(OverridesOf(portraits, both, words), (std::vector<std::string>{"refine=false", "crop=2", "fitt=false"}));
  const std::vector<const System*> alone = {&portraits};
  EXPECT_EQ(OverridesOf(portraits, alone, words),
            (std::vector<std::string>{"fit=false", "refine=false", "crop=2", "parsing.rounds=1", "fitt=false"}));
}

}  // namespace
}  // namespace daumier::systems

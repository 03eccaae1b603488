#include "systems/portrait/system.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(LandmarkSystem, ResolvesItsOptionsAndRefusesUnknownOnes) {
  const systems::System system = LandmarkSystem();
  const Json resolved = system.resolve_config({{"system", "landmarks"}, {"data", {{"portraits", "p"}}}}, "c.toml");
  EXPECT_EQ(resolved["network"]["resolution"], 128);
  EXPECT_EQ(system.resolve_config(resolved, "c.toml"), resolved);
  EXPECT_EQ(system.resolve_evaluation(Json::object(), "eval")["split"], "test");
  EXPECT_EQ(system.resolve_prediction(Json::object(), "predict")["detector"]["rounds"], 2);
  testing::ExpectError([&] { system.resolve_prediction({{"landmark", "x"}}, "predict"); }, "unknown key 'landmark'");
  testing::ExpectError([&] { system.resolve_evaluation({{"rival", "x"}}, "eval"); }, "rival needs pictures");
}

}  // namespace
}  // namespace daumier::portrait

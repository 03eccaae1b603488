#include "faces/controls/artist_habits.h"

#include "faces/controls/face_control.h"
#include "faces/controls/smooth_warps.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace daumier::faces {
namespace {

TEST(ArtistHabits, NameControlsThatExist) {
  std::set<std::string> names;
  for (const FaceControl& control : AnatomicalControls()) names.insert(control.name);
  std::set<std::string> sideways;
  for (const GivenControl& warp : SmoothWarps(testing::SyntheticFace())) {
    names.insert(warp.name);
    if (warp.sides == FaceControl::Sides::kSideways) sideways.insert(warp.name);
  }
  for (const auto& [name, habit] : ArtistHabits()) {
    EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_GT(habit.boldness, 0) << name;
    EXPECT_LE(std::abs(habit.tendency), 1.5) << name;
    EXPECT_TRUE(habit.tendency == 0 || !sideways.contains(name)) << name << ": caricatures lean to no side";
  }
  EXPECT_EQ(HabitOf("a control of a user").boldness, 1);
}

}  // namespace
}  // namespace daumier::faces

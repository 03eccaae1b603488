#include "faces/controls/artist_habits.h"

#include "faces/controls/face_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace daumier::faces {
namespace {

TEST(ArtistHabits, NameControlsThatExist) {
  std::set<std::string> names;
  for (const FaceControl& control : AnatomicalControls()) names.insert(control.name);
  for (const auto& [name, habit] : ArtistHabits()) {
    EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_GT(habit.boldness, 0) << name;
    EXPECT_LT(std::abs(habit.tendency), 1) << name;
  }
  EXPECT_EQ(HabitOf("a control of a user").boldness, 1);
}

}  // namespace
}  // namespace daumier::faces

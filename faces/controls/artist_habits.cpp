#include "faces/controls/artist_habits.h"

namespace daumier::faces {

const std::map<std::string, ArtistHabit>& ArtistHabits() {
  static const std::map<std::string, ArtistHabit> habits = {
      {"brow_height", {1.5, -0.2, {0, 0, 0.5}}},
      {"brow_ridge", {0.4, 0}},
      {"cheek_fullness", {1, 0, {1, -0.6, 0}}},
      {"cheek_hollows", {0.5, 0}},
      {"chin_cleft", {0.5, 0}},
      {"chin_length", {1.5, 0.4, {0, 0.8, -0.8}}},
      {"chin_point", {1, 0.25, {0, 0.5, 0}}},
      {"chin_protrusion", {0.4, 0}},
      {"chin_width", {1.5, 0, {0.7, 0, 0}}},
      {"double_chin", {1, 0, {1, 0, 0}}},
      {"ear_angle", {0.5, 0}},
      {"ear_level", {0.4, 0, {0, -0.4, 0}}},
      {"ear_size", {0.5, 0, {0, 0.4, 0}}},
      {"eye_bags", {0.5, 0}},
      {"eye_depth", {0.4, 0}},
      {"eye_height", {0.5, 0}},
      {"eye_level", {1.5, 0.15, {0, 0, -0.6}}},
      {"eye_size", {1.5, 0, {0, 0, 1}}},
      {"eye_spacing", {1, -0.25}},
      {"face_bend", {0.5, 0}},
      {"face_depth", {0.4, 0.4}},
      {"face_length", {1.5, 0, {0, 1, 0}}},
      {"face_taper", {1, -0.15, {-1, 0, 0.6}}},
      {"face_width", {1.5, -0.25, {1, -0.7, 0}}},
      {"forehead_bulge", {0.4, 0}},
      {"forehead_height", {1.5, 0, {0, 0.4, 1}}},
      {"forehead_slope", {0.4, 0}},
      {"jaw_angle", {1.5, 0, {0.5, 0, 0}}},
      {"jaw_width", {1.5, 0, {1.2, -0.3, -0.6}}},
      {"mouth_corners", {1, 0.3}},
      {"mouth_level", {1.5, -0.2, {0, 0, 0.3}}},
      {"mouth_protrusion", {0.4, 0}},
      {"mouth_width", {1.5, 0, {0.5, 0, -0.4}}},
      {"neck_forward", {0.4, 0}},
      {"neck_width", {0.5, 0, {0.8, 0, 0}}},
      {"nose_bridge", {0.4, 0}},
      {"nose_hump", {0.5, 0}},
      {"nose_length", {1.5, -0.2, {0, 0.8, -0.7}}},
      {"nose_projection", {0.4, 0}},
      {"nose_tip", {0.5, 0}},
      {"nose_tip_angle", {0.4, 0}},
      {"nose_width", {1.5, -0.25, {0.5, 0, -0.4}}},
      {"philtrum", {0.5, 0}},
      {"profile_bend", {0.4, 0}},
      {"skull_depth", {0.4, 0}},
      {"skull_height", {1.5, 0, {0, 0, 0.7}}},
      {"skull_width", {0.5, 0}},
      {"temple_height", {1.5, 0, {0, 0.5, 0}}},
      {"temples", {1, 0, {0, 0, 0.5}}},
      {"upper_lip", {0.5, 0}},
  };
  return habits;
}

ArtistHabit HabitOf(const std::string& control) {
  const auto found = ArtistHabits().find(control);
  return found == ArtistHabits().end() ? ArtistHabit{} : found->second;
}

}  // namespace daumier::faces

#pragma once
#include <array>
#include <map>
#include <string>

namespace daumier::faces {

/// What caricaturists do with a control, whoever the person is.
struct ArtistHabit {
  double boldness = 1;  ///< How far they go in it, as a multiple of what they do with others.
  double tendency = 0;  ///< The value that an amount of caricature of 1 has on average.
  /// How it takes part in three types of heads, which are drawn as wholes: stout, long, childlike.
  std::array<double, 3> types = {0, 0, 0};
};

/// By the name of a control, without its side. Constants were judged by eye and on 15 caricature meshes by artists: they
/// draw from the front, so depth varies little; they go far in the proportions of jaw, chin, nose and forehead, and less
/// far in details; chins are long, eyes close together, features high.
const std::map<std::string, ArtistHabit>& ArtistHabits();

/// That of a control; {} where nothing is known of it.
ArtistHabit HabitOf(const std::string& control);

}  // namespace daumier::faces

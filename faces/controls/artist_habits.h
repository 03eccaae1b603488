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

/// By the name of a control, without its side, or of a smooth warp. Boldness and tendency come from 15 caricature meshes
/// by artists, in values of ControlFit from ICT's mean: a tendency is half the meshes' mean value, since an amount of
/// caricature is 2 on average; boldness was scaled once by the ratio of the meshes' standard deviation to the generator's,
/// and rounded. So artists draw long, pointed chins, wide wings of the nose, open and raised mouths, narrow skulls and
/// features set high, vary depth little, and go far in jaw, lips and nose. Types of heads were judged by eye.
const std::map<std::string, ArtistHabit>& ArtistHabits();

/// That of a control; {} where nothing is known of it.
ArtistHabit HabitOf(const std::string& control);

}  // namespace daumier::faces

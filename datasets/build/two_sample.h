#pragma once
#include "faces/face_database.h"

#include <optional>
#include <vector>

namespace daumier::datasets {

/// Shapes of L points each, grouped by whom they show: the shapes of a group resemble each other.
using ShapeGroups = std::vector<std::vector<geometry::Points>>;

struct TwoSampleTest {
  int sample_size = 0, num_draws = 0;
  double accuracy = 0;         ///< Mean over draws; 0.5 where the sets agree, 1 where they are apart.
  double accuracy_spread = 0;  ///< Standard deviation over draws.
  double first_accuracy = 0, second_accuracy = 0;  ///< Of the shapes of one set alone.
};

/// The accuracy of a leave-one-out 1-nearest-neighbour two-sample test [Lopez-Paz and Oquab 2017]. Each draw takes
/// `sample_size` groups of either set without replacement (of both sets as many as the smaller one has, if that is
/// less), and of a group one shape. The shapes of a draw are aligned together, whatever set they are from: each by the
/// similarity of AlignSimilarity onto their mean shape, which has unit size, until the mean changes by less than 1e-6
/// (generalised Procrustes analysis [Gower 1975], at most 20 rounds). A shape is right if its nearest other shape, by
/// the root of the summed squared distances of points, is of its own set.
/// Shapes of a wide set may all be nearest to those of a narrow one, which is right of the narrow and wrong of the wide
/// set, 0.5 together: the sets agree only where both accuracies are about 0.5.
/// Promises: sets of one distribution give 0.5 within the spread of samples, sets that are apart 1; a similarity
/// of any shape changes nothing. Deterministic.
/// @throws Error if a set has fewer than two groups or an empty one, shapes differ in their number of points, or
/// sample_size is less than 2 or num_draws less than 1.
TwoSampleTest TestTwoSamples(const ShapeGroups& first, const ShapeGroups& second, int sample_size, int num_draws);

/// The test on landmarks of the faces of two databases.
struct LandmarkComparison {
  TwoSampleTest neutral, all_expressions;  ///< On all 68 landmarks.
  /// Where `real` was registered: the landmarks that have a match on at least half of its meshes, and the tests on
  /// these alone. The others' places come from the template and its smoothness, not from the meshes.
  std::vector<int> matched;
  std::optional<TwoSampleTest> neutral_matched, all_expressions_matched;
};

/// TestTwoSamples of all faces of the grid of `real` against those of `database` at some levels (0-based; none: all
/// levels above the first, of a database with one level that one): its neutral faces, and all its expressions. 30
/// against 30, 200 draws; groups are FaceDatabase::groups. Topologies may differ.
/// @throws Error naming a level that the database lacks, if fewer than four landmarks have matches, or as
/// TestTwoSamples.
LandmarkComparison CompareLandmarks(const faces::FaceDatabase& real, const faces::FaceDatabase& database,
                                    std::vector<int> levels);

}  // namespace daumier::datasets

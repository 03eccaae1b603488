#include "datasets/build/two_sample.h"

#include "core/error.h"
#include "core/random.h"
#include "geometry/alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace daumier::datasets {
namespace {

geometry::Points UnitSize(geometry::Points shape) {
  shape.rowwise() -= shape.colwise().mean().eval();
  const double size = shape.norm();
  DAUMIER_CHECK(size > 0, "the {} points of a shape lie in one place", shape.rows());
  return shape / size;
}

/// Generalised Procrustes analysis.
void AlignTogether(std::vector<geometry::Points>& shapes) {
  constexpr int kMaxRounds = 20;
  constexpr double kLeastChange = 1e-6;
  geometry::Points mean = UnitSize(shapes.front());
  for (int round = 0; round < kMaxRounds; ++round) {
    geometry::Points sum = geometry::Points::Zero(mean.rows(), 3);
    for (geometry::Points& shape : shapes) {
      shape = geometry::AlignSimilarity(shape, mean).Apply(shape);
      sum += shape;
    }
    const geometry::Points next = UnitSize(sum);
    const double change = (next - mean).norm();
    mean = next;
    if (change < kLeastChange) break;
  }
}

/// One shape of each of `count` groups.
void DrawShapes(const ShapeGroups& groups, int count, Rng& rng, std::vector<geometry::Points>& shapes) {
  const std::vector<int> order = rng.Permutation(static_cast<int>(groups.size()));
  for (int i = 0; i < count; ++i) {
    const auto& group = groups[order[i]];
    shapes.push_back(group[rng.Below(group.size())]);
  }
}

size_t NearestOther(const std::vector<geometry::Points>& shapes, size_t shape) {
  size_t nearest = shape;
  double least = std::numeric_limits<double>::infinity();
  for (size_t other = 0; other < shapes.size(); ++other) {
    if (other == shape) continue;
    const double distance = (shapes[other] - shapes[shape]).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = other;
    }
  }
  return nearest;
}

void CheckShapes(const ShapeGroups& groups, Eigen::Index num_points) {
  DAUMIER_CHECK(groups.size() >= 2, "a two-sample test needs two persons or more of either set, found {}",
                groups.size());
  for (const auto& group : groups) {
    DAUMIER_CHECK(!group.empty(), "a person of a two-sample test has no face");
    for (const auto& shape : group)
      DAUMIER_CHECK(shape.rows() == num_points, "shapes of {} and {} points in one test", num_points, shape.rows());
  }
}

/// Landmarks of some levels and of the first expressions, by group.
ShapeGroups LandmarkShapes(const faces::FaceDatabase& database, const std::vector<int>& levels, int num_expressions) {
  const auto& landmarks = database.face_template().annotation.landmarks;
  const std::vector<int>& groups = database.groups();
  ShapeGroups shapes(size_t(*std::max_element(groups.begin(), groups.end())) + 1);
  for (int person = 0; person < database.num_persons(); ++person) {
    for (const int level : levels) {
      for (int expression = 0; expression < num_expressions; ++expression) {
        const auto all = database.vertices(database.index({person, level, expression}));
        geometry::Points points(landmarks.size(), 3);
        for (size_t l = 0; l < landmarks.size(); ++l) {
          for (int k = 0; k < 3; ++k) points(Eigen::Index(l), k) = all[3 * size_t(landmarks[l]) + k];
        }
        shapes[groups[person]].push_back(points);
      }
    }
  }
  return shapes;
}

ShapeGroups SelectRows(ShapeGroups groups, const std::vector<int>& rows) {
  for (auto& group : groups) {
    for (geometry::Points& shape : group) shape = geometry::Points(shape(rows, Eigen::all));
  }
  return groups;
}

/// The landmarks that at least half of registered faces have matches for; all of faces that were not registered.
std::vector<int> MatchedLandmarks(const faces::FaceDatabase& database) {
  const auto& landmarks = database.face_template().annotation.landmarks;
  std::vector<int> matched;
  for (int l = 0; l < int(landmarks.size()); ++l) {
    int num_matches = 0;
    for (int face = 0; face < database.num_grid_faces(); ++face) {
      const auto distances = database.match_distances(face);
      num_matches += distances.empty() || !std::isnan(distances[landmarks[l]]);
    }
    if (2 * num_matches >= database.num_grid_faces()) matched.push_back(l);
  }
  return matched;
}

}  // namespace

TwoSampleTest TestTwoSamples(const ShapeGroups& first, const ShapeGroups& second, int sample_size, int num_draws) {
  DAUMIER_CHECK(sample_size >= 2 && num_draws >= 1, "{} draws of {} shapes, expected 1 of 2 or more", num_draws,
                sample_size);
  DAUMIER_CHECK(!first.empty() && !first.front().empty(), "the first set of a two-sample test has no face");
  const Eigen::Index num_points = first.front().front().rows();
  CheckShapes(first, num_points);
  CheckShapes(second, num_points);

  TwoSampleTest test;
  test.sample_size = int(std::min({size_t(sample_size), first.size(), second.size()}));
  test.num_draws = num_draws;
  const auto size = static_cast<size_t>(test.sample_size);
  int64_t num_right_first = 0, num_right_second = 0, sum_of_squares = 0;  // Counts, so that 1 is exactly 1.
  for (int draw = 0; draw < num_draws; ++draw) {
    Rng rng = Stream(0, "two samples", draw);
    std::vector<geometry::Points> shapes;
    DrawShapes(first, test.sample_size, rng, shapes);
    DrawShapes(second, test.sample_size, rng, shapes);
    AlignTogether(shapes);
    int num_right = 0;
    for (size_t i = 0; i < shapes.size(); ++i) {
      const bool is_first = i < size;
      if ((NearestOther(shapes, i) < size) != is_first) continue;
      ++num_right;
      ++(is_first ? num_right_first : num_right_second);
    }
    sum_of_squares += int64_t(num_right) * num_right;
  }
  const double num_drawn = double(size) * num_draws;
  test.first_accuracy = double(num_right_first) / num_drawn;
  test.second_accuracy = double(num_right_second) / num_drawn;
  const int64_t num_right = num_right_first + num_right_second;
  test.accuracy = double(num_right) / (2 * num_drawn);
  test.accuracy_spread = std::sqrt(double(num_draws * sum_of_squares - num_right * num_right)) / (2 * num_drawn);
  return test;
}

LandmarkComparison CompareLandmarks(const faces::FaceDatabase& real, const faces::FaceDatabase& database,
                                    std::vector<int> levels) {
  constexpr int kSampleSize = 30, kNumDraws = 200, kLeastLandmarks = 4;
  const auto all_levels = [](const faces::FaceDatabase& faces) {
    std::vector<int> numbers(faces.num_levels());
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  };
  for (const int level : levels)
    DAUMIER_CHECK(level >= 0 && level < database.num_levels(), "{}: no level {} (found 1 to {})",
                  database.directory().string(), level + 1, database.num_levels());
  if (levels.empty()) {
    levels = all_levels(database);
    if (levels.size() > 1) levels.erase(levels.begin());
  }
  const ShapeGroups real_shapes = LandmarkShapes(real, all_levels(real), real.num_expressions()),
                    neutral = LandmarkShapes(database, levels, 1),
                    all = LandmarkShapes(database, levels, database.num_expressions());
  LandmarkComparison comparison;
  comparison.neutral = TestTwoSamples(real_shapes, neutral, kSampleSize, kNumDraws);
  comparison.all_expressions = TestTwoSamples(real_shapes, all, kSampleSize, kNumDraws);
  comparison.matched = MatchedLandmarks(real);
  if (comparison.matched.size() < size_t(real_shapes.front().front().rows())) {
    DAUMIER_CHECK(comparison.matched.size() >= kLeastLandmarks,
                  "{}: {} landmarks have a match on half of the meshes, expected {} or more", real.directory().string(),
                  comparison.matched.size(), kLeastLandmarks);
    const ShapeGroups matched = SelectRows(real_shapes, comparison.matched);
    comparison.neutral_matched =
        TestTwoSamples(matched, SelectRows(neutral, comparison.matched), kSampleSize, kNumDraws);
    comparison.all_expressions_matched =
        TestTwoSamples(matched, SelectRows(all, comparison.matched), kSampleSize, kNumDraws);
  }
  return comparison;
}

}  // namespace daumier::datasets

#pragma once
#include <cstdint>
#include <span>
#include <vector>

/// Metrics share no code with losses, on purpose: a mistake in one does not hide in the other.
namespace daumier::eval {

/// Distance of every vertex, V numbers in millimetres: |p_i - g_i| * mm_per_cm. predicted, truth: 3V coordinates in cm
/// (x0 y0 z0 x1 ...). Nothing is aligned or scaled first. @throws Error if the lengths differ or are no multiple of 3.
std::vector<double> VertexErrors(std::span<const float> predicted, std::span<const float> truth, double mm_per_cm);

/// Mean of VertexErrors over the vertices of `region`, in millimetres. @throws Error also if the region is empty or has
/// a vertex that the face has not.
double MeanVertexError(std::span<const float> predicted, std::span<const float> truth, std::span<const int> region,
                       double mm_per_cm);

/// Distance of two vertices of a face in cm, for example of the outer corners of the eyes, landmarks 36 and 45.
double VertexDistance(std::span<const float> face, int vertex_a, int vertex_b);

double Mean(std::span<const double> values);

/// The value below which a share of `percent` / 100 lies, linear between neighbours in order: Percentile({1, 2, 4}, 50)
/// = 2, Percentile({1, 2, 4}, 75) = 3. @throws Error if there is no value.
double Percentile(std::span<const double> values, double percent);

struct Interval {
  double low, high;
};

/// The 95 % interval of the mean of `errors` by a bootstrap over persons: each of `num_draws` draws takes as many
/// persons as there are, with replacement, each with all of its faces. Faces of a person resemble each other, so that
/// resampling faces would promise too much. person: one a face. One person alone gives low = high = mean. Deterministic
/// in seed.
Interval PersonBootstrap(std::span<const double> errors, std::span<const int> persons, uint64_t seed,
                         int num_draws = 2000);

}  // namespace daumier::eval

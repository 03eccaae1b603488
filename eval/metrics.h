#pragma once
#include "core/statistics.h"
#include "eval/face_rows.h"

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

/// Mean distance of all vertices of all faces (n x 3V, one row a face), in the unit of the faces. @throws Error if the
/// sizes differ, there is no vertex, or a distance is not finite.
double MeanVertexDistance(const FaceRows& predicted, const FaceRows& truth);

/// Distance of two vertices of a face in cm, for example of the outer corners of the eyes, landmarks 36 and 45.
double VertexDistance(std::span<const float> face, int vertex_a, int vertex_b);

using daumier::Interval;
using daumier::Mean;
using daumier::Percentile;
using daumier::PersonBootstrap;

}  // namespace daumier::eval

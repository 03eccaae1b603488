#pragma once
#include "datasets/styles/drawing_context.h"

#include <functional>

namespace daumier::datasets {

/// The shape with errors of sizes and places of its parts: normal, of the deviation `parts` (twice as much in cartoons,
/// whose eyes are also larger). At 0 the shape is unchanged, but for the cartoon's eyes.
FaceShape WithErrors(FaceShape shape, double parts, DrawingCharacter character, Rng& rng);

/// A face of signs in place of a frontal one: an oval head, eyes, brows, nose, mouth and ears at places and sizes which
/// are those of the face at amount 0 and those of doodles by people at 1. @throws Error unless the face is frontal.
FaceShape DoodleShape(const FaceShape& shape, double amount, Rng& rng);

/// A smooth map of the plane near the head, by random polynomials of degree 1 to 3: displacements of about `amount`
/// times the height of the head at its border.
std::function<Eigen::Vector2d(const Eigen::Vector2d&)> SmoothBend(const FaceShape& shape, double amount, Rng& rng);

}  // namespace daumier::datasets

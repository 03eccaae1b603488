#pragma once
#include "core/random.h"
#include "render/styles/colour_planes.h"

namespace daumier::render {

/// Smooth noise in -1..1: random values on a lattice of cells of cell_x x cell_y pixels, joined by smoothstep curves
/// [Ebert et al. 2003, lattice value noise]. Cells of less than one pixel are one pixel.
Plane SmoothNoise(int height, int width, float cell_x, float cell_y, Rng& rng);

/// Sum of `octaves` smooth noises, each of half the cell and of 0.55 of the strength of the one before; about -1..1.
Plane FractalNoise(int height, int width, float cell, int octaves, Rng& rng);

/// Independent values a pixel, mean 0, standard deviation 1, bell-shaped: sums of four uniform numbers.
Plane WhiteNoise(int height, int width, Rng& rng);

/// Tooth of drawing paper in 0..1, mean about 0.5: white noise blurred a little and finer smooth noise.
Plane PaperGrain(int height, int width, Rng& rng);

}  // namespace daumier::render

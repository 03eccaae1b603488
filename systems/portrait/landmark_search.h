#pragma once
#include "core/array.h"
#include "systems/portrait/landmark_crop.h"

#include <span>
#include <vector>

/// The search for faces in a picture of any size by the search head of the network.
namespace daumier::portrait {

struct FoundBox {
  Box box;           ///< Of the 68 landmarks, pixels of the picture.
  double score = 0;  ///< Confidence, 0..1.
};

/// Squares of `size` pixels that show a picture at one scale, upright: level 0 is one square that holds the whole picture;
/// level k shows it 2^k as large, in squares that overlap by a half. Squares wholly outside of the picture are left out.
std::vector<CropFrame> SearchSquares(int height, int width, int size, int level);

/// Boxes of the peaks of a search map (5 x n x n, models/heat_map_unet.h) whose score is at least `least_score`: cells that
/// no neighbour of the 3 x 3 exceeds. In pixels of the picture.
std::vector<FoundBox> BoxesOfMap(std::span<const float> map, const CropFrame& frame, double least_score);

/// Without those that overlap a box of higher score by more than `most_overlap`; by falling score.
std::vector<FoundBox> WithoutDoubles(std::vector<FoundBox> boxes, double most_overlap = 0.3);

}  // namespace daumier::portrait

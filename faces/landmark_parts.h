#pragma once
#include <array>
#include <string_view>

namespace daumier::faces {

/// Parts of the 68 landmarks in iBUG order.
struct LandmarkPart {
  std::string_view name;
  int begin, end;  ///< begin <= i < end.
};
inline constexpr std::array<LandmarkPart, 5> kLandmarkParts = {
    {{"jaw", 0, 17}, {"brows", 17, 27}, {"nose", 27, 36}, {"eyes", 36, 48}, {"mouth", 48, 68}}};

}  // namespace daumier::faces

#pragma once
#include <array>
#include <memory>
#include <string>

namespace daumier::rig {

/// A material that a head of any topology brings along.
struct OwnMaterial {
  std::string name;
  std::array<float, 3> colour = {1, 1, 1};  ///< Linear light; a picture is multiplied by it.
  float opacity = 1;
  std::shared_ptr<const std::string> picture = {};  ///< A PNG or JPEG file; null: none.
};

}  // namespace daumier::rig

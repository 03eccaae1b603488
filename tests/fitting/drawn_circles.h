#pragma once
#include "render/strokes.h"

#include <cmath>
#include <vector>

namespace daumier::fitting {

/// Lines as dense as those of a face.
inline std::vector<render::Stroke> Circles() {
  std::vector<render::Stroke> strokes;
  for (const float radius : {20.0f, 40.0f, 60.0f, 80.0f, 100.0f}) {
    render::Stroke circle;
    for (int i = 0; i <= 60; ++i) {
      const float angle = 2.0f * 3.14159265f * i / 60.0f;
      circle.points.push_back({128 + radius * std::cos(angle), 128 + radius * std::sin(angle)});
    }
    strokes.push_back(circle);
  }
  return strokes;
}

}  // namespace daumier::fitting

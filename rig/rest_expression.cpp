#include "rig/rest_expression.h"

#include <fmt/format.h>

namespace daumier::rig {

RestExpression MeasureRest(const geometry::Points& face, const std::array<int, 68>& landmarks) {
  const auto at = [&](size_t l) -> geometry::Vector3 { return face.row(landmarks[l]).transpose(); };
  const auto between = [&](size_t a, size_t b) { return (at(a) - at(b)).norm(); };
  return {.lip_gap = (between(61, 67) + between(62, 66) + between(63, 65)) / (3 * between(60, 64)),
          .corner_rise = 0.5 * (at(48) + at(54) - at(51) - at(57)).y() / between(48, 54),
          .mouth_width = between(48, 54) / between(36, 45)};
}

std::vector<std::string> WarningsOf(const RestExpression& rest) {
  constexpr const char* kRepair = "Rig a neutral mesh of the head, if there is one";
  std::vector<std::string> warnings;
  if (rest.lip_gap > kOpenAtRest)
    warnings.push_back(
        fmt::format("the mouth is open at rest (the lips are {:.2f} of its width apart, {} at most if it is closed): "
                    "jawOpen opens it farther, and mouthClose does not close it. {}",
                    rest.lip_gap, kOpenAtRest, kRepair));
  if (rest.corner_rise > kRaisedAtRest && rest.mouth_width > kWideAtRest)
    warnings.push_back(fmt::format(
        "the mouth seems to smile at rest (it is {:.2f} as wide as the eyes are apart, with raised corners): "
        "expressions add to the smile. {}",
        rest.mouth_width, kRepair));
  return warnings;
}

}  // namespace daumier::rig

#pragma once
#include "core/json.h"
#include "geometry/mesh.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace daumier::studio {

/// A vertex that is moved.
struct ShapeHandle {
  int vertex = 0;
  geometry::Vector3 move;  ///< cm
  bool operator==(const ShapeHandle&) const = default;
};

/// A face as a person shapes it: a pure function of this document (FaceShaper). In JSON the same keys; all but base may be absent:
///   {base: "mean", a pinned face or a session; toward: {face, share: 0 to 1}; controls: {nose_wings_left: -3 to 3, ...};
///    exaggeration: 0 to 0.4; caricature: 0 to 2; handles: [{vertex, move: [x, y, z]}, ...]; expressions: {jawOpen: -1 to 2, ...};
///    gains: {jawOpen: 0 to 3, ...}}
struct ShapeDocument {
  struct Toward {
    std::string face;
    double share = 0;
    bool operator==(const Toward&) const = default;
  };
  std::string base = "mean";
  std::optional<Toward> toward = {};
  std::map<std::string, double> controls = {};
  double exaggeration = 0;  ///< gamma of faces::Exaggerate.
  double caricature = 0;    ///< Strength of fitting::Exaggerate.
  std::vector<ShapeHandle> handles = {};
  std::map<std::string, double> expressions = {}, gains = {};

  /// The document without its expression.
  ShapeDocument Neutral() const;
  ShapeDocument WithoutHandles() const;
  bool operator==(const ShapeDocument&) const = default;
};

inline constexpr double kMostExaggeration = 0.4, kMostCaricature = 2, kMostMove = 10, kLeastExpression = -1,
                        kMostExpression = 2, kMostGain = 3;

/// Names are not checked: they are the face's. @throws UsageError naming the key that is unknown, of a wrong type or out of range.
ShapeDocument ShapeFromJson(const Json& json);

/// JSON schema of the document, for OpenApiOf.
Json ShapeSchema();

}  // namespace daumier::studio

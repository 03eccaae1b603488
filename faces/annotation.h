#pragma once
#include "geometry/mesh.h"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::faces {

/// The view in which a feature curve is drawn.
enum class View { kFrontal, kSide };

/// A line of a sketch as a path of vertices on the template [Han et al. 2017, section 4.1].
struct FeatureCurve {
  std::string name;  ///< Unique: "brow_left_upper".
  std::string kind;  ///< One of CurveKinds(): several curves may share it.
  View view = View::kFrontal;
  bool closed = false;
  std::vector<int> vertices;  ///< Neighbours along mesh edges; a closed curve does not repeat its first vertex.
};

/// silhouette, brow, upper_eye, lower_eye, upper_mouth, lower_mouth, lips, ear, nose, side_silhouette, in this order.
const std::vector<std::string>& CurveKinds();

/// The chin among Annotation::landmarks.
inline constexpr int kChinLandmark = 8;

/// What is known about a topology. All indices are vertices of the FaceTemplate that holds the annotation.
struct Annotation {
  /// The 68 landmarks of Multi-PIE / iBUG, 0-based: 8 is the chin, 36..41 and 42..47 the eyes, 48..67 the mouth.
  std::array<int, 68> landmarks{};
  int hairline_vertex = -1;
  std::vector<FeatureCurve> curves;
  /// Sorted vertex lists. Always there: face (where errors are averaged). With a complete annotation also eyes, mouth
  /// (each loop with two rings), neck_border, ears, nose.
  std::map<std::string, std::vector<int>> regions;
  /// mirror[v] is the vertex on the other side; an involution. Left is the face's own left, +x. Empty where an imported
  /// mesh is not its own mirror image.
  std::vector<int> mirror;
};

/// A region by its name. @throws Error saying what `purpose` needs and which entry of the annotation is missing.
const std::vector<int>& RegionFor(const Annotation& annotation, const std::string& name, std::string_view purpose);

}  // namespace daumier::faces

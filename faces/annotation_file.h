#pragma once
#include "faces/annotation.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace daumier::faces {

/// A closed path of waypoints, or the mirror image of another one of that name.
struct WaypointLoop {
  std::string name;
  std::vector<int> waypoints;
  std::string mirror_of;
};

/// The vertices of the polygons that are reached from a seed without crossing a loop, those of an index range, or
/// those of a list.
struct RegionRule {
  std::string name;
  std::vector<int> loop;
  int seed = -1;
  std::string mirror_of;
  std::optional<std::pair<int, int>> range;  ///< First and last, both included.
  std::vector<int> vertices = {};
};

struct CurveRule {
  FeatureCurve curve;   ///< `vertices` are waypoints still.
  bool mirror = false;  ///< Also its mirror image, with left and right exchanged in the name.
};

/// Manual annotation of a topology, in the source's own vertex numbers: faces/annotations/<source>.json, or a file
/// of the user's. docs/annotation.md describes the format.
struct AnnotationFile {
  static constexpr int kFormat = 1;

  std::array<int, 68> landmarks{};
  int hairline = -1;
  std::optional<double> cm_per_unit;  ///< Length of the source's unit; absent: what its importer takes for granted.
  std::optional<int> crop_seed;       ///< Absent: the whole mesh is kept.
  std::vector<WaypointLoop> cuts;
  std::vector<RegionRule> regions;
  std::vector<CurveRule> curves;
};

/// Only format, landmarks and hairline have to be there.
/// @throws Error naming the file and the key on malformed JSON, a missing or unknown entry, or another format version.
AnnotationFile ParseAnnotationFile(std::string_view text, std::string_view name);

/// faces/annotations/<source>_expressions.json: expression names and the weights of named expression shapes.
struct ExpressionRecipe {
  std::string name;
  std::vector<std::pair<std::string, float>> weights;
};
/// @throws Error as above, and if the first is not "neutral" or a name comes twice.
std::vector<ExpressionRecipe> ParseExpressionFile(std::string_view text, std::string_view name);

/// The text of an annotation that is compiled into the program, by its stem. @throws Error if there is none.
std::string_view EmbeddedAnnotation(const std::string& stem);

}  // namespace daumier::faces

#pragma once
#include "core/json.h"
#include "core/options.h"
#include "faces/face_model.h"
#include "geometry/submesh.h"
#include "render/contour_strokes.h"

#include <string>
#include <vector>

namespace daumier::datasets {

struct WrinkleOptions {
  bool drawn = true;
  double clearance_mm = 3;
  render::ContourOptions contours = {};

  template <class V>
  void Visit(V&& visit) {
    visit("drawn", drawn, Flag{}, "Draw suggestive contours in the wrinkle region.");
    visit("clearance_mm", clearance_mm, Range{0, 50},
          "Least distance of a wrinkle from a feature curve, on the mean face.");
    visit("contours", contours, Table{}, "Which of them.");
  }
};

/// faces::CurveKinds(), and behind them "wrinkle".
const std::vector<std::string>& SketchKinds();

/// The lines of a face in one view: the annotation's curves as polylines through their vertices (a closed curve repeats
/// its first point), always the same ones with the same number of points, and behind them wrinkles: visible suggestive
/// contours inside of WrinkleRegion [Han et al. 2017, section 4.1].
class SketchLines {
 public:
  /// Lengths of thresholds are those of the mean neutral face (render::FeatureSize). @throws Error if a curve is of an
  /// unknown kind, or as WrinkleRegion.
  SketchLines(const faces::FaceTemplate& face_template, faces::View view, const WrinkleOptions& wrinkles);

  /// Strokes of kinds SketchKinds() in pixels of the camera. `face`: V x 3, cm.
  std::vector<render::Stroke> Draw(const geometry::Points& face, const render::Camera& camera) const;

  /// {name, kind, closed} of each curve, in the order of the strokes.
  const Json& curves() const { return curve_facts_; }
  /// Of all points of the curves, in their order.
  const std::vector<int>& curve_vertices() const { return curve_vertices_; }
  int num_curve_points() const { return static_cast<int>(curve_vertices_.size()); }

 private:
  std::vector<render::Stroke> Wrinkles(const geometry::Points& face, const render::Camera& camera) const;

  WrinkleOptions wrinkles_;
  geometry::Triangles triangles_;
  std::vector<int> curve_vertices_;    ///< Of all points; a closed curve ends with its first vertex.
  std::vector<size_t> offsets_ = {0};  ///< Into curve_vertices_, a curve each and the end.
  std::vector<int> kinds_;             ///< Of each curve, into SketchKinds().
  Json curve_facts_ = Json::array();
  geometry::VertexMap region_;  ///< The wrinkle region and kContourRings around it.
  geometry::Triangles region_triangles_;
  std::vector<bool> is_drawn_;  ///< Whether all corners of a region triangle are in the region itself.
  double feature_size_ = 0, depth_tolerance_ = 0;  ///< cm
};

}  // namespace daumier::datasets

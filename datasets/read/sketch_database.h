#pragma once
#include "core/manifest.h"
#include "core/safetensors.h"
#include "datasets/read/sketch_facts.h"
#include "render/camera.h"
#include "render/strokes.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace daumier::datasets {

/// A folder of sketches on disk, some views of each face of a FaceDatabase and in its order: manifest.json (kind
/// "sketches", details.faces_data_hash), shards/person-00000.safetensors with `points` (P, 2) float32 on the 256
/// canvas, `stroke_offsets` (S + 1) int64 into points, `stroke_kinds` (S) int32, `sketch_offsets` (N * views + 1) int64
/// into strokes. Strokes are the master; rasters are derived. The first num_curves() strokes of any sketch are the
/// template's curves, each with the same number of points everywhere; wrinkles follow, as many as there are. Version 2
/// (details.version) adds turned views behind the others, and SketchFacts of each sketch; version 1 has neither. Version 3
/// holds drawings by hand: the first details.drawn_views of each face, whose strokes nobody labelled, and the exact view
/// behind them, whose curves are theirs too. It has no turned views and no facts.
class SketchDatabase {
 public:
  static constexpr int kVersion = 2, kDrawnVersion = 3;

  explicit SketchDatabase(const std::filesystem::path& directory, Checksums checksums = Checksums::kVerify);

  int num_faces() const { return num_faces_; }
  /// Views as networks read them. The first that is not drawn by hand is the exact one.
  int num_views() const { return num_views_; }
  /// The first of them, drawn by hand: 0 unless the database is of version 3.
  int num_drawn_views() const { return num_drawn_views_; }
  /// The view that has the labelled curves of a sketch: itself, or the exact one if it is drawn by hand.
  int labelled_view(int view) const { return view < num_drawn_views_ ? num_drawn_views_ : view; }
  /// Views behind these in which the face is turned far to a side.
  int num_turned_views() const { return num_turned_views_; }
  int num_curves() const { return num_curves_; }
  /// The strokes of any sketch that are silhouette or feature lines: the curves less those of IsWrinkleKind, ascending.
  const std::vector<int>& feature_curves() const { return feature_curves_; }
  /// `view`: below num_views() + num_turned_views(), as everywhere here.
  std::vector<render::Stroke> strokes(int face, int view = 0) const;
  /// @throws Error unless the database is of version 2.
  SketchFacts facts(int face, int view = 0) const;
  bool has_facts() const { return version_ == kVersion; }
  /// All points of the template's curves in a sketch, one after the other: 2K numbers on the 256 canvas (x0 y0 x1 ...).
  /// Of a drawing by hand those of the exact view.
  std::vector<float> curve_points(int face, int view = 0) const;
  /// The names of the template's curves, num_curves.
  const std::vector<std::string>& curve_names() const { return curve_names_; }
  /// Of the exact view.
  const render::Camera& camera() const { return camera_; }
  /// What Stroke::kind indexes.
  const std::vector<std::string>& kinds() const { return kinds_; }
  const Manifest& manifest() const { return manifest_; }

 private:
  /// The shard of a sketch and its row there.
  struct Place {
    const SafetensorsFile* shard;
    int64_t row;
  };
  Place Find(int face, int view) const;
  void CheckFacts(const std::filesystem::path& path, const SafetensorsFile& shard, int64_t num_sketches) const;

  std::filesystem::path directory_;
  Manifest manifest_;
  int version_ = 1;
  int num_faces_ = 0, num_views_ = 0, num_turned_views_ = 0, num_drawn_views_ = 0, num_curves_ = 0,
      faces_per_shard_ = 0;
  std::vector<int> feature_curves_;
  std::vector<std::string> kinds_, curve_names_;
  render::Camera camera_;
  std::vector<SafetensorsFile> shards_;
};

/// The points of some strokes, one after the other (x0 y0 x1 ...). @throws Error if there is no such stroke.
std::vector<float> PointsOf(const std::vector<render::Stroke>& strokes, std::span<const int> which);

/// Whether a stroke of this kind counts as a wrinkle: suggestive contours, and the outer contour of the lips [Han et
/// al. 2017, figure 3]. Silhouette and feature lines are all others.
bool IsWrinkleKind(const std::string& kind);

}  // namespace daumier::datasets

#pragma once
#include "systems/deform/train/baselines.h"
#include "systems/deform/train/table.h"
#include "systems/deform/train/code_fit.h"
#include "geometry/mesh.h"
#include "systems/deform/train/network.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace daumier::deform {

/// Faces that a deformable model is measured on, in its frame.
struct MeasuredFaces {
  torch::Tensor vertices;          ///< (n, V, 3) float32
  geometry::Triangles triangles;   ///< Of all of them.
  std::vector<int> faces, groups;  ///< n: their indices, and whom they show.
};

/// Of the rows that need no training by steps: template, mean face, nearest training face, linear model.
const std::vector<std::string>& DeformBaselineNames();

/// The rows of a table of errors on some faces. Every face has 10,000 points that are uniform by area on its own open
/// surface, the same in every measurement of it: where a network says that its template point goes, or where the
/// triangle of a mesh has it. Pairs of triangles that pierce each other are counted on the first 16 faces.
class DeformMeasurement {
 public:
  /// `network` has to outlive it. @throws Error if there is no face, or shapes disagree.
  DeformMeasurement(DeformNetwork& network, MeasuredFaces faces, uint64_t seed);

  /// Adds the row of the network on the first num_faces faces. The first such row of all faces is the result.
  void MeasureNetwork(const std::string& name, const CodeFitOptions& options, int num_faces);
  /// Adds the rows of the template alone, the mean training face, the nearest training face and the linear model.
  void MeasureBaselines(const DeformBaselines& baselines);

  const MeasuredFaces& faces() const { return faces_; }
  int num_faces() const { return static_cast<int>(faces_.faces.size()); }
  const std::vector<DeformRow>& rows() const { return rows_; }

  /// Of the result: its row; its codes (n, M); the mean vertex error of each face; the distance of each vertex (V), of
  /// one face or the mean of all. @throws Error if there is none yet.
  const DeformRow& result() const;
  const torch::Tensor& codes() const { return codes_; }
  const std::vector<double>& face_errors() const { return result().face_errors; }
  const torch::Tensor& mean_error_map() const { return mean_error_map_; }
  /// What the result makes of face i, (V, 3).
  torch::Tensor Predicted(int i) const;
  /// Pairs of triangles of true faces that pierce each other, mean over those that are counted.
  double true_self_intersections() const;

 private:
  struct Prediction {
    torch::Tensor vertices, samples;  ///< (V, 3), (S, 3)
    std::optional<double> seconds;
  };
  using Predictor = std::function<Prediction(int i)>;

  std::vector<SurfaceErrors> Errors(int num_faces, const Predictor& predict) const;
  void AddMeshRow(const std::string& name, const std::function<torch::Tensor(int i)>& vertices);
  geometry::TriangleMesh TrueMesh(int i) const;

  DeformNetwork& network_;
  const MeasuredFaces faces_;
  const uint64_t seed_;
  std::vector<SurfacePoints> samples_;  ///< Of each face, S points.
  std::vector<DeformRow> rows_;
  std::optional<size_t> result_;
  torch::Tensor codes_, mean_error_map_;
};

}  // namespace daumier::deform

#pragma once
#include "core/task.h"
#include "geometry/mesh.h"
#include "reports/metric_table.h"
#include "systems/deform/metrics.h"
#include "systems/deform/train/baselines.h"
#include "systems/deform/train/code_fit.h"
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
  std::vector<int> faces, groups;  ///< n: their indices, and the persons they show.
};

/// Errors of one predicted face.
struct SurfaceErrors {
  double mean_vertex_error = 0;     ///< Over all vertices, model units.
  double p95_vertex_error = 0;      ///< Over all vertices.
  double surface_sample_error = 0;  ///< Mean over points that are uniform by area on the true surface.
  double normal_error_degrees = 0;
  double flipped_triangles = 0;
  std::optional<double> self_intersections;  ///< Pairs of triangles; of the first faces only.
  std::optional<double> seconds;             ///< To find its code, if it has one.
};

/// The rows of a table of errors on some faces. Every face has 10,000 points that are uniform by area on its own open
/// surface, the same in every measurement of it: where a network says that its template point goes, or where the
/// triangle of a mesh has it. Pairs of triangles that pierce each other are counted on the first 16 faces.
class DeformMeasurement {
 public:
  /// `network` has to outlive it. @throws Error if there is no face, or shapes disagree.
  DeformMeasurement(DeformNetwork& network, MeasuredFaces faces, uint64_t seed, const ModelUnit& unit = {},
                    const Task& task = {});

  /// Adds the row of the network on the first num_faces faces. The first such row of all faces is the result. Reports
  /// faces to the task, or the steps of all faces where codes are fitted by adam.
  void MeasureNetwork(const std::string& name, const CodeFitOptions& options, int num_faces);
  /// Adds the row of the template alone.
  void MeasureTemplate();
  /// Adds the rows of the mean training face, the nearest training face and the linear model.
  void MeasureBaselines(const DeformBaselines& baselines);

  const MeasuredFaces& faces() const { return faces_; }
  int num_faces() const { return static_cast<int>(faces_.faces.size()); }
  /// With the columns DeformColumns.
  const reports::MetricTable& table() const { return table_; }

  /// Of the result: its row; its codes (n, M); the distance of each vertex (V), mean over faces. @throws Error if there
  /// is none yet.
  const reports::MetricRow& result() const;
  const torch::Tensor& codes() const { return codes_; }
  const torch::Tensor& mean_error_map() const { return mean_error_map_; }
  /// Face i as the result predicts it, (V, 3).
  torch::Tensor Predicted(int i) const;
  /// Pairs of triangles of true faces that pierce each other, mean over those that are counted.
  double true_self_intersections() const;

 private:
  struct Prediction {
    torch::Tensor vertices, samples;  ///< (V, 3), (S, 3)
    std::optional<double> seconds;
  };
  using Predictor = std::function<Prediction(int i)>;

  /// Calls `done` after each face.
  std::vector<SurfaceErrors> Errors(int num_faces, const Predictor& predict, const std::function<void()>& done) const;
  void AddRow(const std::string& name, const std::vector<SurfaceErrors>& errors);
  void AddBaseline(const std::string& name, const std::function<torch::Tensor(int i)>& vertices);
  geometry::TriangleMesh TrueMesh(int i) const;

  DeformNetwork& network_;
  const MeasuredFaces faces_;
  const uint64_t seed_;
  const ModelUnit unit_;
  const Task task_;
  std::vector<SurfacePoints> samples_;  ///< Of each face, S points.
  reports::MetricTable table_;
  bool has_result_ = false;
  torch::Tensor codes_, mean_error_map_;
};

}  // namespace daumier::deform

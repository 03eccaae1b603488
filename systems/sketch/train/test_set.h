#pragma once
#include "core/task.h"
#include "reports/metric_table.h"
#include "systems/sketch/evaluation_options.h"
#include "systems/sketch/train/reader.h"

#include <functional>
#include <vector>

namespace daumier::sketch {

/// Consecutive faces of a test set.
struct FaceBlock {
  size_t begin;  ///< Position of the first one in SketchTestSet::faces.
  std::span<const int> faces;
};

/// Vertex errors of a predictor on a test set, mm.
struct SketchErrors {
  std::vector<double> of_faces = {};  ///< One a face: mean over the region `face`.
  std::vector<double> of_vertices;    ///< One a vertex: mean over faces.
};

/// The faces of one subset of a run's split, the sketches of them that networks read, and how errors are measured.
class SketchTestSet {
 public:
  /// `data` has to outlive it. @throws UsageError if the side is empty.
  SketchTestSet(const SketchRunData& data, const SketchEvalOptions& options, const Task& task);

  const SketchRunData& data() const { return data_; }
  const SketchReader& reader() const { return reader_; }
  const Task& task() const { return task_; }
  const std::vector<int>& faces() const { return faces_; }
  const std::vector<int>& region() const { return region_; }
  Eigen::Index num_coordinates() const { return 3 * Eigen::Index(data_.faces.num_vertices()); }
  int num_persons() const;

  /// A table without rows: columns, faces and groups.
  reports::MetricTable EmptyTable() const;

  /// Predicted vertices of a block, row a face, 3V cm.
  using Predictor = std::function<eval::FaceRows(const FaceBlock& block)>;
  /// Predicts all faces in blocks of kBlock, reported to the task as `stage`. @throws Cancelled.
  SketchErrors Measure(const std::string& stage, const Predictor& predict) const;
  /// The same for predictors that build on each other: `predict` returns the vertices of each of `num_predictors`.
  using Predictors = std::function<std::vector<eval::FaceRows>(const FaceBlock& block)>;
  std::vector<SketchErrors> Measure(const std::string& stage, size_t num_predictors, const Predictors& predict) const;
  /// A row of EmptyTable. @throws Error naming the row if an error is not finite.
  reports::MetricRow Row(const std::string& name, const std::string& input, const SketchErrors& errors) const;

  /// One number a vertex, NaN outside of the region `face`.
  Eigen::VectorXd InRegion(const std::vector<double>& of_vertices) const;
  /// Distance of each vertex in mm, NaN outside of the region `face`.
  Eigen::VectorXd ErrorMap(std::span<const float> prediction, int face) const;
  /// Mean over the vertices of the annotation's eyes, mouth and nose in the region `face`, and `elsewhere` in it.
  std::map<std::string, double> RegionErrors(const std::vector<double>& of_vertices) const;

 private:
  void Add(std::span<const float> prediction, int face, SketchErrors& errors) const;

  const SketchRunData& data_;
  const std::vector<int>& faces_;
  const faces::Annotation& annotation_;
  const std::vector<int>& region_;
  const double mm_per_cm_;
  const SketchReader reader_;
  const Task task_;
  std::vector<int> groups_;
  std::vector<double> interocular_mm_;  ///< Of each true face.
};

}  // namespace daumier::sketch

#pragma once
#include "core/device.h"
#include "runtime/network_runner.h"
#include "systems/predictor.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace daumier::expression {

/// A mesh of the run's topology -> which expression it shows: results without a mesh, whose record and file .json are
/// {expression, probabilities: {neutral: 0.9, ...}}.
class ExpressionPredictor : public systems::Predictor {
 public:
  /// network: `vertices` (1, 3V), cm, to `scores` (1, number of expressions).
  ExpressionPredictor(std::vector<std::string> expressions, int64_t num_vertices,
                      std::unique_ptr<runtime::NetworkRunner> network);

  /// @throws Error if an input is no mesh, or has another number of vertices.
  std::vector<systems::FaceResult> Predict(std::span<const systems::Input> inputs,
                                           const Task& task = {}) const override;

 private:
  std::vector<std::string> expressions_;
  int64_t num_vertices_;
  std::unique_ptr<runtime::NetworkRunner> network_;
};

/// @throws Error as ReadFinishedRun and OpenNetwork.
std::unique_ptr<systems::Predictor> OpenPredictor(const std::filesystem::path& run, const Device& device,
                                                  const Json& options);

}  // namespace daumier::expression

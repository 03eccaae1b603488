// Not a benchmark: the table of docs/results/edit.md on labels.
//   edit_labels MODEL LABELLED UNSEEN [count]
// MODEL: as `daumier edit MODEL`. LABELLED, UNSEEN: folders of faces by controls of one topology, of different persons.
// Each control is raised by one deviation of the labelled faces on `count` (100) unseen neutral faces, and measured on
// the meshes (ControlLabels).
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "fitting/mesh_code.h"
#include "systems/deform/labelled_faces.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <vector>

namespace daumier::deform {
namespace {

/// Indices of neutral faces.
std::vector<int> NeutralFaces(const faces::FaceDatabase& database) {
  std::vector<int> indices;
  for (int face = 0; face < database.num_grid_faces(); ++face)
    if (database.id(face).expression == 0) indices.push_back(face);
  return indices;
}

/// Which of `persons` (rows: their faces less the mean) is nearest.
Eigen::Index NearestRow(const Eigen::MatrixXd& persons, const Eigen::VectorXd& face) {
  Eigen::Index nearest = 0;
  (persons.rowwise() - face.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return nearest;
}

void Run(const std::string& model_folder, const std::string& labelled_folder, const std::string& unseen_folder,
         int count) {
  const OpenedModel opened = OpenCodeModel(model_folder);
  const fitting::CodeModel& model = *opened.model;
  const faces::FaceDatabase labelled_faces(labelled_folder), unseen(unseen_folder);
  const fitting::LabelledCodes labelled = LabelledFaces(opened, labelled_faces, 1200).faces;
  const ControlLabels controls(labelled_faces);
  const std::vector<int> chosen = EvenlySpaced(NeutralFaces(unseen), count);
  const Eigen::MatrixXd codes =
      fitting::CodesOfMeshes(model, int(chosen.size()), [&](int i) { return unseen.points(chosen[size_t(i)]); });
  const int num_named = int(controls.names().size());
  Eigen::MatrixXd before(std::ssize(chosen), num_named);
  for (Eigen::Index i = 0; i < codes.rows(); ++i)
    before.row(i) = controls.Of(model.Vertices(codes.row(i).transpose())).transpose();

  std::vector<double> deviations(static_cast<size_t>(num_named));
  std::vector<Eigen::VectorXd> steps;
  std::vector<double> accuracies;
  for (int c = 0; c < num_named; ++c) {
    const fitting::CodeDirection direction = fitting::DirectionOf(labelled, controls.names()[size_t(c)]);
    steps.push_back(direction.step);
    accuracies.push_back(direction.accuracy);
    double sum = 0, squares = 0;
    int num_values = 0;
    for (const double value : labelled.labels.col(c)) {
      if (!std::isfinite(value)) continue;
      sum += value, squares += value * value, ++num_values;
    }
    deviations[size_t(c)] = std::sqrt(squares / num_values - std::pow(sum / num_values, 2));
  }
  fmt::print(
      "| edit | own change, deviations | least | controls of 0.8 or more | other controls, mean | accuracy | person "
      "kept |\n"
      "|---|---:|---:|---:|---:|---:|---:|\n");
  for (const bool keeps : {false, true}) {
    double own = 0, least = 1e9, others = 0, accuracy = 0;
    int num_good = 0, num_kept = 0, num_edits = 0;
    for (int c = 0; c < num_named; ++c) {
      Eigen::VectorXd step = steps[size_t(c)];
      if (keeps) {
        std::vector<Eigen::VectorXd> kept;
        for (int o = 0; o < num_named; ++o)
          if (o != c) kept.push_back(steps[size_t(o)]);
        try {
          step = fitting::Keeping(step, kept);
        } catch (const Error&) {
          continue;
        }
      }
      double change = 0, other = 0;
      constexpr Eigen::Index kMeasured = 20;  // Of the faces, evenly spaced: every fifth of 100.
      const Eigen::Index stride = std::max<Eigen::Index>(1, codes.rows() / kMeasured);
      int num_measured = 0;
      for (Eigen::Index i = 0; i < codes.rows(); i += stride) {
        const Eigen::VectorXd code = codes.row(i).transpose() + step;
        const Eigen::VectorXd after = controls.Of(model.Vertices(code));
        change += (after[c] - before(i, c)) / deviations[size_t(c)];
        for (int o = 0; o < num_named; ++o)
          if (o != c) other += std::abs(after[o] - before(i, o)) / deviations[size_t(o)] / (num_named - 1);
        num_kept += NearestRow(codes, code) == i ? 1 : 0;
        ++num_edits;
        ++num_measured;
      }
      change /= num_measured;
      own += change;
      least = std::min(least, change);
      others += other / num_measured;
      accuracy += accuracies[size_t(c)];
      num_good += change >= 0.8 ? 1 : 0;
    }
    fmt::print("| {} | {:.2f} | {:.2f} | {} of {} | {:.3f} | {:.2f} | {:.1f} % |\n",
               keeps ? "conditional: all others kept" : "difference of means", own / num_named, least, num_good,
               num_named, others / num_named, accuracy / num_named, 100.0 * num_kept / num_edits);
  }
  for (size_t c = 0; c < labelled.names.size(); ++c) {
    const std::string& name = labelled.names[c];
    if (std::ranges::count(controls.names(), name) > 0) continue;
    fmt::print("{}: accuracy {:.3f}\n", name, fitting::DirectionOf(labelled, name).accuracy);
  }
}

}  // namespace
}  // namespace daumier::deform

int main(int argc, char** argv) {
  try {
    if (argc < 4) throw daumier::UsageError("edit_labels MODEL LABELLED UNSEEN [count]");
    daumier::deform::Run(argv[1], argv[2], argv[3], argc > 4 ? std::stoi(argv[4]) : 100);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "edit_labels: {}\n", error.what());
    return 1;
  }
}

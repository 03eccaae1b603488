// Not a benchmark: the table of docs/results/edit.md on labels.
//   edit_labels MODEL LABELLED UNSEEN [count]
// MODEL: as `daumier edit MODEL`. LABELLED, UNSEEN: folders of faces by controls of one topology, of different persons.
// Each control is raised by one deviation of the labelled faces on `count` (100) unseen neutral faces, and measured on
// the meshes (ControlLabels).
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/stopwatch.h"
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

using fitting::CodeDirection, fitting::DirectionMethod;

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

double DeviationOf(const Eigen::VectorXd& values) {
  double sum = 0, squares = 0;
  int count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value, squares += value * value, ++count;
  }
  return std::sqrt(squares / count - std::pow(sum / count, 2));
}

/// Controls on unseen faces.
class UnseenEdits {
 public:
  UnseenEdits(const OpenedModel& opened, const faces::FaceDatabase& labelled_faces, const faces::FaceDatabase& unseen,
              int count)
      : model_(*opened.model),
        labelled_(LabelledFaces(opened, labelled_faces, 1200).faces),
        unseen_classes_(LabelledFaces(opened, unseen, 1200).faces),
        controls_(labelled_faces) {
    const std::vector<int> chosen = EvenlySpaced(NeutralFaces(unseen), count);
    unseen_.names = controls_.names();
    unseen_.codes =
        fitting::CodesOfMeshes(model_, int(chosen.size()), [&](int i) { return unseen.points(chosen[size_t(i)]); });
    unseen_.labels.resize(std::ssize(chosen), num_controls());
    before_.resize(std::ssize(chosen), num_controls());
    for (Eigen::Index i = 0; i < before_.rows(); ++i) {
      unseen_.labels.row(i) = controls_.Of(unseen.points(chosen[size_t(i)])).transpose();
      before_.row(i) = controls_.Of(model_.Vertices(unseen_.codes.row(i).transpose())).transpose();
    }
    deviations_.resize(num_controls());
    for (Eigen::Index c = 0; c < num_controls(); ++c) deviations_[c] = DeviationOf(labelled_.labels.col(c));
  }

  /// A row of the table without and one with all other controls kept, and the accuracy of classes.
  void Print(DirectionMethod method, const std::string& title) const {
    const Stopwatch watch;
    std::vector<CodeDirection> directions;
    for (const std::string& name : controls_.names())
      directions.push_back(fitting::DirectionOf(labelled_, name, method));
    const double seconds = watch.seconds() / double(num_controls());
    for (const bool keeps : {false, true}) PrintRow(directions, keeps, title + (keeps ? ", all others kept" : ""));
    fmt::print("{}: {:.2f} s a direction", title, seconds);
    for (const std::string& name : labelled_.names) {
      if (std::ranges::count(controls_.names(), name) > 0) continue;
      const CodeDirection direction = fitting::DirectionOf(labelled_, name, method);
      fmt::print("; {}: held-out faces {:.3f}", name, direction.accuracy);
      if (std::ranges::count(unseen_classes_.names, name) == 0) continue;
      if (const auto accuracy = fitting::AccuracyOn(unseen_classes_, name, direction))
        fmt::print(", unseen persons {:.3f}", *accuracy);
    }
    fmt::print("\n");
  }

 private:
  Eigen::Index num_controls() const { return std::ssize(controls_.names()); }

  void PrintRow(const std::vector<CodeDirection>& directions, bool keeps, const std::string& title) const {
    double own = 0, least = 1e9, others = 0, accuracy = 0, unseen_accuracy = 0, length = 0;
    int num_good = 0, num_kept = 0, num_edits = 0;
    for (Eigen::Index c = 0; c < num_controls(); ++c) {
      const CodeDirection& direction = directions[size_t(c)];
      Eigen::VectorXd step = direction.step;
      if (keeps) {
        std::vector<Eigen::VectorXd> kept;
        for (Eigen::Index o = 0; o < num_controls(); ++o)
          if (o != c) kept.push_back(directions[size_t(o)].step);
        try {
          step = fitting::Keeping(step, kept);
        } catch (const Error&) {
          continue;
        }
      }
      constexpr Eigen::Index kMeasured = 20;  // Of the faces, evenly spaced: every fifth of 100.
      const Eigen::Index stride = std::max<Eigen::Index>(1, unseen_.codes.rows() / kMeasured);
      double change = 0, other = 0;
      int num_measured = 0;
      for (Eigen::Index i = 0; i < unseen_.codes.rows(); i += stride) {
        const Eigen::VectorXd code = unseen_.codes.row(i).transpose() + step;
        const Eigen::VectorXd changes =
            (controls_.Of(model_.Vertices(code)) - before_.row(i).transpose()).cwiseQuotient(deviations_);
        change += changes[c];
        other += (changes.cwiseAbs().sum() - std::abs(changes[c])) / double(num_controls() - 1);
        num_kept += NearestRow(unseen_.codes, code) == i ? 1 : 0;
        ++num_edits;
        ++num_measured;
      }
      change /= num_measured;
      own += change;
      length += step.norm();
      least = std::min(least, change);
      others += other / num_measured;
      accuracy += direction.accuracy;
      unseen_accuracy += fitting::AccuracyOn(unseen_, controls_.names()[size_t(c)], direction).value_or(0);
      num_good += change >= 0.8 ? 1 : 0;
    }
    const auto num = double(num_controls());
    fmt::print("| {} | {:.2f} | {:.2f} | {} of {} | {:.3f} | {:.2f} | {:.3f} | {:.3f} | {:.1f} % |\n", title, own / num,
               least, num_good, num_controls(), others / num, length / num, accuracy / num, unseen_accuracy / num,
               100.0 * num_kept / num_edits);
  }

  const fitting::CodeModel& model_;
  fitting::LabelledCodes labelled_, unseen_classes_;
  ControlLabels controls_;
  fitting::LabelledCodes unseen_;  ///< Controls of neutral faces, measured as those of the labelled ones.
  Eigen::MatrixXd before_;         ///< Controls of their faces of the model.
  Eigen::VectorXd deviations_;
};

void Run(const std::string& model, const std::string& labelled, const std::string& unseen, int count) {
  const OpenedModel opened = OpenCodeModel(model);
  const UnseenEdits edits(opened, faces::FaceDatabase(labelled), faces::FaceDatabase(unseen), count);
  fmt::print(
      "| edit | own change, deviations | least | controls of 0.8 or more | other controls, mean | length | accuracy, "
      "held-out faces | accuracy, unseen persons | person kept |\n"
      "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  edits.Print(DirectionMethod::kMeans, "difference of means");
  edits.Print(DirectionMethod::kSvm, "support vector machine");
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

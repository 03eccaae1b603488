// Not a benchmark: how far a model of 128 numbers can go beyond 128 principal components (docs/results/deform_row.md).
//   deform_ceiling FACES [seed] [components]
// FACES: a folder of faces by controls. Split by person as configs/deform/cpu.toml does (5 % validation, 10 % test).
// Coefficients behind the first `components` (128) are predicted from these on test persons: R2, and the mean vertex
// distance that the components with the predicted rest would have.
#include "core/error.h"
#include "datasets/read/splits.h"
#include "eval/metrics.h"
#include "eval/principal_components.h"

#include <fmt/core.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

namespace daumier::eval {
namespace {

using Inputs = FaceRows;  ///< A row a face.

constexpr int kMostComponents = 400;

struct Side {
  std::vector<int> faces;
  FaceRows vertices;  ///< n x 3V, cm
  FaceRows scores;    ///< n x 400, cm
};

double SquaredLength(const FaceRows& rows) {
  return rows.cast<double>().squaredNorm();
}

/// Ridge regression in the space of a kernel, to targets that have mean 0.
enum class Kernel { kLinear, kQuadratic, kGaussian };

/// - |a - b|^2
Eigen::ArrayXXd Nearness(const Inputs& a, const Inputs& b) {
  const Eigen::ArrayXd a2 = a.cast<double>().rowwise().squaredNorm();
  const Eigen::RowVectorXd b2 = b.cast<double>().rowwise().squaredNorm().transpose();
  const Eigen::ArrayXXd products = Product(a, b.transpose()).cast<double>().array();
  return (2 * products).colwise() - a2 - b2.replicate(a.rows(), 1).array();
}

Eigen::MatrixXd Gram(Kernel kernel, const Inputs& a, const Inputs& b) {
  if (kernel == Kernel::kGaussian) return Nearness(a, b).exp();
  const Eigen::ArrayXXd products = Product(a, b.transpose()).cast<double>().array();
  return kernel == Kernel::kLinear ? products : (1 + products).square();
}

double R2(const FaceRows& predicted, const FaceRows& truth) {
  return 1 - SquaredLength(truth - predicted) / SquaredLength(truth);
}

struct Prediction {
  std::string chosen;
  double validation_r2 = -1e9;
  FaceRows rest;  ///< Of the test faces.
};

/// Inputs and targets of training, validation and test faces.
struct Samples {
  Inputs training, validation, test;
  FaceRows training_rest, validation_rest, test_rest;
};

/// The scale of inputs and the ridge weight are chosen on validation persons.
Prediction ByKernel(const Samples& samples, Kernel kernel, const std::vector<double>& scales) {
  const Eigen::Index n = samples.training.rows();
  const double mean_square = SquaredLength(samples.training) / double(n);
  const Eigen::MatrixXd targets = samples.training_rest.cast<double>();
  Prediction best;
  for (const double scale : scales) {
    const auto factor = float(scale / std::sqrt(mean_square));
    const Inputs training = factor * samples.training;
    const Eigen::MatrixXd gram = Gram(kernel, training, training),
                          validation = Gram(kernel, factor * samples.validation, training);
    const double mean_diagonal = gram.diagonal().mean();
    for (const double ridge : {1e-3, 1e-2}) {
      Eigen::MatrixXd damped = gram;
      damped.diagonal().array() += ridge * mean_diagonal;
      const Eigen::MatrixXd dual = damped.llt().solve(targets);
      const double r2 = R2((validation * dual).cast<float>(), samples.validation_rest);
      if (r2 <= best.validation_r2) continue;
      best = {fmt::format("scale {:g}, ridge {:g}", scale, ridge), r2,
              (Gram(kernel, factor * samples.test, training) * dual).cast<float>()};
    }
  }
  return best;
}

/// Mean of the nearest training faces, times a share.
Prediction ByNeighbours(const Samples& samples) {
  const auto predict = [&](const Inputs& inputs, int count) {
    const Eigen::ArrayXXd nearness = Nearness(inputs, samples.training);
    FaceRows rest = FaceRows::Zero(inputs.rows(), samples.training_rest.cols());
    std::vector<Eigen::Index> order(size_t(samples.training.rows()));
    for (Eigen::Index i = 0; i < inputs.rows(); ++i) {
      std::iota(order.begin(), order.end(), Eigen::Index(0));
      std::ranges::partial_sort(order, order.begin() + count, std::ranges::greater(),
                                [&](Eigen::Index j) { return nearness(i, j); });
      for (int k = 0; k < count; ++k) rest.row(i) += samples.training_rest.row(order[size_t(k)]) / float(count);
    }
    return rest;
  };
  Prediction best;
  for (const int count : {1, 5, 20, 80}) {
    const FaceRows validation = predict(samples.validation, count);
    const double share =
        std::max(0.0, validation.cast<double>().cwiseProduct(samples.validation_rest.cast<double>()).sum() /
                          SquaredLength(validation));
    const double r2 = R2(float(share) * validation, samples.validation_rest);
    if (r2 > best.validation_r2)
      best = {fmt::format("{} faces, share {:.2f}", count, share), r2, float(share) * predict(samples.test, count)};
  }
  return best;
}

class Ceiling {
 public:
  Ceiling(const faces::FaceDatabase& database, uint64_t seed, int components)
      : database_(database), components_(components), mm_per_cm_(faces::MillimetresPerCm(database.face_template())) {
    const datasets::Split split =
        datasets::MakeSplit(database, {.kind = "person", .validation = 0.05, .test = 0.1}, seed);
    training_.faces = split.train;
    validation_.faces = split.validation;
    test_.faces = split.test;
    for (Side* const side : {&training_, &validation_, &test_})
      side->vertices = ReadRows([&](int face) { return database_.vertices(face); }, side->faces);
    mean_ = MeanFace([&](int face) { return database_.vertices(face); }, split.train);
    for (Side* const side : {&training_, &validation_, &test_}) side->vertices.rowwise() -= mean_;
    basis_ = FitPrincipalComponents({training_.vertices, mean_}, kMostComponents, seed).rows;
    for (Side* const side : {&training_, &validation_, &test_})
      side->scores = Product(side->vertices, basis_.transpose());
  }

  void Print() const {
    fmt::print("{} training faces, {} of unseen persons\n\n", training_.faces.size(), test_.faces.size());
    PrintEnergy();
    fmt::print("| predictor of coefficients {} to {} | R2 | mm | of principal components | chosen |\n", components_ + 1,
               kMostComponents);
    fmt::print("|---|---:|---:|---:|---|\n");
    const Samples own = SamplesOf([&](const Side& side) { return FaceRows(side.scores.leftCols(components_)); });
    Row("linear ridge", own, ByKernel(own, Kernel::kLinear, {1}));
    Row("quadratic kernel ridge", own, ByKernel(own, Kernel::kQuadratic, {0.5, 1.5}));
    Row("Gaussian kernel ridge", own, ByKernel(own, Kernel::kGaussian, {0.25, 0.5}));
    Row("nearest faces", own, ByNeighbours(own));
    const Samples with_regular = SamplesOf([&](const Side& side) { return WithRegularFace(side); });
    Row("quadratic, with all coefficients of the person's regular face", with_regular,
        ByKernel(with_regular, Kernel::kQuadratic, {0.5, 1.5}));
    if (database_.control_names().empty()) return;
    const Samples with_controls = SamplesOf([&](const Side& side) { return WithControls(side); });
    Row("quadratic, with the generator's own values", with_controls,
        ByKernel(with_controls, Kernel::kQuadratic, {0.5, 1.5}));
  }

 private:
  template <class InputsOf>
  Samples SamplesOf(const InputsOf& inputs) const {
    const auto rest = [&](const Side& side) { return FaceRows(side.scores.rightCols(kMostComponents - components_)); };
    return {inputs(training_), inputs(validation_), inputs(test_), rest(training_), rest(validation_), rest(test_)};
  }

  /// Scores, and those behind the model's of the same person's regular neutral face.
  Inputs WithRegularFace(const Side& side) const {
    Inputs inputs(Eigen::Index(side.faces.size()), components_ + kMostComponents);
    for (Eigen::Index i = 0; i < inputs.rows(); ++i) {
      const int person = database_.id(side.faces[size_t(i)]).person;
      const FaceRows regular = AsRow(database_.vertices(database_.index({person, 0, 0}))) - mean_;
      inputs.row(i) << side.scores.row(i).head(components_), Product(regular, basis_.transpose());
    }
    return inputs;
  }

  /// Scores, and what the generator drew: weights of identity shapes, values of controls, the expression. Each kind has
  /// the mean square of the scores.
  Inputs WithControls(const Side& side) const {
    const Eigen::Index num_identity = std::ssize(database_.identity_weights(0)),
                       num_controls = std::ssize(database_.control_values(0, 0)),
                       num_expressions = database_.num_expressions();
    Inputs inputs(Eigen::Index(side.faces.size()), components_ + num_identity + num_controls + num_expressions);
    const float length = std::sqrt(float(SquaredLength(training_.scores) / double(training_.scores.rows())));
    for (Eigen::Index i = 0; i < inputs.rows(); ++i) {
      const faces::FaceId id = database_.id(side.faces[size_t(i)]);
      Eigen::RowVectorXf expression = Eigen::RowVectorXf::Zero(num_expressions);
      expression[id.expression] = length;
      inputs.row(i) << side.scores.row(i).head(components_),
          AsRow(database_.identity_weights(id.person)) * (length / std::sqrt(float(num_identity))),
          AsRow(database_.control_values(id.person, id.level)) * (length / std::sqrt(float(num_controls))), expression;
    }
    return inputs;
  }

  /// Mean vertex distance of a side's faces from the first `count` components and a rest, mm.
  double Error(const Side& side, int count, const FaceRows* rest = nullptr) const {
    FaceRows predicted = Product(side.scores.leftCols(count), basis_.topRows(count));
    if (rest != nullptr) predicted += Product(*rest, basis_.bottomRows(rest->cols()));
    return mm_per_cm_ * MeanVertexDistance(predicted, side.vertices);
  }

  void PrintEnergy() const {
    fmt::print("| components | training faces, mm | unseen persons, mm | variance left on unseen persons |\n");
    fmt::print("|---|---:|---:|---:|\n");
    for (const int count : {components_, 160, 200, 300, kMostComponents}) {
      const double left = 1 - SquaredLength(test_.scores.leftCols(count)) / SquaredLength(test_.vertices);
      fmt::print("| {} | {:.3f} | {:.3f} | {:.5f} |\n", count, Error(training_, count), Error(test_, count), left);
    }
    fmt::print("\n");
    FaceRows both(2 * training_.vertices.rows(), training_.vertices.cols());
    both << training_.vertices, MirrorImages(training_.vertices);
    const PrincipalComponents symmetric = FitPrincipalComponents(Centre(std::move(both)), components_, 1);
    const auto error = [&](const Side& side) {
      const FaceRows moved = side.vertices.rowwise() - symmetric.mean;
      const FaceRows left = moved - Product(Product(moved, symmetric.rows.transpose()), symmetric.rows);
      return mm_per_cm_ * MeanVertexDistance(left, FaceRows::Zero(left.rows(), left.cols()));
    };
    fmt::print(
        "{} components of faces and their mirror images: {:.3f} mm on unseen persons, {:.3f} of those of faces\n\n",
        components_, error(test_), error(test_) / Error(test_, components_));
  }

  /// Of faces without the mean face, which is taken from the mirror images too.
  FaceRows MirrorImages(const FaceRows& faces) const {
    const std::vector<int>& mirror = database_.face_template().annotation.mirror;
    FaceRows images(faces.rows(), faces.cols());
    for (Eigen::Index v = 0; v < std::ssize(mirror); ++v) {
      const auto from = Eigen::Index(mirror[size_t(v)]);
      for (Eigen::Index k = 0; k < 3; ++k) {
        const float sign = k == 0 ? -1.0f : 1.0f;
        images.col(3 * v + k) = sign * (faces.col(3 * from + k).array() + mean_[3 * from + k]) - mean_[3 * v + k];
      }
    }
    return images;
  }

  void Row(const std::string& name, const Samples& samples, const Prediction& prediction) const {
    const double own = Error(test_, components_), error = Error(test_, components_, &prediction.rest);
    fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {} |\n", name, R2(prediction.rest, samples.test_rest), error,
               error / own, prediction.chosen);
    std::fflush(stdout);
  }

  const faces::FaceDatabase& database_;
  const int components_;
  const double mm_per_cm_;
  Side training_, validation_, test_;  ///< Vertices without the mean of the training faces.
  Eigen::RowVectorXf mean_;
  FaceRows basis_;  ///< 400 x 3V
};

}  // namespace
}  // namespace daumier::eval

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: deform_ceiling FACES [seed] [components]\n");
    return 2;
  }
  try {
    const daumier::faces::FaceDatabase database{argv[1]};
    const auto number = [&](int i, int otherwise) { return argc > i ? std::stoi(argv[i]) : otherwise; };
    daumier::eval::Ceiling(database, uint64_t(number(2, 1)), number(3, 128)).Print();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

#include "faces/bilinear_model.h"

#include "core/error.h"
#include "core/parallel.h"
#include "core/safetensors.h"
#include "faces/leading_eigenvectors.h"
#include "faces/principal_components.h"
#include "geometry/symmetric_eigen.h"

#include <algorithm>
#include <cmath>

namespace daumier::faces {
namespace {

using FaceRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr size_t kBlockBytes = 64 << 20;

void StopFitIfCancelled(const Task& task) {
  task.ThrowIfCancelled("stopped while a bilinear model was fitted; nothing was written");
}

/// The additive model a_i + b_e of a two-way table with holes, by the normal equations with the a_i eliminated.
class AdditiveFit {
 public:
  explicit AdditiveFit(const Eigen::MatrixXd& present)
      : present_(present), inverse_row_counts_(present.rowwise().sum().cwiseInverse()) {
    Eigen::MatrixXd schur = -present.transpose() * inverse_row_counts_.asDiagonal() * present;
    schur.diagonal() += present.colwise().sum().transpose();
    // Constants may be moved between a and b: the pseudo-inverse takes the b of least norm.
    const geometry::SymmetricEigen eigen = geometry::DecomposeSymmetric(schur);
    const double smallest = 1e-10 * std::max(1.0, eigen.values.cwiseAbs().maxCoeff());
    const Eigen::VectorXd inverse =
        eigen.values.unaryExpr([smallest](double value) { return value > smallest ? 1.0 / value : 0.0; });
    schur_inverse_ = eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
  }

  bool complete() const { return present_.minCoeff() > 0; }
  bool present(Eigen::Index i, Eigen::Index e) const { return present_(i, e) > 0; }

  /// Fills the rows (i * E + e) of `faces` that are not present.
  void Impute(FaceRows& faces) const {
    const Eigen::Index num_identities = present_.rows(), num_expressions = present_.cols();
    Eigen::MatrixXd identity_sums = Eigen::MatrixXd::Zero(num_identities, faces.cols());
    Eigen::MatrixXd expression_sums = Eigen::MatrixXd::Zero(num_expressions, faces.cols());
    for (Eigen::Index i = 0; i < num_identities; ++i) {
      for (Eigen::Index e = 0; e < num_expressions; ++e) {
        if (!present(i, e)) continue;
        identity_sums.row(i) += faces.row(i * num_expressions + e).cast<double>();
        expression_sums.row(e) += faces.row(i * num_expressions + e).cast<double>();
      }
    }
    const Eigen::MatrixXd b =
        schur_inverse_ * (expression_sums - present_.transpose() * (inverse_row_counts_.asDiagonal() * identity_sums));
    const Eigen::MatrixXd a = inverse_row_counts_.asDiagonal() * (identity_sums - present_ * b);
    for (Eigen::Index i = 0; i < num_identities; ++i) {
      for (Eigen::Index e = 0; e < num_expressions; ++e) {
        if (!present(i, e)) faces.row(i * num_expressions + e) = (a.row(i) + b.row(e)).cast<float>();
      }
    }
  }

 private:
  Eigen::MatrixXd present_;  ///< I x E, ones and zeros.
  Eigen::VectorXd inverse_row_counts_;
  Eigen::MatrixXd schur_inverse_;
};

/// Some coordinates of all faces, row i * E + e, minus their mean: in float32 the mean face would swamp small
/// components.
struct Block {
  int begin = 0;
  FaceRows faces;
  Eigen::VectorXd mean;
};

/// The tensor cut into blocks of coordinates.
class BlockReader {
 public:
  BlockReader(int num_identities, int num_expressions, int num_coordinates, const FaceReader& face)
      : num_identities_(num_identities),
        num_expressions_(num_expressions),
        num_coordinates_(num_coordinates),
        face_(face),
        additive_(Present()) {
    const size_t bytes_a_coordinate = sizeof(float) * num_identities * num_expressions;
    block_size_ = static_cast<int>(std::clamp<size_t>(kBlockBytes / bytes_a_coordinate, 1, 4096));
  }

  int num_blocks() const { return (num_coordinates_ + block_size_ - 1) / block_size_; }

  Block Read(int block) const {
    const int begin = block * block_size_, size = std::min(block_size_, num_coordinates_ - begin);
    Block result{begin, FaceRows(num_identities_ * num_expressions_, size), {}};
    for (int i = 0; i < num_identities_; ++i) {
      for (int e = 0; e < num_expressions_; ++e) {
        if (!additive_.present(i, e)) continue;
        const auto coordinates = face_(i, e);
        result.faces.row(i * num_expressions_ + e) =
            Eigen::Map<const Eigen::RowVectorXf>(coordinates.data() + begin, size);
      }
    }
    if (!additive_.complete()) additive_.Impute(result.faces);
    result.mean = Eigen::VectorXd::Zero(size);
    for (Eigen::Index row = 0; row < result.faces.rows(); ++row) {
      result.mean += result.faces.row(row).cast<double>().transpose();
    }
    result.mean /= static_cast<double>(result.faces.rows());
    // What is subtracted is exactly what is added again later.
    const Eigen::RowVectorXf mean = result.mean.cast<float>().transpose();
    result.mean = mean.cast<double>().transpose();
    result.faces.rowwise() -= mean;
    return result;
  }

 private:
  Eigen::MatrixXd Present() const {
    Eigen::MatrixXd present(num_identities_, num_expressions_);
    for (int i = 0; i < num_identities_; ++i) {
      for (int e = 0; e < num_expressions_; ++e) {
        const size_t size = face_(i, e).size();
        DAUMIER_CHECK(size == 0 || size == static_cast<size_t>(num_coordinates_),
                      "face of identity {}, expression {} has {} coordinates, expected {}", i, e, size,
                      num_coordinates_);
        present(i, e) = size == 0 ? 0.0 : 1.0;
      }
      DAUMIER_CHECK(present.row(i).sum() > 0, "identity {} has no face to fit a bilinear model to", i);
    }
    for (int e = 0; e < num_expressions_; ++e) {
      DAUMIER_CHECK(present.col(e).sum() > 0, "expression {} has no face to fit a bilinear model to", e);
    }
    return present;
  }

  int num_identities_, num_expressions_, num_coordinates_, block_size_ = 1;
  const FaceReader& face_;
  AdditiveFit additive_;
};

/// Sums over coordinates of centred faces x_ie and their mean m.
struct GramSums {
  Eigen::MatrixXd identity;    ///< sum_e x_ie . x_je, lower triangle
  Eigen::MatrixXd expression;  ///< sum_i x_ie . x_if, lower triangle
  Eigen::MatrixXd mean_dots;   ///< x_ie . m
  double mean_square = 0.0;    ///< m . m

  GramSums(int num_identities, int num_expressions)
      : identity(Eigen::MatrixXd::Zero(num_identities, num_identities)),
        expression(Eigen::MatrixXd::Zero(num_expressions, num_expressions)),
        mean_dots(Eigen::MatrixXd::Zero(num_identities, num_expressions)) {}

  void Add(const Block& block, const Task& task) {
    const int num_identities = static_cast<int>(identity.rows()), num_expressions = static_cast<int>(expression.rows());
    const int size = static_cast<int>(block.faces.cols());
    const Eigen::Map<const FaceRows> by_identity(block.faces.data(), num_identities,
                                                 Eigen::Index(num_expressions) * size);
    constexpr Eigen::Index kChunk = 4096;  // Summed in float32; chunks are summed in double.
    Eigen::MatrixXf sum(num_identities, num_identities);
    for (Eigen::Index begin = 0; begin < by_identity.cols(); begin += kChunk) {
      StopFitIfCancelled(task);
      sum.setZero();
      sum.selfadjointView<Eigen::Lower>().rankUpdate(
          by_identity.middleCols(begin, std::min(kChunk, by_identity.cols() - begin)));
      identity += sum.cast<double>();
    }
    sum.resize(num_expressions, num_expressions);
    for (int i = 0; i < num_identities; ++i) {
      const auto rows = block.faces.middleRows(i * num_expressions, num_expressions);
      sum.setZero();
      sum.selfadjointView<Eigen::Lower>().rankUpdate(rows);
      expression += sum.cast<double>();
      for (int e = 0; e < num_expressions; ++e) mean_dots(i, e) += rows.row(e).cast<double>().dot(block.mean);
    }
    mean_square += block.mean.squaredNorm();
  }

  GramSums& operator+=(const GramSums& other) {
    identity += other.identity;
    expression += other.expression;
    mean_dots += other.mean_dots;
    mean_square += other.mean_square;
    return *this;
  }
};

/// The leading eigenvectors of sum_k (x_ik + m) . (x_jk + m), given those sums without m; `dots` are sum_k x_ik . m.
Eigen::MatrixXf Factors(Eigen::MatrixXd gram, const Eigen::VectorXd& dots, double mean_square, int rank) {
  gram += dots.replicate(1, gram.cols()) + dots.transpose().replicate(gram.rows(), 1);
  gram.array() += mean_square;
  Eigen::MatrixXd factors = FindLeadingEigenvectors(gram, rank).vectors;
  for (int k = 0; k < rank; ++k) FixSign(factors.col(k));
  return factors.cast<float>();
}

/// The columns of the core that belong to a block: U^T x V^T applied to its faces, Ku x (Kv * size).
FaceRows CoreColumns(const Block& block, const Eigen::MatrixXf& u, const Eigen::MatrixXf& v) {
  const Eigen::Index size = block.faces.cols(), num_expressions = v.rows(), kv = v.cols();
  FaceRows by_expression(u.rows(), kv * size);
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    Eigen::Map<FaceRows>(by_expression.row(i).data(), kv, size).noalias() =
        v.transpose() * block.faces.middleRows(i * num_expressions, num_expressions);
  }
  FaceRows core = u.transpose() * by_expression;
  const Eigen::MatrixXf mean_weights = u.colwise().sum().transpose() * v.colwise().sum();
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    Eigen::Map<FaceRows>(core.row(k).data(), kv, size) +=
        mean_weights.row(k).transpose() * block.mean.cast<float>().transpose();
  }
  return core;
}

}  // namespace

BilinearModel FitBilinear(int num_identities, int num_expressions, int num_coordinates, const FaceReader& face,
                          const BilinearOptions& options, const Task& task) {
  DAUMIER_CHECK(num_identities >= options.num_identity && num_expressions >= options.num_expression,
                "a bilinear model of {} x {} weights needs as many identities and expressions, found {} x {}; lower "
                "num_identity or num_expression, or build more faces",
                options.num_identity, options.num_expression, num_identities, num_expressions);
  const BlockReader reader(num_identities, num_expressions, num_coordinates, face);

  GramSums sums(num_identities, num_expressions);
  ForEachInOrder(
      reader.num_blocks(),
      [&](int block) {
        StopFitIfCancelled(task);
        GramSums part(num_identities, num_expressions);
        part.Add(reader.Read(block), task);
        return part;
      },
      [&](const GramSums& part) { sums += part; });

  BilinearModel model;
  model.num_identity = options.num_identity;
  model.num_expression = options.num_expression;
  model.identity_factors =
      Factors(sums.identity, sums.mean_dots.rowwise().sum(), num_expressions * sums.mean_square, options.num_identity);
  model.expression_factors = Factors(sums.expression, sums.mean_dots.colwise().sum().transpose(),
                                     num_identities * sums.mean_square, options.num_expression);

  struct Columns {
    int begin;
    FaceRows core;
  };
  model.core.resize(options.num_identity * options.num_expression, num_coordinates);
  ForEachInOrder(
      reader.num_blocks(),
      [&](int index) {
        StopFitIfCancelled(task);
        const Block block = reader.Read(index);
        return Columns{block.begin, CoreColumns(block, model.identity_factors, model.expression_factors)};
      },
      [&](Columns part) {
        const Eigen::Index size = part.core.cols() / options.num_expression;
        model.core.middleCols(part.begin, size) = Eigen::Map<const FaceRows>(part.core.data(), model.core.rows(), size);
      });
  return model;
}

Eigen::VectorXf Reconstruct(const BilinearModel& model, const Eigen::VectorXf& u, const Eigen::VectorXf& v) {
  DAUMIER_CHECK(u.size() == model.num_identity && v.size() == model.num_expression,
                "u has {} and v {} weights, the bilinear model expects {} and {}", u.size(), v.size(),
                model.num_identity, model.num_expression);
  Eigen::VectorXf products(model.core.rows());
  for (int k = 0; k < model.num_identity; ++k) {
    products.segment(k * model.num_expression, model.num_expression) = u(k) * v;
  }
  return model.core.transpose() * products;
}

std::string WriteBilinearModel(const std::filesystem::path& file, const BilinearModel& model) {
  const FaceRows identities = model.identity_factors, expressions = model.expression_factors;
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "bilinear");
  const auto add = [&writer](const std::string& name, const FaceRows& matrix) {
    writer.Add<float>(name, {matrix.rows(), matrix.cols()}, {matrix.data(), static_cast<size_t>(matrix.size())});
  };
  add("core", model.core);
  add("identity_factors", identities);
  add("expression_factors", expressions);
  return writer.Write(file);
}

BilinearModel ReadBilinearModel(const std::filesystem::path& file) {
  const SafetensorsFile arrays(file);
  const auto read = [&](const std::string& name) {
    const ArrayView& array = arrays.at(name);
    DAUMIER_CHECK(array.shape.size() == 2, "{}: array {} has {} dimensions, expected 2", file.string(), name,
                  array.shape.size());
    return Eigen::Map<const FaceRows>(array.As<float>().data(), array.shape[0], array.shape[1]);
  };
  BilinearModel model;
  model.core = read("core");
  model.identity_factors = read("identity_factors");
  model.expression_factors = read("expression_factors");
  model.num_identity = static_cast<int>(model.identity_factors.cols());
  model.num_expression = static_cast<int>(model.expression_factors.cols());
  DAUMIER_CHECK(model.core.rows() == Eigen::Index(model.num_identity) * model.num_expression,
                "{}: the core has {} rows, its factors need {} x {}", file.string(), model.core.rows(),
                model.num_identity, model.num_expression);
  return model;
}

}  // namespace daumier::faces

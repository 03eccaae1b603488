#include "geometry/region_deformation.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "geometry/submatrix.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <numeric>
#include <utility>

namespace daumier::geometry {
namespace {

/// With more coupled handles it takes less time to factorise the energy of the free vertices.
constexpr size_t kMostCoupled = 400;

FactorColumns ColumnsOf(const Eigen::SimplicialLLT<SparseMatrix>& factor) {
  const SparseMatrix& lower = factor.matrixL().nestedExpression();
  return {lower.outerIndexPtr(), lower.innerIndexPtr(), lower.valuePtr()};
}

}  // namespace

SurfaceStiffness MakeSurfaceStiffness(const TriangleMesh& rest) {
  SurfaceStiffness stiffness{CotangentLaplacian(rest), VertexAreas(rest), {}};
  for (Eigen::Index v = 0; v < stiffness.areas.size(); ++v)
    DAUMIER_CHECK(stiffness.areas[v] > 0, "vertex {} belongs to no triangle; remove it before deforming", v);
  const SparseMatrix scaled = stiffness.areas.cwiseInverse().asDiagonal() * stiffness.laplacian;
  stiffness.bending = stiffness.laplacian * scaled;
  return stiffness;
}

RegionDeformation::RegionDeformation(const SurfaceStiffness& stiffness, std::vector<int> region, double reach)
    : region_(std::move(region)) {
  const Eigen::Index num_vertices = stiffness.areas.size();
  DAUMIER_CHECK(!region_.empty(), "a region without vertices");
  DAUMIER_CHECK(reach > 0, "a reach of {} cm, expected a positive one", reach);
  place_of_vertex_.assign(size_t(num_vertices), -1);
  for (size_t place = 0; place < region_.size(); ++place) {
    const int v = region_[place];
    DAUMIER_CHECK(v >= 0 && v < num_vertices, "vertex {} of a region is out of range, there are {}", v, num_vertices);
    DAUMIER_CHECK(place_of_vertex_[size_t(v)] < 0, "vertex {} is in a region twice", v);
    place_of_vertex_[size_t(v)] = int(place);
  }
  areas_ = stiffness.areas(region_);
  // E = d^T (L + a M) M^-1 (L + a M) d, a = 1 / reach^2.
  const double a = 1 / (reach * reach);
  const auto in_region = [&](const SparseMatrix& matrix) {
    return Submatrix(matrix, place_of_vertex_, std::ssize(region_), region_);
  };
  energy_ = in_region(stiffness.bending) + 2 * a * in_region(stiffness.laplacian);
  energy_.diagonal() += a * a * areas_;
  auto factor = std::make_unique<Factor>(energy_);
  DAUMIER_CHECK(factor->info() == Eigen::Success,
                "the energy of a region of {} vertices is singular at a reach of {} cm", region_.size(), reach);
  factor_ = std::move(factor);
}

std::vector<int> RegionDeformation::Places(const std::vector<int>& handles) const {
  DAUMIER_CHECK(!handles.empty(), "there is no handle; mark some");
  std::vector<int> places;
  std::vector<bool> is_handle(region_.size(), false);
  for (const int v : handles) {
    const bool is_inside = v >= 0 && v < std::ssize(place_of_vertex_) && place_of_vertex_[size_t(v)] >= 0;
    DAUMIER_CHECK(is_inside, "handle {} is not in the region", v);
    places.push_back(place_of_vertex_[size_t(v)]);
    DAUMIER_CHECK(!is_handle[size_t(places.back())], "vertex {} is a handle twice", v);
    is_handle[size_t(places.back())] = true;
  }
  return places;
}

RegionDeformation::UnitSolutions RegionDeformation::SubstituteUnits(const std::vector<int>& places) const {
  const SparseMatrix& lower = factor_->matrixL().nestedExpression();
  const auto row_of = [&](int place) { return factor_->permutationP().indices()[place]; };
  std::vector<int> index(size_t(lower.cols()), -1);
  for (const int place : places) index[size_t(row_of(place))] = 0;
  // Not 0 are the ancestors of the units in the elimination tree: the parent of j is the first row below the diagonal.
  UnitSolutions solutions;
  for (int j = 0; j < lower.cols(); ++j) {
    if (index[size_t(j)] < 0) continue;
    index[size_t(j)] = int(solutions.rows.size());
    solutions.rows.push_back(j);
    SparseMatrix::InnerIterator entry(lower, j);  // The first of a column is its diagonal.
    if (++entry) index[size_t(entry.row())] = 0;
  }
  const size_t count = solutions.rows.size(), num_blocks = (places.size() + kBlockColumns - 1) / kBlockColumns;
  solutions.values.assign(num_blocks * count * kBlockColumns, 0);
  for (size_t b = 0; b < num_blocks; ++b) {
    double* const block = solutions.values.data() + b * count * kBlockColumns;
    const size_t first = b * kBlockColumns, last = std::min(places.size(), first + kBlockColumns);
    for (size_t k = first; k < last; ++k) block[index[size_t(row_of(places[k]))] * kBlockColumns + int(k - first)] = 1;
    solutions.firsts.push_back(index[size_t(row_of(places[first]))]);
    SubstituteBlock(ColumnsOf(*factor_), solutions.rows.data(), index.data(), solutions.firsts.back(), int(count),
                    block);
  }
  return solutions;
}

Eigen::MatrixXd RegionDeformation::UnitSolutions::Gram(Eigen::Index size) const {
  using Product = Eigen::Matrix<double, kBlockColumns, kBlockColumns, Eigen::RowMajor>;
  const auto num_blocks = std::ssize(firsts);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(num_blocks * kBlockColumns, num_blocks * kBlockColumns);
  for (Eigen::Index a = 0; a < num_blocks; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b) {
      Product product;
      MultiplyBlocks(block(size_t(a)), block(size_t(b)), firsts[size_t(a)], int(rows.size()), product.data());
      gram.block<kBlockColumns, kBlockColumns>(a * kBlockColumns, b * kBlockColumns) = product;
    }
  }
  return gram.topLeftCorner(size, size);
}

Eigen::MatrixXd RegionDeformation::UnitSolutions::Times(const Eigen::MatrixXd& right) const {
  using Block = Eigen::Matrix<double, Eigen::Dynamic, kBlockColumns, Eigen::RowMajor>;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(std::ssize(rows), right.cols());
  for (size_t b = 0; b < firsts.size(); ++b) {
    const Eigen::Index first = Eigen::Index(b) * kBlockColumns,
                       count = std::min<Eigen::Index>(kBlockColumns, right.rows() - first);
    sum +=
        Eigen::Map<const Block>(block(b), sum.rows(), kBlockColumns).leftCols(count) * right.middleRows(first, count);
  }
  return sum;
}

Eigen::MatrixXd RegionDeformation::Solve(const std::vector<int>& handles, const Eigen::MatrixXd& moves) const {
  const std::vector<int> places = Places(handles);
  DAUMIER_CHECK(moves.rows() == std::ssize(handles), "{} moves for {} handles", moves.rows(), handles.size());
  DAUMIER_CHECK(moves.allFinite(), "a handle's move is not finite");
  std::vector<bool> is_handle(region_.size(), false);
  for (const int place : places) is_handle[size_t(place)] = true;
  std::vector<int> coupled, coupled_rows;
  for (size_t k = 0; k < places.size(); ++k) {
    bool is_coupled = false;
    for (SparseMatrix::InnerIterator entry(energy_, places[k]); entry && !is_coupled; ++entry)
      is_coupled = !is_handle[size_t(entry.row())];
    if (!is_coupled) continue;
    coupled.push_back(places[k]);
    coupled_rows.push_back(int(k));
  }
  Eigen::MatrixXd displacement = Eigen::MatrixXd::Zero(std::ssize(region_), moves.cols());
  displacement(places, Eigen::all) = moves;
  if (coupled.size() > kMostCoupled) {
    SolveFree(displacement, is_handle);
  } else if (!coupled.empty()) {
    displacement = SolveCoupled(coupled, moves(coupled_rows, Eigen::all));
    displacement(places, Eigen::all) = moves;
  }
  return displacement;
}

Eigen::MatrixXd RegionDeformation::SolveCoupled(const std::vector<int>& places, const Eigen::MatrixXd& moves) const {
  // Handles in the order of the factor: those of a block have most of their rows in common, and begin late.
  std::vector<int> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int k) { return factor_->permutationP().indices()[places[size_t(k)]]; });
  std::vector<int> sorted;
  for (const int k : order) sorted.push_back(places[size_t(k)]);
  // With E = |U d|^2, U the transposed lower factor, and y the columns of the inverse of U^T at the handles: U d is in
  // their span, and y^T U d = moves.
  const UnitSolutions y = SubstituteUnits(sorted);
  const Eigen::LLT<Eigen::MatrixXd> factor(y.Gram(moves.rows()));
  DAUMIER_CHECK(factor.info() == Eigen::Success, "{} handles nearly coincide", places.size());
  const Eigen::MatrixXd forces = factor.solve(moves(order, Eigen::all));
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kSolvedColumns, Eigen::RowMajor>;
  const Eigen::MatrixXd of_rows = y.Times(forces);
  Eigen::MatrixXd displacement(std::ssize(region_), moves.cols());
  for (Eigen::Index first = 0; first < moves.cols(); first += kSolvedColumns) {
    const Eigen::Index count = std::min<Eigen::Index>(kSolvedColumns, moves.cols() - first);
    Rows x = Rows::Zero(displacement.rows(), kSolvedColumns);
    for (size_t i = 0; i < y.rows.size(); ++i)
      x.row(y.rows[i]).head(count) = of_rows.row(Eigen::Index(i)).segment(first, count);
    SubstituteBackwards(ColumnsOf(*factor_), int(x.rows()), x.data());
    displacement.middleCols(first, count) = factor_->permutationPinv() * x.leftCols(count);
  }
  return displacement;
}

void RegionDeformation::SolveFree(Eigen::MatrixXd& displacement, const std::vector<bool>& is_handle) const {
  std::vector<int> free, free_of(is_handle.size(), -1);
  for (size_t place = 0; place < is_handle.size(); ++place) {
    if (is_handle[place]) continue;
    free_of[place] = int(free.size());
    free.push_back(int(place));
  }
  const Eigen::MatrixXd forces = -Eigen::MatrixXd(energy_ * displacement)(free, Eigen::all);  // Of the handles alone.
  const Eigen::MatrixXd solved = Factor(Submatrix(energy_, free_of, std::ssize(free), free)).solve(forces);
  displacement(free, Eigen::all) = solved;
}

Eigen::VectorXd RegionDeformation::Dome(const std::vector<int>& handles) const {
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(std::ssize(region_));
  for (const int place : Places(handles)) pressure[place] = areas_[place];
  const Eigen::VectorXd displacement = factor_->solve(pressure);
  return displacement / displacement.maxCoeff();
}

}  // namespace daumier::geometry

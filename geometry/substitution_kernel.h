#pragma once

/// Loops over numbers of SparseFactor and RegionDeformation.
namespace daumier::geometry {

/// A lower triangular factor by columns; the diagonal is the first entry of each.
struct FactorColumns {
  const int* starts;
  const int* rows;
  const double* values;
};

/// Solves L x = b, or L' x = b, in place for kSolvedColumns right-hand sides: each entry of L is read once. x: N x kSolvedColumns by rows.
inline constexpr int kSolvedColumns = 4;
void SubstituteForwards(const FactorColumns& lower, int num_rows, double* x);
void SubstituteBackwards(const FactorColumns& lower, int num_rows, double* x);

/// Columns of a block. A row of a block is as many numbers.
inline constexpr int kBlockColumns = 8;

/// Solves L x = b in place for the columns of one block. Only `count` rows of x are not 0: those of L in `kept`, ascending; place: of each
/// of them its row in the block. Rows before `first` are 0.
void SubstituteBlock(const FactorColumns& lower, const int* kept, const int* place, int first, int count, double* x);

/// The products of the columns of two blocks, a' b, over rows first to count - 1: kBlockColumns x kBlockColumns by rows.
void MultiplyBlocks(const double* a, const double* b, int first, int count, double* products);

}  // namespace daumier::geometry

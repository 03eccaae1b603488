#include "render/thinning.h"

#include "core/error.h"
#include "render/ink.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace daumier::render {
namespace {

/// The eight neighbours of a pixel, bit 0 above it and on clockwise; a bit is set where there is ink.
using Neighbours = unsigned;

bool Bit(Neighbours neighbours, int i) {
  return ((neighbours >> (i & 7)) & 1) != 0;
}

/// Number of 8-connected pieces into which the neighbours fall once the pixel between them is taken away, where corners
/// alone do not count twice.
int NumPieces(Neighbours n) {
  int count = 0;
  for (int i = 0; i < 8; i += 2) count += !Bit(n, i) && (Bit(n, i + 1) || Bit(n, i + 2));
  return count;
}

/// Whether a pixel goes in one of the two alternating passes [Guo and Hall 1989, A1].
bool Goes(Neighbours n, int pass) {
  if (NumPieces(n) != 1) return false;
  int first_pairs = 0, second_pairs = 0;
  for (int i = 0; i < 8; i += 2) {
    first_pairs += Bit(n, i + 7) || Bit(n, i);
    second_pairs += Bit(n, i) || Bit(n, i + 1);
  }
  const int num_pairs = std::min(first_pairs, second_pairs);
  if (num_pairs < 2 || num_pairs > 3) return false;
  const int i = pass == 0 ? 4 : 0;
  return !((Bit(n, i) || Bit(n, i + 1) || !Bit(n, i + 3)) && Bit(n, i + 2));
}

struct Tables {
  std::array<std::array<bool, 256>, 2> goes{};
  /// Of a line of more than one pixel's width: its end stays.
  std::array<bool, 256> is_superfluous{};
};

const Tables& GetTables() {
  static const Tables tables = [] {
    Tables made;
    for (Neighbours n = 0; n < 256; ++n) {
      for (int pass = 0; pass < 2; ++pass) made.goes[pass][n] = Goes(n, pass);
      made.is_superfluous[n] = NumPieces(n) == 1 && std::popcount(n) > 1;
    }
    return made;
  }();
  return tables;
}

/// The mask with a border of paper, so that every pixel has eight neighbours.
class PaddedMask {
 public:
  explicit PaddedMask(const Image& mask)
      : stride_(size_t(mask.width) + 2), is_ink_(stride_ * (size_t(mask.height) + 2), 0) {
    for (int row = 0; row < mask.height; ++row) {
      for (int column = 0; column < mask.width; ++column) {
        is_ink_[Index(row, column)] = mask.at(row, column) == kInk;
      }
    }
  }

  size_t Index(int row, int column) const { return size_t(row + 1) * stride_ + size_t(column) + 1; }
  bool IsInk(size_t index) const { return is_ink_[index] != 0; }
  void Clear(size_t index) { is_ink_[index] = 0; }

  Neighbours NeighboursOf(size_t index) const {
    const uint8_t* above = &is_ink_[index - stride_];
    const uint8_t* here = &is_ink_[index];
    const uint8_t* below = &is_ink_[index + stride_];
    return above[0] | above[1] << 1 | here[1] << 2 | below[1] << 3 | below[0] << 4 | below[-1] << 5 | here[-1] << 6 |
           above[-1] << 7;
  }

  std::array<size_t, 8> IndicesAround(size_t index) const {
    const size_t above = index - stride_, below = index + stride_;
    return {above - 1, above, above + 1, index - 1, index + 1, below - 1, below, below + 1};
  }

  size_t size() const { return is_ink_.size(); }

  std::vector<size_t> Ink() const {
    std::vector<size_t> indices;
    for (size_t index = 0; index < is_ink_.size(); ++index) {
      if (IsInk(index)) indices.push_back(index);
    }
    return indices;
  }

 private:
  size_t stride_;
  std::vector<uint8_t> is_ink_;
};

/// Clears in alternating passes, each for all pixels at once, the pixels that go, until none does. A pixel is tested in
/// a pass only if its neighbours changed since its last test in that pass. Linear in the ink.
void RemovePassByPass(PaddedMask& mask, const Tables& tables) {
  std::array<std::vector<size_t>, 2> to_test;
  std::vector<uint8_t> is_queued(mask.size(), 0);  // Bit k for pass k.
  constexpr Neighbours kAllInk = 255;
  for (const size_t index : mask.Ink()) {
    if (mask.NeighboursOf(index) == kAllInk) continue;
    for (auto& queue : to_test) queue.push_back(index);
    is_queued[index] = 3;
  }
  std::vector<size_t> going;
  for (int pass = 0; !to_test[0].empty() || !to_test[1].empty(); pass = 1 - pass) {
    going.clear();
    for (const size_t index : to_test[size_t(pass)]) {
      is_queued[index] &= static_cast<uint8_t>(~(1U << pass));
      if (mask.IsInk(index) && tables.goes[size_t(pass)][mask.NeighboursOf(index)]) going.push_back(index);
    }
    to_test[size_t(pass)].clear();
    for (const size_t index : going) mask.Clear(index);
    for (const size_t index : going) {
      for (const size_t around : mask.IndicesAround(index)) {
        if (!mask.IsInk(around)) continue;
        for (unsigned k = 0; k < 2; ++k) {
          if ((is_queued[around] >> k & 1) != 0) continue;
          is_queued[around] |= static_cast<uint8_t>(1U << k);
          to_test[k].push_back(around);
        }
      }
    }
  }
}

}  // namespace

Image Thin(const Image& ink) {
  DAUMIER_CHECK(ink.channels == 1, "a mask of {} channels is to be thinned, expected 1", ink.channels);
  const Tables& tables = GetTables();
  PaddedMask mask(ink);
  RemovePassByPass(mask, tables);
  for (const size_t index : mask.Ink()) {
    if (tables.is_superfluous[mask.NeighboursOf(index)]) mask.Clear(index);
  }

  Image skeleton(ink.height, ink.width, 1, kPaper);
  for (int row = 0; row < ink.height; ++row) {
    for (int column = 0; column < ink.width; ++column) {
      if (mask.IsInk(mask.Index(row, column))) skeleton.at(row, column) = kInk;
    }
  }
  return skeleton;
}

}  // namespace daumier::render

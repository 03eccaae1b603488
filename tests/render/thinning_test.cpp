#include "render/thinning.h"

#include "core/error.h"
#include "core/random.h"
#include "render/draw.h"
#include "render/ink.h"
#include "render/strokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace daumier::render {
namespace {

/// Pieces of the pixels of one value; 8 or 4 neighbours. Beyond the picture is paper.
int NumPieces(const Image& mask, uint8_t value, bool diagonal) {
  Image padded(mask.height + 2, mask.width + 2, 1, kPaper);
  Paste(padded, mask, 1, 1);
  int count = 0;
  for (size_t start = 0; start < padded.pixels.size(); ++start) {
    if (padded.pixels[start] != value) continue;
    ++count;
    std::vector<int> open = {static_cast<int>(start)};
    padded.pixels[start] = 128;
    while (!open.empty()) {
      const int row = open.back() / padded.width, column = open.back() % padded.width;
      open.pop_back();
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          const int r = row + dr, c = column + dc;
          if ((!diagonal && dr != 0 && dc != 0) || r < 0 || c < 0 || r >= padded.height || c >= padded.width) continue;
          if (padded.at(r, c) != value) continue;
          padded.at(r, c) = 128;
          open.push_back(r * padded.width + c);
        }
      }
    }
  }
  return count;
}

int CountInk(const Image& mask) {
  return static_cast<int>(std::count(mask.pixels.begin(), mask.pixels.end(), kInk));
}

void ExpectSameTopology(const Image& mask) {
  const Image skeleton = Thin(mask);
  EXPECT_EQ(NumPieces(skeleton, kInk, true), NumPieces(mask, kInk, true));
  EXPECT_EQ(NumPieces(skeleton, kPaper, false), NumPieces(mask, kPaper, false));
  for (size_t i = 0; i < mask.pixels.size(); ++i) ASSERT_GE(skeleton.pixels[i], mask.pixels[i]) << "outside the ink";
}

Image Paper(int size) {
  return {size, size, 1, kPaper};
}

void FillWith(Image& image, int top, int left, int height, int width, uint8_t value = kInk) {
  FillRectangle(image, top, left, height, width, {value, value, value});
}

TEST(Thin, BarBecomesItsMiddleRow) {
  Image bar = Paper(60);
  FillWith(bar, 20, 10, 7, 40);
  const Image skeleton = Thin(bar);
  for (int column = 14; column < 46; ++column) {
    for (int row = 0; row < 60; ++row) EXPECT_EQ(skeleton.at(row, column) == kInk, row == 23) << row << " " << column;
  }
  ExpectSameTopology(bar);
}

TEST(Thin, RingStaysARingInItsMiddle) {
  Image ring = Paper(100);
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 100; ++column) {
      if (std::abs(std::hypot(row - 50, column - 50) - 30) <= 5) ring.at(row, column) = kInk;
    }
  }
  ExpectSameTopology(ring);
  const Image skeleton = Thin(ring);
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 100; ++column) {
      if (skeleton.at(row, column) == kInk) {
        EXPECT_NEAR(std::hypot(row - 50, column - 50), 30, 1.5);
      }
    }
  }
}

TEST(Thin, CrossKeepsFourArms) {
  Image cross = Paper(80);
  FillWith(cross, 37, 10, 5, 60);
  FillWith(cross, 10, 37, 60, 5);
  ExpectSameTopology(cross);
  const Image skeleton = Thin(cross);
  EXPECT_EQ(skeleton.at(39, 20), kInk);
  EXPECT_EQ(skeleton.at(39, 60), kInk);
  EXPECT_EQ(skeleton.at(20, 39), kInk);
  EXPECT_EQ(skeleton.at(60, 39), kInk);
}

TEST(Thin, SmallPiecesDoNotVanish) {
  for (const auto& [height, width] : {std::pair{1, 1}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {2, 20}}) {
    Image piece = Paper(30);
    FillWith(piece, 5, 5, height, width);
    EXPECT_GE(CountInk(Thin(piece)), 1) << height << " x " << width;
    ExpectSameTopology(piece);
  }
}

TEST(Thin, TopologyOfRandomMasksIsKept) {
  Rng rng(11);
  for (int i = 0; i < 60; ++i) {
    Image mask = Paper(40);
    const double share = rng.Uniform(0.2, 0.8);
    for (uint8_t& value : mask.pixels) value = rng.Uniform() < share ? kInk : kPaper;
    ExpectSameTopology(mask);
    Image blobs = Paper(60);
    for (int blob = 0; blob < 12; ++blob) {
      FillWith(blobs, static_cast<int>(rng.Below(60)), static_cast<int>(rng.Below(60)), static_cast<int>(rng.Below(14)),
               static_cast<int>(rng.Below(14)), blob % 4 == 3 ? kPaper : kInk);
    }
    ExpectSameTopology(blobs);
  }
}

TEST(Thin, NoPixelIsSuperfluous) {
  Image mask = Paper(90);
  FillWith(mask, 20, 10, 12, 60);
  FillWith(mask, 10, 30, 70, 9);
  for (int i = 0; i < 60; ++i) FillWith(mask, 15 + i, 10 + i, 4, 4);
  const Image skeleton = Thin(mask);
  EXPECT_EQ(Thin(skeleton), skeleton);
  const int num_ink = NumPieces(skeleton, kInk, true), num_paper = NumPieces(skeleton, kPaper, false);
  for (int row = 1; row < 89; ++row) {
    for (int column = 1; column < 89; ++column) {
      if (skeleton.at(row, column) != kInk) continue;
      int num_neighbours = -1;
      for (int r = row - 1; r <= row + 1; ++r) {
        for (int c = column - 1; c <= column + 1; ++c) num_neighbours += skeleton.at(r, c) == kInk;
      }
      Image without = skeleton;
      without.at(row, column) = kPaper;
      EXPECT_TRUE(num_neighbours == 1 || NumPieces(without, kInk, true) != num_ink ||
                  NumPieces(without, kPaper, false) != num_paper)
          << row << " " << column;
    }
  }
}

TEST(Thin, InkAtTheBorderOfThePictureIsThinnedToo) {
  const Image all(20, 30, 1, kInk);
  ExpectSameTopology(all);
  EXPECT_LT(CountInk(Thin(all)), 40);
  EXPECT_THROW(Thin(Image(4, 4, 3)), Error);
}

}  // namespace
}  // namespace daumier::render

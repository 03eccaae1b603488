#include "faces/morph_target.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(MorphTarget, IsReadWithCommentsAndSpaces) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "a.target", "# comment\n\n 2 .1 -2e-1 0\r\n0\t1 2 3");
  const geometry::Points displacement = ReadMorphTarget(folder / "a.target", 3);
  EXPECT_EQ(displacement.row(0), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(displacement.row(1), Eigen::RowVector3d(0, 0, 0));
  EXPECT_EQ(displacement.row(2), Eigen::RowVector3d(0.1, -0.2, 0));
}

TEST(MorphTarget, NamesFileAndLineOfAFault) {
  const testing::TempDir folder;
  const auto expect = [&](const std::string& text, const std::string& message) {
    WriteFileAtomically(folder / "a.target", text);
    testing::ExpectError([&] { ReadMorphTarget(folder / "a.target", 3); }, message);
  };
  expect("0 1 2 3\n1 2\n", "a.target:2: expected a vertex and three numbers");
  expect("3 0 0 0\n", "vertex 3 is out of range (0 to 2)");
  expect("0 nan 0 0\n", "a.target:1");
  expect("1.5 0 0 1\n", "a.target:1: expected a vertex and three numbers");
  expect("1 0 0 1 7\n", "nothing behind them");
  expect("1 0 0 1\n1 0 1 0\n", "a.target:2: vertex 1 has two lines");
}

}  // namespace
}  // namespace daumier::faces

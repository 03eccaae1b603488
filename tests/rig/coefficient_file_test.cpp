#include "rig/coefficient_file.h"

#include "core/files.h"
#include "tests/rig/small_expression_map.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cstring>

namespace daumier::rig {
namespace {

using testing::ExpectError;
using testing::SmallExpressionMap;

CoefficientFrames Parsed(const std::string& text) {
  return ParseCoefficients(text, "c.csv", SmallExpressionMap());
}

void ExpectRefused(const std::string& text, const std::string& part) {
  ExpectError([&] { Parsed(text); }, part);
  ExpectError([&] { Parsed(text); }, "c.csv: ");
}

const Eigen::MatrixXf kTwoFrames = (Eigen::MatrixXf(2, 3) << 0.5f, -2, 1, 0, 3, 1).finished();

TEST(CoefficientFile, TablesWithAHeaderMayHaveAnyOrder) {
  const CoefficientFrames frames = Parsed("frame,b,time,a,mean\n0,-2,0.1,0.5,1\n1,3,0.3,0,1\n");
  EXPECT_EQ(frames.coefficients, kTwoFrames);
  EXPECT_EQ(frames.seconds, (std::vector<double>{0.1, 0.3}));
  EXPECT_TRUE(frames.warnings.empty());
}

TEST(CoefficientFile, ExpressionsWithoutAColumnAreZeroAndTheConstantIsOne) {
  const CoefficientFrames frames = Parsed("a\n0.5\n");
  EXPECT_EQ(frames.coefficients, (Eigen::MatrixXf(1, 3) << 0.5f, 0, 1).finished());
  EXPECT_EQ(frames.warnings, std::vector<std::string>{"1 of 3 expressions have no column and are 0"});
  EXPECT_TRUE(frames.seconds.empty());
}

TEST(CoefficientFile, RowsOfNumbersAreAllExpressionsOrAllButTheConstant) {
  EXPECT_EQ(Parsed("0.5,-2,1\n0,3,1\n").coefficients, kTwoFrames);
  EXPECT_EQ(Parsed("0.5 -2\n0 3\n").coefficients, kTwoFrames);
  EXPECT_EQ(Parsed("[[0.5, -2, 1], [0, 3, 1]]").coefficients, kTwoFrames);
  EXPECT_EQ(Parsed(" [[0.5, -2], [0, 3]]\n").coefficients, kTwoFrames);
}

TEST(CoefficientFile, ArraysOfNumPyAreRead) {
  const testing::TempDir folder;
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
  header.append(64 - (10 + header.size() + 1) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += char(header.size());
  bytes += '\0';
  bytes += header;
  const Eigen::Matrix<float, 2, 3, Eigen::RowMajor> rows = kTwoFrames;
  bytes.append(reinterpret_cast<const char*>(rows.data()), sizeof(float) * 6);
  WriteFileAtomically(folder / "c.npy", bytes);
  EXPECT_EQ(ReadCoefficients(folder / "c.npy", SmallExpressionMap()).coefficients, kTwoFrames);
  WriteFileAtomically(folder / "c.csv", "1,2,1\n");
  EXPECT_EQ(ReadCoefficients(folder / "c.csv", SmallExpressionMap()).coefficients(0, 1), 2);
}

TEST(CoefficientFile, RefusesWithFileLineAndRepair) {
  ExpectRefused("", "is empty");
  ExpectRefused("a,b,mean\n", "contains no frame");
  ExpectRefused("[]", "contains no frame");
  ExpectRefused("[[1, \"x\", 2]]", "is no list of frames");
  ExpectRefused("{\"a\": 1}", "is no list of frames");
  ExpectRefused("1,2,3,4\n", "frame 0 has 4 coefficients, the model 3 (a .. mean)");
  ExpectRefused("1\n", "frame 0 has 1 coefficients, the model 3");
  ExpectRefused("a,c\n1,2\n", "line 1: 'c' is no expression of the model");
  ExpectRefused("a,a\n1,2\n", "two columns are named 'a'");
  ExpectRefused("time\n1\n", "no column is an expression");
  ExpectRefused("a,b\n1,2\n1\n", "line 3: 1 cells, expected 2");
  ExpectRefused("a,b\n1,nan\n", "line 2: column 2: 'nan' is no finite number");
  ExpectRefused("1,2,1\n1,x,1\n", "line 2: column 2: 'x'");
  ExpectRefused("time,a\n0,1\n0,1\n", "line 3: the time 0 is not after");
  ExpectRefused("[[1, 2, 1e99]]", "not finite");
}

}  // namespace
}  // namespace daumier::rig

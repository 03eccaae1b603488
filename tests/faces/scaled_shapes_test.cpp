#include "faces/scaled_shapes.h"

#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::faces {
namespace {

using testing::ExpectError;

Eigen::MatrixXf RandomShapes(Eigen::Index rows, const std::vector<double>& sizes) {
  Rng rng(2);
  Eigen::MatrixXf shapes(rows, sizes.size());
  for (size_t k = 0; k < sizes.size(); ++k)
    for (Eigen::Index i = 0; i < rows; ++i)
      shapes(i, Eigen::Index(k)) = float(sizes[k] * std::clamp(rng.Normal() / 3, -1.0, 1.0));
  return shapes;
}

class ScaledShapesTest : public ::testing::Test {
 protected:
  SafetensorsFile Write(const Eigen::MatrixXf& shapes, double tolerance) const {
    SafetensorsWriter writer;
    AddScaledShapes(writer, "shapes", shapes, tolerance);
    writer.Write(file());
    return SafetensorsFile(file());
  }
  std::filesystem::path file() const { return folder_ / "a"; }

  const testing::TempDir folder_;
};

TEST_F(ScaledShapesTest, IntegersAreThoseOfTheLargestValue) {
  Eigen::MatrixXf shapes(3, 2);
  shapes << 127, 1000, -127, 500, 1, 0;
  const SafetensorsFile arrays = Write(shapes, 0.5);
  EXPECT_EQ(arrays.at("shapes/bits").As<uint8_t>()[0], 8);
  EXPECT_EQ(arrays.at("shapes/bits").As<uint8_t>()[1], 16);
  EXPECT_EQ(arrays.at("shapes/scales").As<float>()[0], 1);
  EXPECT_EQ(arrays.at("shapes/int8").As<int8_t>()[1], -127);
  EXPECT_EQ(arrays.at("shapes/int16").As<int16_t>()[0], 32767);
  EXPECT_EQ(arrays.at("shapes/int16").As<int16_t>()[1], 16384);
}

TEST_F(ScaledShapesTest, EveryNumberIsWithinTheTolerance) {
  const double tolerance = 1e-3;
  const Eigen::MatrixXf shapes = RandomShapes(300, {0.1, 30, 0.2, 0.3, 65, 0.01});
  const Eigen::MatrixXf read = ReadScaledShapes(Write(shapes, tolerance), "shapes", file());
  const double largest = (read - shapes).cwiseAbs().maxCoeff();
  EXPECT_LE(largest, 1.001 * tolerance);
  EXPECT_GT(largest, 0.3 * tolerance) << "the numbers are rounded";
  EXPECT_LT((read.col(5) - shapes.col(5)).cwiseAbs().maxCoeff(), 1e-4) << "a small shape has a small scale";
}

TEST_F(ScaledShapesTest, ZerosStayZerosAndNothingStaysNothing) {
  Eigen::MatrixXf shapes = RandomShapes(6, {0.1, 0.1, 9});
  shapes.col(1).setZero();
  shapes(3, 2) = 0;
  const Eigen::MatrixXf read = ReadScaledShapes(Write(shapes, 0.01), "shapes", file());
  EXPECT_TRUE(read.col(1).isZero(0));
  EXPECT_EQ(read(3, 2), 0);
  EXPECT_EQ(ReadScaledShapes(Write(Eigen::MatrixXf(6, 0), 0.01), "shapes", file()).size(), 0);
}

TEST_F(ScaledShapesTest, LargeShapesAreHeldToAShareOfTheirSize) {
  const Eigen::MatrixXf shapes = RandomShapes(50, {650});
  const Eigen::MatrixXf read = ReadScaledShapes(Write(shapes, 1e-3), "shapes", file());
  const double largest = shapes.cwiseAbs().maxCoeff(), difference = (read - shapes).cwiseAbs().maxCoeff();
  EXPECT_LE(difference, 1.01 * largest / 65534);
  EXPECT_GT(difference, 1e-3);
}

TEST_F(ScaledShapesTest, NumbersThatAreNotFiniteAreRefused) {
  Eigen::MatrixXf shapes = RandomShapes(50, {0.1, 0.1});
  shapes(7, 1) = std::numeric_limits<float>::quiet_NaN();
  ExpectError([&] { Write(shapes, 1e-3); }, "column 1 of 'shapes' is not finite");
}

TEST_F(ScaledShapesTest, ArraysThatDoNotBelongTogetherAreRefused) {
  const auto read = [&](const std::function<void(SafetensorsWriter&)>& add) {
    SafetensorsWriter writer;
    add(writer);
    writer.Write(file());
    ReadScaledShapes(SafetensorsFile(file()), "s", file());
  };
  const std::vector<float> scales = {1, 1};
  const std::vector<uint8_t> bits = {8, 16}, others = {8, 9};
  const std::vector<int8_t> small = {1, 2, 3};
  const std::vector<int16_t> large = {1, 2, 3}, longer = {1, 2, 3, 4};
  const auto add_all = [&](SafetensorsWriter& writer, const std::vector<uint8_t>& of_bits,
                           const std::vector<int16_t>& of_large) {
    writer.Add<float>("s/scales", {2}, scales);
    writer.Add<uint8_t>("s/bits", {2}, of_bits);
    writer.Add<int8_t>("s/int8", {1, 3}, small);
    if (!of_large.empty()) writer.Add<int16_t>("s/int16", {1, int64_t(of_large.size())}, of_large);
  };
  EXPECT_NO_THROW(read([&](SafetensorsWriter& writer) { add_all(writer, bits, large); }));
  ExpectError([&] { read([&](SafetensorsWriter& writer) { add_all(writer, others, large); }); },
              "a column of 9 bits, expected 8 or 16");
  ExpectError([&] { read([&](SafetensorsWriter& writer) { add_all(writer, bits, longer); }); },
              "'s/int8' is (1, 3) of 1 bytes, expected (1, 4) of 1");
  ExpectError([&] { read([&](SafetensorsWriter& writer) { add_all(writer, bits, {}); }); }, "no array 's/int16'");
  ExpectError([&] { read([&](SafetensorsWriter& writer) { writer.Add<float>("s/scales", {2}, scales); }); },
              "no array 's/bits'");
}

}  // namespace
}  // namespace daumier::faces

#include "systems/deform/latent_direction.h"

#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::deform {
namespace {

/// Latents z = m + F c with axes that are turned by 3-4-5 and of lengths 2 and 0.5.
class TurnedModel : public testing::FieldModel {
 public:
  TurnedModel() : factor_(Eigen::MatrixXd::Identity(kFields, kFields)) {
    factor_.topLeftCorner(2, 2) << 0.6 * 2, -0.8 * 0.5, 0.8 * 2, 0.6 * 0.5;
  }
  Eigen::VectorXd Latent(const Eigen::VectorXd& code) const override {
    return Eigen::VectorXd::Constant(kFields, 7) + factor_ * code;
  }

 private:
  Eigen::MatrixXd factor_;
};

TEST(LatentDirection, MovesTheNumbersByADeviationAlongIt) {
  const TurnedModel model;
  const Eigen::VectorXd direction = Eigen::VectorXd::Unit(6, 0) * 3;  // Its length does not count.
  const LatentDirection found = LatentDirectionOf(model, direction);
  EXPECT_NEAR(found.deviation, std::hypot(1.2, 0.4), 1e-12);
  const Eigen::VectorXd moved = model.Latent(found.step) - model.Latent(Eigen::VectorXd::Zero(6));
  EXPECT_LT((moved - found.deviation * Eigen::VectorXd::Unit(6, 0)).norm(), 1e-12);
}

TEST(LatentDirection, IsReadFromAFileOfNumPy) {
  const testing::TempDir folder;
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 6), }";
  header.append(117 - header.size(), ' ');
  header += '\n';
  const float numbers[6] = {0, 0, 1, 0, 0, 0};
  const std::string bytes = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header +
                            std::string(reinterpret_cast<const char*>(numbers), sizeof(numbers));
  testing::WriteQuickly(folder / "boundary.npy", bytes);
  const LatentDirection found = ReadLatentDirection(TurnedModel(), folder / "boundary.npy");
  EXPECT_LT((found.step - Eigen::VectorXd::Unit(6, 2)).norm(), 1e-12);
  EXPECT_TRUE(IsDirectionFile("Smile_boundary.npy"));
  EXPECT_FALSE(IsDirectionFile("nose_size"));
}

TEST(LatentDirection, RefusesOtherNumbers) {
  testing::ExpectError([] { LatentDirectionOf(TurnedModel(), Eigen::VectorXd::Ones(5)); },
                       "a direction of 5 numbers, expected 6");
  testing::ExpectError([] { LatentDirectionOf(TurnedModel(), Eigen::VectorXd::Zero(6)); }, "or is 0");
}

}  // namespace
}  // namespace daumier::deform

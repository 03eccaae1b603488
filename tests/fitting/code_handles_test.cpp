#include "fitting/code_handles.h"

#include "tests/support/expect_error.h"
#include "tests/support/field_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::testing {
namespace {

geometry::Points OneMove(double x, double y, double z) {
  geometry::Points move(1, 3);
  move << x, y, z;
  return move;
}

int NoseOf(const FieldModel& model) {
  return model.face_template().annotation.landmarks[30];
}

TEST(CodeHandles, HandlesThatDoNotMoveGiveTheFace) {
  const FieldModel model(0.2);
  const Eigen::VectorXd code = Eigen::VectorXd::Constant(FieldModel::kFields, 0.3);
  const fitting::HandleEdit edit = fitting::EditByHandles(model, code, {NoseOf(model)}, OneMove(0, 0, 0));
  EXPECT_EQ(edit.code, code);
}

/// With one number that moves the handle, E = c^2 + (a c - d)^2 / s^2 has its minimum at c = a d / (a^2 + s^2).
TEST(CodeHandles, SoftHandleIsTheRidgeSolution) {
  const FieldModel model;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(FieldModel::kFields);
  const int nose = NoseOf(model);
  const std::vector<int> points = {nose};
  const Eigen::MatrixXd a = model.Derivative(zero, points);
  const Eigen::Vector3d d(0, 0, 1);
  const double s = 0.4;
  const fitting::HandleEdit edit = fitting::EditByHandles(model, zero, {nose}, OneMove(0, 0, 1), {.deviation_cm = s});
  const Eigen::VectorXd exact =
      (a.transpose() * a + s * s * Eigen::MatrixXd::Identity(a.cols(), a.cols())).ldlt().solve(a.transpose() * d);
  EXPECT_LT((edit.code - exact).norm(), 1e-6);
}

TEST(CodeHandles, HeldHandlesReachTheirTargetsAtEverySize) {
  for (const double bend : {0.0, 0.2}) {
    const FieldModel model(bend);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(FieldModel::kFields);
    for (const double size : {1e-3, 0.02, 0.2, 1.0, 2.0}) {
      const fitting::HandleEdit edit = fitting::EditByHandles(model, zero, {NoseOf(model)}, OneMove(0, 0, size));
      EXPECT_LE(edit.residual_share, fitting::kHeldShare) << bend << " " << size;
      for (size_t i = 1; i < edit.energies.size(); ++i) EXPECT_LT(edit.energies[i], edit.energies[i - 1]);
    }
  }
}

TEST(CodeHandles, ADragGivesWhatOneMoveGives) {
  const FieldModel model(0.1);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(FieldModel::kFields);
  fitting::HandleEditor editor(model, zero, {NoseOf(model)}, {.deviation_cm = 0.1});
  for (const double part : {0.25, 0.5, 0.75}) editor.MoveBy(OneMove(0, 0, part));
  const fitting::HandleEdit last = editor.MoveBy(OneMove(0, 0, 1));
  const fitting::HandleEdit direct =
      fitting::EditByHandles(model, zero, {NoseOf(model)}, OneMove(0, 0, 1), {.deviation_cm = 0.1});
  EXPECT_LT((last.code - direct.code).norm(), 1e-3);
}

TEST(CodeHandles, LocalEditsLeaveTheOutside) {
  const FieldModel model;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(FieldModel::kFields);
  std::vector<int> outside;  // The back of the head.
  for (int v = 0; v < model.face_template().num_vertices(); ++v)
    if (model.face_template().neutral(v, 2) < 0) outside.push_back(v);
  const auto share_of = [&](std::vector<int> held) {
    const fitting::HandleEdit edit =
        fitting::EditByHandles(model, zero, {NoseOf(model)}, OneMove(0, 0, 1), {.outside = std::move(held)});
    EXPECT_LE(edit.residual_share, fitting::kHeldShare);
    double sum = 0;
    const geometry::Points moved = model.Vertices(edit.code);
    for (const int v : outside) sum += (moved.row(v) - model.face_template().neutral.row(v)).norm();
    return sum / double(outside.size());
  };
  const double free = share_of({}), local = share_of(outside);
  EXPECT_GT(free, 0.08);
  EXPECT_LE(local, 0.08 + 0.01);
}

TEST(CodeHandles, FixedNumbersKeepTheirValues) {
  const FieldModel model(0.1);
  const Eigen::VectorXd code = Eigen::VectorXd::Constant(FieldModel::kFields, 0.4);
  const fitting::HandleEdit edit =
      fitting::EditByHandles(model, code, {NoseOf(model)}, OneMove(0, 0, 0.5), {.fixed = {3, 5}});
  EXPECT_NEAR(edit.code[3], 0.4, 1e-12);
  EXPECT_NEAR(edit.code[5], 0.4, 1e-12);
  EXPECT_GT(edit.code[2], 0.5);
  EXPECT_LE(edit.residual_share, fitting::kHeldShare);
  ExpectError([&] { fitting::HandleEditor(model, code, {5}, {.fixed = {6}}); }, "no number 6");
}

TEST(CodeHandles, ReportsFacesUnlikeTheModelsOwn) {
  const FieldModel model;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(FieldModel::kFields);
  EXPECT_TRUE(fitting::EditByHandles(model, zero, {NoseOf(model)}, OneMove(0, 0, 0.5)).is_usual);
  EXPECT_FALSE(fitting::EditByHandles(model, zero, {NoseOf(model)}, OneMove(0, 0, 30)).is_usual);
}

TEST(CodeHandles, RefusesHandlesThatAreNone) {
  const FieldModel model;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(FieldModel::kFields);
  ExpectError([&] { fitting::HandleEditor(model, zero, {}); }, "no handle");
  ExpectError([&] { fitting::HandleEditor(model, zero, {100000}); }, "does not exist");
  ExpectError([&] { fitting::HandleEditor(model, zero, {5, 5}); }, "two handles");
  ExpectError([&] { fitting::HandleEditor(model, Eigen::VectorXd::Zero(2), {5}); }, "a code of 2 numbers");
  ExpectError([&] { fitting::HandleEditor(model, zero, {5}).MoveTo(OneMove(NAN, 0, 0)); }, "not finite");
}

}  // namespace
}  // namespace daumier::testing

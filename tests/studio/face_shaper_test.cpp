#include "studio/face_shaper.h"

#include "faces/face_model_file.h"
#include "rig/arkit_names.h"
#include "studio/api.h"
#include "tests/studio/shipped_studio.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

namespace daumier::studio {
namespace {

using testing::ExpectError;

/// With the shipped weights; opened once.
class FaceShaperTest : public ::testing::Test {
 protected:
  static FaceShaper& Shaper() { return testing::ShippedShaper(); }
  static const geometry::Points& Mean() { return Shaper().face_template().neutral; }
  /// The pinned face of these tests, and no other.
  static geometry::Points Named(const std::string& name) {
    if (name == "f-0001") return Other();
    if (name == "f-0002") return Mean().topRows(5);
    throw NotFound("there is no '" + name + "'");
  }
  static geometry::Points Make(const ShapeDocument& shape) { return Shaper().Make(shape, Named); }
  static const geometry::Points& Other() {
    static const geometry::Points other =
        Shaper().Make({.controls = Shaper().RandomControls(3, 0.5)}, [](const std::string&) { return Mean(); });
    return other;
  }
  static double Largest(const geometry::Points& move) { return move.rowwise().norm().maxCoeff(); }
  static int Landmark(size_t landmark) { return Shaper().face_template().annotation.landmarks[landmark]; }
};

TEST_F(FaceShaperTest, AnEmptyDocumentIsTheMeanFace) {
  EXPECT_EQ(Make({}), Mean());
}

TEST_F(FaceShaperTest, TheBaseIsANamedFace) {
  ASSERT_GT(Largest(Other() - Mean()), 0.1);
  EXPECT_EQ(Make({.base = "f-0001"}), Other());
  ExpectError([] { Make({.base = "f-0009"}); }, "there is no 'f-0009'");
  EXPECT_THROW(Make({.base = "f-0009"}), NotFound);
  ExpectError([] { Make({.base = "f-0002"}); }, "'f-0002' is a face of another topology");
  ExpectError([] { Make({.toward = ShapeDocument::Toward{"f-0002", 0.5}}); }, "another topology");
}

TEST_F(FaceShaperTest, TowardMixesVertexByVertex) {
  const auto toward = [](double share) { return Make({.toward = ShapeDocument::Toward{"f-0001", share}}); };
  EXPECT_EQ(toward(0), Mean());
  EXPECT_LT(Largest(toward(1) - Other()), 1e-9);
  EXPECT_LT(Largest(toward(0.25) - (0.75 * Mean() + 0.25 * Other())), 1e-9);
  EXPECT_LT(Largest(Make({.base = "f-0001", .toward = ShapeDocument::Toward{"mean", 1}}) - Mean()), 1e-9);
}

TEST_F(FaceShaperTest, ControlsMoveTheFace) {
  const std::map<std::string, double> controls = Shaper().RandomControls(5, 0.5);
  std::map<std::string, double> zeros = controls;
  for (auto& [name, value] : zeros) value = 0;
  EXPECT_EQ(Make({.controls = zeros}), Mean());
  EXPECT_GT(Largest(Make({.controls = controls}) - Mean()), 0.1);
  EXPECT_TRUE(Make({.controls = controls}).allFinite());
}

TEST_F(FaceShaperTest, CaricatureAndExaggerationMoveTheFaceAndAre0AtFirst) {
  const geometry::Points caricature = Make({.base = "f-0001", .caricature = 1}),
                         exaggerated = Make({.base = "f-0001", .exaggeration = 0.2});
  for (const geometry::Points& face : {caricature, exaggerated}) {
    EXPECT_TRUE(face.allFinite());
    EXPECT_GT(Largest(face - Other()), 0.05);
  }
  EXPECT_EQ(Make({.base = "f-0001", .exaggeration = 0, .caricature = 0}), Other());
}

TEST_F(FaceShaperTest, UnknownNamesSuggestTheNearest) {
  const std::string known = Shaper().RandomControls(1, 1).begin()->first;
  const std::string wrong = known.substr(0, known.size() - 1) + "x";
  const auto refused = [](const ShapeDocument& shape, const std::string& why) {
    ExpectError([&] { Make(shape); }, why);
    EXPECT_THROW(Make(shape), UsageError) << why;
  };
  refused({.controls = {{wrong, 1}}}, "there is no control '" + wrong + "'; did you mean '");
  refused({.controls = {{"qwertyuiopasdfgh", 1}}}, "there is no control 'qwertyuiopasdfgh'");
  refused({.expressions = {{"jawOpn", 1}}}, "there is no expression 'jawOpn'; did you mean 'jawOpen'?");
  refused({.gains = {{"mouthSmileLfet", 1}}}, "did you mean 'mouthSmileLeft'?");
  refused({.handles = {{-1, {0, 0, 1}}}}, "the handle -1 is no vertex");
  refused({.handles = {{int(Mean().rows()), {0, 0, 1}}}}, "is no vertex of the face");
  refused({.handles = {{5, {0, 0, 1}}, {5, {0, 1, 0}}}}, "the handle 5 is no vertex of the face, or comes twice");
  EXPECT_EQ(Make({}), Mean()) << "an error changes nothing";
}

TEST_F(FaceShaperTest, HandlesAreHeldAndOtherPartsStay) {
  constexpr size_t kNoseTip = 30, kChin = 8, kBrow = 19;
  const geometry::Vector3 move(0, 0.2, 0.5);
  const geometry::Points moved = Make({.handles = {{Landmark(kNoseTip), move}}}) - Mean();
  EXPECT_LE((moved.row(Landmark(kNoseTip)).transpose() - move).norm(), 0.05 * move.norm());
  for (const size_t landmark : {kChin, kBrow})
    EXPECT_LT(moved.row(Landmark(landmark)).norm(), 0.2 * move.norm()) << landmark;
  const geometry::Points based = Make({.base = "f-0001", .handles = {{Landmark(kNoseTip), move}}}) - Other();
  EXPECT_LE((based.row(Landmark(kNoseTip)).transpose() - move).norm(), 0.05 * move.norm()) << "of another face, too";
  EXPECT_LT(Largest(Make({.handles = {{Landmark(kNoseTip), {0, 0, 0}}}}) - Mean()), 1e-6);
}

TEST_F(FaceShaperTest, ExpressionsAreLinearOnTheTargetsOfTheFace) {
  const auto with = [](std::map<std::string, double> expressions, std::map<std::string, double> gains = {}) {
    return Make({.base = "f-0001", .expressions = std::move(expressions), .gains = std::move(gains)});
  };
  constexpr double kRounding = 1e-5;  // Targets are float, cm.
  const geometry::Points open = with({{"jawOpen", 1}}) - Other(), smile = with({{"mouthSmileLeft", 1}}) - Other();
  EXPECT_GT(Largest(open), 0.5);
  EXPECT_LT(Largest(with({{"jawOpen", 0.5}}) - Other() - 0.5 * open), kRounding);
  EXPECT_LT(Largest(with({{"jawOpen", -1}}) - Other() + open), kRounding);
  EXPECT_LT(Largest(with({{"jawOpen", 2}, {"mouthSmileLeft", 0.25}}) - Other() - 2 * open - 0.25 * smile), kRounding);
  EXPECT_EQ(with({{"jawOpen", 0.5}}, {{"jawOpen", 2}}), with({{"jawOpen", 1}})) << "a gain multiplies";
  EXPECT_EQ(with({{"jawOpen", 1}}, {{"jawOpen", 0}}), Other());
  EXPECT_EQ(with({}, {{"jawOpen", 3}}), Other()) << "a gain of nothing";
  const rig::MorphTargets targets =
      rig::ExpressionTargets(faces::ReadFaceModelWeights(testing::ShippedFolder("face-ict"))).On(Other());
  const Eigen::VectorXf column = targets.offsets.col(*rig::FindArkitName("jawOpen"));
  for (Eigen::Index v = 0; v < Other().rows(); ++v)
    for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(open(v, axis), column[3 * v + axis], kRounding) << v;
}

TEST_F(FaceShaperTest, TheOrderOfDocumentsChangesNoByte) {
  const ShapeDocument neutral{.controls = Shaper().RandomControls(7, 0.4)};
  ShapeDocument smiling = neutral, other = neutral;
  smiling.expressions = {{"mouthSmileLeft", 0.7}};
  other.controls.begin()->second += 0.5;
  const geometry::Points first_neutral = Make(neutral), first_smiling = Make(smiling);
  Make(other);
  EXPECT_EQ(Make(smiling), first_smiling) << "before its neutral face";
  EXPECT_EQ(Make(neutral), first_neutral);
  EXPECT_EQ(Make(smiling), first_smiling);
}

TEST_F(FaceShaperTest, ExpressionsThatComeLaterAreMadeLater) {
  const auto controls = Shaper().RandomControls(9, 0.4);
  const auto with = [&](const std::map<std::string, double>& expressions) {
    return Make({.controls = controls, .expressions = expressions});
  };
  Make({});  // Targets of another face.
  const geometry::Points both = with({{"jawOpen", 0.5}, {"mouthSmileLeft", 0.7}});
  Make({});
  const geometry::Points open = with({{"jawOpen", 0.5}}), smile = with({{"mouthSmileLeft", 0.7}});
  EXPECT_EQ(with({{"jawOpen", 0.5}, {"mouthSmileLeft", 0.7}}), both) << "one after the other or at once";
  EXPECT_EQ(with({{"jawOpen", 0.5}}), open);
  EXPECT_NE(smile, open);
}

TEST_F(FaceShaperTest, ExaggerationIsThatOfTheFaceWhateverCameBefore) {
  const faces::ExaggerationOptions options{.gammas = {0.1, 0.3}};
  const std::vector<geometry::Points> expected = faces::Exaggerate(Shaper().face_template(), Other(), options);
  EXPECT_EQ(Make({.base = "f-0001", .exaggeration = 0.1}), expected[0]);
  EXPECT_EQ(Make({.base = "f-0001", .exaggeration = 0.3}), expected[1]) << "by the factor of the last one";
  EXPECT_EQ(Make({.exaggeration = 0.3}),
            faces::Exaggerate(Shaper().face_template(), Mean(), {.gammas = {0.3}}).front());
  EXPECT_EQ(Make({.base = "f-0001", .exaggeration = 0.1}), expected[0]);
}

TEST_F(FaceShaperTest, AFaceThatChangedUnderItsNameIsUsed) {
  geometry::Points face = Mean();
  const NamedFace named = [&](const std::string&) { return face; };
  EXPECT_EQ(Shaper().Make({.base = "s-0001"}, named), Mean());
  face *= 1.1;
  EXPECT_EQ(Shaper().Make({.base = "s-0001"}, named), face) << "the drawing has changed";
  face = Other();
  EXPECT_LT(Largest(Shaper().Make({.toward = ShapeDocument::Toward{"s-0001", 1}}, named) - Other()), 1e-9);
}

TEST_F(FaceShaperTest, DescribesControlsAndExpressions) {
  const Json description = Shaper().Description();
  std::set<std::string> values;
  for (const Json& control : description["controls"]) {
    const std::string name = control["name"];
    EXPECT_EQ(control["least"], -3);
    EXPECT_EQ(control["greatest"], 3);
    EXPECT_FALSE(control["title"].get<std::string>().empty());
    EXPECT_FALSE(control["group"].get<std::string>().empty());
    ASSERT_TRUE(control["sides"] == 1 || control["sides"] == 2);
    if (control["sides"] == 1) values.insert(name);
    if (control["sides"] == 2) values.insert({name + "_left", name + "_right"});
  }
  ShapeDocument all;
  for (const std::string& name : values) all.controls[name] = 0;
  EXPECT_EQ(Make(all), Mean()) << "each of them is the name of a value";
  ASSERT_EQ(description["expressions"].size(), size_t(rig::kNumArkitNames));
  std::multiset<std::string> grouped, listed(description["expressions"].begin(), description["expressions"].end());
  for (const auto& [group, names] : description["expression_groups"].items())
    grouped.insert(names.begin(), names.end());
  EXPECT_EQ(grouped, listed) << "each is in one group";
  EXPECT_EQ(description["caricature"], (Json{0, kMostCaricature}));
  EXPECT_EQ(description["exaggeration"], (Json{0, kMostExaggeration}));
}

TEST_F(FaceShaperTest, RandomControlsAreSymmetricAndLimited) {
  const auto values = Shaper().RandomControls(1, 0.5);
  EXPECT_EQ(Shaper().RandomControls(1, 0.5), values);
  EXPECT_NE(Shaper().RandomControls(2, 0.5), values);
  for (const auto& [name, value] : Shaper().RandomControls(1, 0)) EXPECT_EQ(value, 0) << name;
  double largest = 0, squares = 0;
  for (const auto& [name, value] : Shaper().RandomControls(1, 50)) largest = std::max(largest, std::abs(value));
  EXPECT_EQ(largest, 3);
  for (const auto& [name, value] : values) {
    squares += value * value;
    EXPECT_EQ(Shaper().RandomControls(1, 0.25).at(name), value / 2) << "a spread is a factor";
    if (!name.ends_with("_left")) continue;
    EXPECT_EQ(values.at(name.substr(0, name.size() - 5) + "_right"), value) << name;
  }
  EXPECT_NEAR(std::sqrt(squares / double(values.size())), 0.5, 0.2);
  const faces::FaceControls controls(Shaper().face_template());
  for (const faces::FaceControls::Entry& entry : controls.entries()) {
    const bool is_sideways = entry.control.sides == faces::FaceControl::Sides::kSideways;
    const bool is_there = values.contains(controls.value_names()[size_t(entry.first_value)]);
    EXPECT_EQ(is_there, !is_sideways) << entry.control.name;
  }
}

TEST_F(FaceShaperTest, IsUsedFromSeveralThreads) {
  std::vector<ShapeDocument> shapes;
  std::vector<geometry::Points> expected;
  for (uint64_t seed = 0; seed < 4; ++seed) {
    shapes.push_back({.controls = Shaper().RandomControls(seed, 0.5)});
    expected.push_back(Make(shapes.back()));
  }
  std::vector<std::jthread> threads;
  for (size_t thread = 0; thread < 4; ++thread)
    threads.emplace_back([&, thread] {
      for (size_t i = 0; i < 4; ++i) EXPECT_EQ(Make(shapes[(thread + i) % 4]), expected[(thread + i) % 4]);
    });
}

}  // namespace
}  // namespace daumier::studio

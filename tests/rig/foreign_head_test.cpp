#include "rig/foreign_head.h"

#include "faces/face_model_file.h"
#include "geometry/topology.h"
#include "rig/arkit_names.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"
#include "tests/support/other_topology.h"
#include "tests/support/paths.h"
#include "tests/support/sealed_slit.h"
#include "tests/support/sides_apart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

using ::testing::HasSubstr;

/// Heads made of the shipped model's mean face with other vertices: what is right is known.
class ForeignHeads : public ::testing::Test {
 protected:
  static const faces::FaceModel& Model() {
    static const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
    return model;
  }
  static const faces::FaceTemplate& Face() { return Model().face_template; }
  static const ForeignRig& Rig() {
    static const ForeignRig rig(Model());
    return rig;
  }
  static const MorphTargets& Truth() {
    static const MorphTargets targets = ExpressionTargets(Model()).On(Face().neutral);
    return targets;
  }
  static const std::vector<FaceSide>& Sides() {
    static const std::vector<FaceSide> sides = [] {
      const geometry::TriangleMesh surface{Face().neutral, Face().triangles};
      const FaceSlits slits = SlitsOf(ExpressionTargets(Model()).contact());
      return testing::SidesApart(surface, slits, SidesOfTemplate(surface, slits));
    }();
    return sides;
  }

  /// With a strip from edge to edge of each slit.
  static geometry::TriangleMesh Sealed() {
    geometry::TriangleMesh mesh{Face().neutral, Face().triangles};
    for (const SeamEdges& edges : SlitsOf(ExpressionTargets(Model()).contact())) testing::Seal(edges, mesh);
    return mesh;
  }

  static ForeignHead On(const geometry::TriangleMesh& mesh) { return Rig().On(mesh, {Face().neutral, {}}); }
  static ForeignHead On(const testing::OtherTopology& other) {
    return On({other.Vertices(Face().neutral), other.triangles});
  }

  /// Vertices whose place is on one side of a slit and that were taken for the other.
  static int NumWrong(const testing::OtherTopology& other, const ForeignHead& head) {
    int num_wrong = 0;
    for (size_t v = 0; v < other.sources.size(); ++v) {
      const FaceSide a = Sides()[size_t(other.sources[v].first)], b = Sides()[size_t(other.sources[v].second)];
      num_wrong += a == b && a != FaceSide::kNone && head.sides[v] == OppositeSide(a) ? 1 : 0;
    }
    return num_wrong;
  }
  /// Greatest distance of a target from the truth, cm.
  static float GreatestError(const testing::OtherTopology& other, const ForeignHead& head, std::string_view target) {
    const auto truth = Truth().offsets.col(*FindArkitName(target)),
               carried = head.head.targets.offsets.col(*FindArkitName(target));
    float greatest = 0;
    for (size_t v = 0; v < other.sources.size(); ++v) {
      const auto [a, b] = other.sources[v];
      const Eigen::Vector3f expected = 0.5f * (truth.segment<3>(3 * a) + truth.segment<3>(3 * b));
      greatest = std::max(greatest, (carried.segment<3>(3 * Eigen::Index(v)) - expected).norm());
    }
    return greatest;
  }
};

TEST_F(ForeignHeads, KeepTheirVerticesAndTheirOrder) {
  Rng rng(1);
  const auto other = testing::ShuffledTopology(Face().triangles, Face().num_vertices(), rng);
  const ForeignHead head = On(other);
  EXPECT_EQ(head.head.mesh.vertices, other.Vertices(Face().neutral));
  EXPECT_EQ(head.head.mesh.triangles, other.triangles);
  EXPECT_TRUE(std::ranges::equal(head.head.targets.names, ArkitNames()));
  EXPECT_TRUE(head.head.eyes.empty());
}

TEST_F(ForeignHeads, TakeNoPlaceForTheOtherSideOfASlit) {
  Rng rng(2);
  const geometry::TriangleMesh neutral{Face().neutral, Face().triangles};
  const int num_vertices = Face().num_vertices();
  for (const auto& other :
       {testing::ShuffledTopology(Face().triangles, num_vertices, rng),
        testing::SubdividedTopology(Face().triangles, num_vertices), testing::DecimatedTopology(neutral, 0.3, rng)}) {
    const ForeignHead head = On(other);
    EXPECT_EQ(NumWrong(other, head), 0) << other.sources.size() << " vertices";
    for (const HeadSlit& slit : head.slits.slits) {
      EXPECT_TRUE(slit.is_found);
      EXPECT_FALSE(slit.is_sealed);
    }
  }
}

TEST_F(ForeignHeads, MoveAsTheTemplateDoes) {
  Rng rng(3);
  const auto shuffled = testing::ShuffledTopology(Face().triangles, Face().num_vertices(), rng);
  const ForeignHead head = On(shuffled);
  for (const char* target : {"jawOpen", "eyeBlinkLeft", "mouthSmileRight", "browInnerUp"})
    EXPECT_LT(GreatestError(shuffled, head, target), 0.02f) << target;
}

TEST_F(ForeignHeads, AreRiggedInTheirOwnFrame) {
  Rng rng(4);
  const auto other = testing::DecimatedTopology({Face().neutral, Face().triangles}, 0.5, rng);
  const geometry::Points vertices = other.Vertices(Face().neutral);
  const ForeignHead plain = On({vertices, other.triangles});
  geometry::Similarity away;
  away.scale = 2;
  away.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  away.translation = {5, -3, 1};
  geometry::Similarity back;
  back.scale = 1 / away.scale;
  back.rotation = away.rotation.transpose();
  back.translation = -back.scale * (back.rotation * away.translation);
  const ForeignHead moved = Rig().On({away.Apply(vertices), other.triangles}, {Face().neutral, back});
  const Eigen::Index jaw = *FindArkitName("jawOpen");
  const Eigen::Matrix3f linear = (away.scale * away.rotation).cast<float>();
  float greatest = 0;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    greatest = std::max(greatest, (moved.head.targets.offsets.col(jaw).segment<3>(3 * v) -
                                   linear * plain.head.targets.offsets.col(jaw).segment<3>(3 * v))
                                      .norm());
  EXPECT_LT(greatest, 1e-3f);
}

TEST_F(ForeignHeads, ThatAreSealedAreSaidToBe) {
  const geometry::TriangleMesh mesh = Sealed();
  const ForeignHead head = On(mesh);
  for (const HeadSlit& slit : head.slits.slits) EXPECT_TRUE(slit.is_sealed) << slit.way << " cm, gap " << slit.gap;
  EXPECT_THAT(head.warnings, ::testing::Contains(HasSubstr("the lips are sealed")));
  EXPECT_THAT(head.warnings, ::testing::Contains(HasSubstr("the left eye is sealed")));
}

TEST_F(ForeignHeads, ThatAreSealedAreCutAndOpen) {
  const geometry::TriangleMesh mesh = Sealed();
  const OpenedHead opened = Rig().Open(mesh, {Face().neutral, {}});
  EXPECT_EQ(opened.slits, (std::array{SlitCut::kCut, SlitCut::kOpenEye, SlitCut::kOpenEye}));
  const Eigen::Index num_own = mesh.vertices.rows();
  EXPECT_EQ(opened.mesh.vertices.topRows(num_own), mesh.vertices) << "vertices keep their numbers and places";
  EXPECT_GT(opened.lengths[0], 4.0);
  EXPECT_LT(opened.lengths[0], 7.0);
  const ForeignHead head = On(opened.mesh), sealed = On(mesh);
  EXPECT_FALSE(head.slits.slits[0].is_sealed) << head.slits.slits[0].way;
  const Eigen::Index jaw = *FindArkitName("jawOpen");
  const auto moves = head.head.targets.offsets.col(jaw);
  // The two vertices of each place of the cut in the middle of the mouth; the one above lies kCutGap higher.
  int num_places = 0;
  const Eigen::Index end = num_own + opened.num_cut_vertices;
  for (Eigen::Index below = num_own; below < end; ++below) {
    for (Eigen::Index above = num_own; above < end; ++above) {
      const Eigen::RowVector3d apart = opened.mesh.vertices.row(above) - opened.mesh.vertices.row(below);
      if (apart.norm() > 1.5 * kCutGap || apart.y() < 0.5 * kCutGap || std::abs(opened.mesh.vertices(above, 0)) > 0.2)
        continue;
      EXPECT_GT(moves[3 * above + 1], moves[3 * below + 1] + 0.8f) << opened.mesh.vertices.row(above);
      ++num_places;
    }
  }
  EXPECT_GE(num_places, 3);
  const Eigen::Index brow = 3 * Face().annotation.landmarks[19];
  EXPECT_LT((moves.segment<3>(brow) - sealed.head.targets.offsets.col(jaw).segment<3>(brow)).norm(), 1e-3f);
}

/// Adds a part that no edge connects with the rest.
void AddPart(const geometry::TriangleMesh& part, geometry::TriangleMesh& mesh) {
  const int num_vertices = int(mesh.vertices.rows());
  mesh.vertices.conservativeResize(num_vertices + part.vertices.rows(), 3);
  mesh.vertices.bottomRows(part.vertices.rows()) = part.vertices;
  mesh.triangles.conservativeResize(mesh.triangles.rows() + part.triangles.rows(), 3);
  mesh.triangles.bottomRows(part.triangles.rows()) = part.triangles.array() + num_vertices;
}

TEST_F(ForeignHeads, TurnTheirBallsAndMoveTheirLowerTeethWithTheJaw) {
  geometry::TriangleMesh mesh{Face().neutral, Face().triangles};
  const int num_skin = int(mesh.vertices.rows());
  const auto add_ball = [&](const geometry::Vector3& centre, double radius) {
    geometry::TriangleMesh ball = testing::UvBall(radius, 12, 16);
    ball.vertices.rowwise() += centre.transpose();
    AddPart(ball, mesh);
  };
  const std::vector<faces::Eyeball> eyeballs = HeadRig(Face()).Eyeballs(Face().neutral);
  for (const faces::Eyeball& eyeball : eyeballs) add_ball(eyeball.centre, 0.95 * eyeball.radii.x());
  const geometry::Points lips =
      Face().neutral({Face().annotation.landmarks[60], Face().annotation.landmarks[64]}, Eigen::all);
  const geometry::Vector3 mouth = lips.colwise().mean();
  add_ball(mouth + geometry::Vector3(0, 0.8, -2.5), 0.6);
  add_ball(mouth + geometry::Vector3(0, -0.8, -2.5), 0.6);
  const ForeignHead head = On(mesh);
  ASSERT_EQ(head.head.eyes.size(), 2u);
  for (size_t side = 0; side < 2; ++side) {
    EXPECT_LT((head.head.eyes[side].centre - eyeballs[side].centre).norm(), 0.02);
    EXPECT_NEAR(head.head.eyes[side].mesh.vertices.rowwise().norm().maxCoeff(), 0.95 * eyeballs[side].radii.x(), 1e-6);
  }
  EXPECT_EQ(head.head.mesh.triangles.rows() + 2 * head.head.eyes[0].mesh.triangles.rows(), mesh.triangles.rows());
  const int per_ball = (int(mesh.vertices.rows()) - num_skin) / 4;
  const auto jaw = head.head.targets.offsets.col(*FindArkitName("jawOpen"));
  const auto moves = [&](int ball) { return jaw.segment(3 * (num_skin + ball * per_ball), 3 * per_ball); };
  EXPECT_TRUE(moves(2).isZero(0)) << "upper teeth";
  EXPECT_LT(moves(3)[1], -0.3f) << "lower teeth";
  // As one piece: distances within it stay.
  const geometry::Points rest = mesh.vertices.bottomRows(per_ball);
  const Eigen::VectorXf moved = moves(3);
  const geometry::Points now =
      rest + Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(moved.data(), per_ball, 3)
                 .cast<double>();
  EXPECT_NEAR((now.row(0) - now.row(per_ball - 1)).norm(), (rest.row(0) - rest.row(per_ball - 1)).norm(), 1e-5);
}

TEST_F(ForeignHeads, MayHaveABody) {
  geometry::TriangleMesh mesh{Face().neutral, Face().triangles};
  const int num_face = int(mesh.vertices.rows()), num_body = 3 * num_face;
  // A long narrow strip down from the neck, and a patch of its own before the forehead.
  mesh.vertices.conservativeResize(num_face + num_body + 3, 3);
  const int neck = Face().annotation.regions.at("neck_border").front();
  for (int i = 0; i < num_body; ++i)
    mesh.vertices.row(num_face + i) = mesh.vertices.row(neck) + Eigen::RowVector3d(0.1 * (i % 2), -5 - 0.005 * i, 0);
  mesh.triangles.conservativeResize(mesh.triangles.rows() + num_body - 1, 3);
  mesh.triangles.bottomRows(num_body - 1).row(0) << neck, num_face, num_face + 1;
  for (int i = 0; i + 2 < num_body; ++i)
    mesh.triangles.row(mesh.triangles.rows() - num_body + 2 + i) << num_face + i, num_face + i + 1, num_face + i + 2;
  const Eigen::RowVector3d brow = Face().neutral.row(Face().annotation.landmarks[19]);
  mesh.vertices.bottomRows(3) << brow + Eigen::RowVector3d(0, 0, 0.05), brow + Eigen::RowVector3d(0.1, 0, 0.05),
      brow + Eigen::RowVector3d(0, 0.1, 0.05);
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1) << num_face + num_body, num_face + num_body + 1, num_face + num_body + 2;
  const ForeignHead head = On(mesh);
  const Eigen::Index jaw = *FindArkitName("jawOpen");
  const Eigen::Index chin = 3 * Face().annotation.landmarks[8];
  EXPECT_LT((head.head.targets.offsets.col(jaw).segment<3>(chin) - Truth().offsets.col(jaw).segment<3>(chin)).norm(),
            0.02f);
  EXPECT_TRUE(head.head.targets.offsets.col(jaw).segment(3 * (num_face + num_body - 50), 150).isZero(1e-4f));
}

TEST_F(ForeignHeads, ThatAreNowhereNearTheTemplateAreRefused) {
  testing::ExpectError(
      [&] {
        On(geometry::TriangleMesh{Face().neutral.array() + 500.0, Face().triangles});
      },
      "no part of the head lies on the registered face");
}

}  // namespace
}  // namespace daumier::rig

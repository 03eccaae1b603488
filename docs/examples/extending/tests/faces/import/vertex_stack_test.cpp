#include "faces/import/vertex_stack.h"

#include "tests/faces/import/foreign_face.h"
#include "tests/faces/import/foreign_files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

/// template.obj, and faces.npy of the shape with two faces: the template, and the template 10 % higher.
void WriteStack(const std::filesystem::path& folder, const std::string& shape) {
  testing::WriteForeignObj(folder / "template.obj", testing::ForeignMesh());
  std::vector<double> numbers;
  for (const double k : {0, 10}) {
    const geometry::Points points = testing::ForeignMesh(k).vertices;
    numbers.insert(numbers.end(), points.data(), points.data() + points.size());
  }
  WriteFileAtomically(folder / "faces.npy", testing::Npy("<f8", shape, testing::BytesOf(numbers)));
}

TEST(VertexStack, GivesItsFacesAndTheirMeanIsTheTemplate) {
  const testing::TempDir folder;
  const auto num_vertices = testing::ForeignMesh().vertices.rows();
  WriteStack(folder.path(), fmt::format("2, {}, 3", num_vertices));
  const GivenFaces given = LoadVertexStack(folder.path(), testing::ForeignAnnotation(), "CC0");
  EXPECT_EQ(given.names, (std::vector<std::string>{"0", "1"}));
  const geometry::Points low = given.face(0, 0), high = given.face(1, 0);
  EXPECT_LT((high.col(1) - 1.1 * low.col(1)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((given.face_template.neutral - 0.5 * (low + high)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(given.face_template.provenance.at("licence"), "CC0");
}

TEST(VertexStack, NamesTheFileOfAnotherShape) {
  const testing::TempDir folder;
  const auto num_vertices = testing::ForeignMesh().vertices.rows();
  WriteStack(folder.path(), fmt::format("1, {}, 3", 2 * num_vertices));
  testing::ExpectError(
      [&] { LoadVertexStack(folder.path(), testing::ForeignAnnotation(), ""); },
      fmt::format("faces.npy: has shape (1, {}, 3) (expected (N, {}, 3)", 2 * num_vertices, num_vertices));
}

}  // namespace
}  // namespace daumier::faces

#include "faces/import/mesh_folder.h"

#include "core/log.h"
#include "geometry/nearest.h"
#include "geometry/ply.h"
#include "tests/faces/import/foreign_face.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <fstream>
#include <future>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::ForeignMesh;
using testing::TempDir;
using testing::WriteForeignObj;

TEST(MeshFolder, TakesObjFilesBelowTheFolderInOrderOfName) {
  const TempDir folder;
  WriteForeignObj(folder / "b.obj", ForeignMesh(4));
  WriteForeignObj(folder / "a/2.OBJ", ForeignMesh(2));
  WriteForeignObj(folder / "a/1.obj", ForeignMesh(0));
  WriteFileAtomically(folder / "note.txt", "no mesh");
  const GivenFaces given = LoadMeshFolder(folder.path(), testing::ForeignAnnotation(), PersonOf::kFile, "CC0");
  EXPECT_EQ(given.names, (std::vector<std::string>{"a/1", "a/2", "b"}));
  EXPECT_EQ(given.groups, given.names);
  EXPECT_EQ(given.expressions, std::vector<std::string>{"neutral"});
  EXPECT_LT((given.face(2, 0) - ForeignMesh(4).vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((given.face_template.neutral - ForeignMesh(2).vertices).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(given.face_template.source, "meshes");
  EXPECT_EQ(given.face_template.provenance.at("licence"), "CC0");
}

TEST(MeshFolder, FilesOfMacOsAreSkipped) {
  const TempDir folder;
  WriteForeignObj(folder / "a.obj", ForeignMesh());
  for (const char* path : {"._a.obj", "b/._b.ply", "__MACOSX/._a.obj", ".DS_Store"}) {
    MakeDirectory((folder / path).parent_path());
    WriteFileAtomically(folder / path, std::string("\0\5\x16\7", 4));
  }
  const GivenFaces given = LoadMeshFolder(folder.path(), testing::ForeignAnnotation(), PersonOf::kFile, "");
  EXPECT_EQ(given.names, std::vector<std::string>{"a"});
}

// A topology has to be whole: what is skipped in a mesh that is drawn is refused here.
TEST(MeshFolder, FlawsOfAMeshAreRefused) {
  testing::AllowWarnings();
  const TempDir folder;
  WriteForeignObj(folder / "a.obj", ForeignMesh());
  const std::string text = ReadFile(folder / "a.obj");
  const auto load = [&] { LoadMeshFolder(folder.path(), testing::ForeignAnnotation(), PersonOf::kFile, ""); };
  WriteFileAtomically(folder / "b.obj", "v nan 0 0" + text.substr(text.find('\n')));
  ExpectError(load, "b.obj: the position of vertex 0 (counted from 0) is not finite");
  const size_t last = text.rfind("f ");
  WriteFileAtomically(folder / "b.obj", text.substr(0, last) + "f 1 1 2\n");
  ExpectError(load, "b.obj has ");
}

TEST(ReadMesh, NamesWhatIsNoMesh) {
  const TempDir folder;
  const auto refuses = [&](const char* name, std::string_view bytes, const std::string& part) {
    WriteFileAtomically(folder / name, bytes);
    ExpectError([&] { ReadMesh(folder / name); }, (folder / name).string() + ": " + part);
  };
  for (const char* name : {"a.svg", "a.PNG", "a.jpeg"}) refuses(name, "x", "a drawing or a picture");
  refuses("a.obj", "<svg xmlns='http://www.w3.org/2000/svg'/>", "a drawing or a picture");
  refuses("a.obj", "\x89PNG\r\n", "a drawing or a picture");
  refuses("a.stl", "solid a\n", "a mesh in another format (expected OBJ or PLY)");
  refuses("a.obj", "glTF", "a mesh in another format");
  refuses("a.obj", "PK\x03\x04", "an archive");
  refuses("._a.obj", std::string_view("\0\5\x16\7\0", 5), "what macOS keeps about a file");
  refuses("a.obj", "", "no vertex; is this an OBJ file?");
  refuses("a.ply", "v 0 0 0\n", "not a PLY file");
  refuses("a.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n",
          "has coordinates up to 1e+300. Export it in mm, cm or m");
  refuses("a.obj", "v 0 0 0\nv 1e-300 0 0\nv 0 1e-300 0\nf 1 2 3\n", "is 1e-300 in size. Export it in mm, cm or m");
  for (const char* name : {"cloud.obj", "cloud"})
    refuses(name, "v 0 0 0\n", "has points, but no faces: a cloud of points (found 1 vertices");
  ExpectError([&] { ReadMesh(folder.path()); }, "a folder (expected an OBJ or PLY mesh). Name its files: ");
}

TEST(ReadMesh, KnowsPlyByItsFirstWord) {
  const TempDir folder;
  const geometry::TriangleMesh mesh{ForeignMesh().vertices, geometry::Triangulate(ForeignMesh())};
  geometry::WritePly(folder / "a.ply", mesh);
  std::filesystem::copy_file(folder / "a.ply", folder / "b.obj");
  EXPECT_EQ(ReadMesh(folder / "b.obj").corners, ReadMesh(folder / "a.ply").corners);
}

TEST(MeshFolder, FolderOfAFileMayBeItsPerson) {
  const TempDir folder;
  for (const char* name : {"bob/1.obj", "bob/2.obj", "eve/1.obj"}) WriteForeignObj(folder / name, ForeignMesh());
  const GivenFaces given = LoadMeshFolder(folder.path(), testing::ForeignAnnotation(), PersonOf::kFolder, "");
  EXPECT_EQ(given.groups, (std::vector<std::string>{"bob", "bob", "eve"}));
}

TEST(MeshFolder, PlyAndObjMayBeMixed) {
  const TempDir folder;
  geometry::PolygonMesh triangles = ForeignMesh();
  const geometry::Triangles all = geometry::Triangulate(triangles);
  triangles.corners.assign(all.data(), all.data() + all.size());
  triangles.offsets = {0};
  for (int t = 1; t <= all.rows(); ++t) triangles.offsets.push_back(3 * t);
  WriteForeignObj(folder / "a.obj", triangles);
  geometry::WritePly(folder / "b.ply", {triangles.vertices, all});
  const GivenFaces given = LoadMeshFolder(folder.path(), testing::ForeignAnnotation(), PersonOf::kFile, "");
  EXPECT_LT((given.face(1, 0) - given.face(0, 0)).cwiseAbs().maxCoeff(), 1e-5);
}

// Run under TSan with --gtest_filter=*Threads*. With OpenMesh as reader 8 threads crashed in 5 of 5 runs.
TEST(GivenFacesThreads, EightThreadsReadPlyFacesAsOneDoes) {
  const TempDir folder;
  constexpr int kFaces = 6;
  for (int i = 0; i < kFaces; ++i) geometry::WritePly(folder / fmt::format("{}.ply", i), ForeignMesh(i));
  const GivenFaces given = LoadMeshFolder(folder.path(), testing::ForeignAnnotation(), PersonOf::kFile, "");
  std::vector<geometry::Points> expected;
  for (int i = 0; i < kFaces; ++i) expected.push_back(given.face(i, 0));
  const auto count_equal = [&](int thread) {
    int num_equal = 0;
    for (int i = 0; i < 60; ++i) num_equal += given.face((i + thread) % kFaces, 0) == expected[(i + thread) % kFaces];
    return num_equal;
  };
  std::vector<std::future<int>> threads;
  for (int thread = 0; thread < 8; ++thread) threads.push_back(std::async(std::launch::async, count_equal, thread));
  for (auto& thread : threads) EXPECT_EQ(thread.get(), 60);
}

TEST(MeshFolder, WhatDoesNotFitIsRefusedByName) {
  const TempDir folder;
  const auto load = [&] { LoadMeshFolder(folder.path(), testing::ForeignAnnotation(), PersonOf::kFile, ""); };
  ExpectError(load, "holds no .obj or .ply");
  ExpectError([] { LoadMeshFolder("/no/such", testing::ForeignAnnotation(), PersonOf::kFile, ""); }, "is not a folder");
  WriteForeignObj(folder / "a.obj", ForeignMesh());
  WriteFileAtomically(folder / "b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ExpectError(load, "b.obj has 3 vertices");
  WriteFileAtomically(folder / "b.obj", ReadFile(folder / "a.obj").substr(0, 5000));
  ExpectError(load, "b.obj");
}

TEST(CaricShop, PersonsAreFoldersAndDeviatingMeshesAreCounted) {
  const TempDir folder;
  const auto shop = folder / "processedData/tMesh";
  WriteForeignObj(shop / "Al Gore/C00001.obj", ForeignMesh(0));
  WriteForeignObj(shop / "Al Gore/c00024.obj", ForeignMesh(2));
  WriteForeignObj(shop / "Cher/C00001.obj", ForeignMesh(4));
  WriteFileAtomically(shop / "Cher/C00002.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  testing::AllowWarnings();
  const int num_warnings = log::NumWarnings();
  const GivenFaces given = LoadCaricShop(folder.path(), testing::ForeignAnnotation());
  EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
  EXPECT_EQ(given.names, (std::vector<std::string>{"Al Gore/C00001", "Al Gore/c00024", "Cher/C00001"}));
  EXPECT_EQ(given.groups, (std::vector<std::string>{"Al Gore", "Al Gore", "Cher"}));
  EXPECT_NE(given.face_template.provenance.at("licence").get<std::string>().find("research"), std::string::npos);
  LoadCaricShop(shop, testing::ForeignAnnotation());
  ExpectError([&] { LoadCaricShop(shop / "Cher", testing::ForeignAnnotation()); }, "is it 3DCaricShop?");
}

std::vector<int> Numbers(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<int> values;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('#') && !line.empty()) values.push_back(std::stoi(line));
  }
  return values;
}

/// The annotation that a user of these caricatures writes: each iBUG landmark of FaceWarehouse's head is the vertex of
/// the crop that is nearest on that head, the hairline the topmost vertex of the crop on the midline.
AnnotationFile CaricatureAnnotation(const std::filesystem::path& shared) {
  const geometry::Points head = ReadMesh(shared / "facewarehouse_topology/warehouse_0.obj").vertices;
  const geometry::Points crop = head(Numbers(shared / "caricatures/front_part_v_new.txt"), Eigen::all);
  const geometry::VertexTree tree(crop);
  const std::vector<int> landmarks = Numbers(shared / "caricatures/landmark_index.txt");
  AnnotationFile file;
  for (int i = 0; i < 68; ++i) file.landmarks[i] = tree.Nearest(head.row(landmarks.at(i)).transpose()).vertex;
  file.hairline = tree.Nearest({0, 10, crop(file.landmarks[27], 2)}).vertex;
  file.cm_per_unit = 10;
  return file;
}

TEST(MeshFolder, ReadsTheThirtyCaricatures) {
  const auto shared = testing::SharedData();
  if (!shared || !std::filesystem::exists(*shared / "caricatures/1.obj"))
    GTEST_SKIP() << "the caricatures are not there; set DAUMIER_SHARED_DATA";
  const GivenFaces given =
      LoadMeshFolder(*shared / "caricatures", CaricatureAnnotation(*shared), PersonOf::kFile, "research only");
  EXPECT_EQ(given.names.size(), 30u);
  const FaceTemplate& face = given.face_template;
  EXPECT_EQ(face.num_vertices(), 5334);
  EXPECT_EQ(face.triangles.rows(), 10394);
  EXPECT_TRUE(face.annotation.mirror.empty());
  EXPECT_EQ(face.annotation.regions.at("face").size(), 5334u);
  for (const char* region : {"eyes", "mouth", "neck_border"}) EXPECT_EQ(face.annotation.regions.count(region), 1u);
  EXPECT_EQ(face.annotation.regions.count("nose"), 0u);
  EXPECT_GT((given.face(0, 0) - given.face(1, 0)).cwiseAbs().maxCoeff(), 0.1);
}

}  // namespace
}  // namespace daumier::faces

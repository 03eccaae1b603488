#include "studio/face_tray.h"

#include "core/files.h"
#include "render/image.h"
#include "studio/api.h"
#include "studio/display_head.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

class FaceTrayTest : public ::testing::Test {
 protected:
  FaceTray OpenTray() const { return FaceTray(folder_.path(), face_, display_); }
  /// A face whose coordinates have all digits of a double.
  geometry::Points Face(double scale = 1.1) const { return scale * face_->neutral; }

  const testing::TempDir folder_;
  const std::shared_ptr<const faces::FaceTemplate> face_ =
      std::make_shared<const faces::FaceTemplate>(testing::SyntheticFace());
  const DisplayHead display_{*face_};
};

TEST_F(FaceTrayTest, PinnedFacesAreListedInTheirOrder) {
  FaceTray tray = OpenTray();
  EXPECT_EQ(tray.List(), Json::array());
  const Json shape = {{"base", "mean"}, {"controls", {{"nose_width_left", 1}}}};
  EXPECT_EQ(tray.Pin("Ada", Face(), shape), "f-0001");
  EXPECT_EQ(tray.Pin("", Face(), Json()), "f-0002");
  EXPECT_EQ(tray.List(), Json::array({{{"id", "f-0001"}, {"name", "Ada"}, {"shape", shape}},
                                      {{"id", "f-0002"}, {"name", "Face 2"}, {"shape", nullptr}}}));
  EXPECT_EQ(tray.NameOf("f-0002"), "Face 2");
  EXPECT_TRUE(tray.Has("f-0001"));
  EXPECT_EQ(tray.Pin(" Zoë\n ", Face(), Json()), "f-0003");
  EXPECT_EQ(tray.NameOf("f-0003"), "Zoë");
}

TEST_F(FaceTrayTest, AFaceIsTheSameAfterARestart) {
  std::string id;
  Json list;
  {
    FaceTray tray = OpenTray();
    id = tray.Pin("Ada", Face(), Json{{"base", "mean"}});
    EXPECT_EQ(tray.Vertices(id), Face()) << "all digits";
    list = tray.List();
  }
  const FaceTray tray = OpenTray();
  EXPECT_EQ(tray.List(), list);
  EXPECT_EQ(tray.Vertices(id), Face());
  EXPECT_EQ(tray.Vertices(id), Face()) << "of the second call, too";
  EXPECT_EQ(tray.FileOf(id), folder_ / id / "face.obj");
  EXPECT_TRUE(fs::is_regular_file(tray.FileOf(id)));
}

TEST_F(FaceTrayTest, AThumbnailShowsTheFace) {
  FaceTray tray = OpenTray();
  const render::Image first = render::ReadImage(tray.ThumbnailOf(tray.Pin("", Face(), Json())));
  EXPECT_EQ(first.width, FaceTray::kThumbnail);
  EXPECT_EQ(first.height, FaceTray::kThumbnail);
  geometry::Points wide = Face();
  wide.col(0) *= 1.5;
  EXPECT_NE(render::ReadImage(tray.ThumbnailOf(tray.Pin("", wide, Json()))), first);
}

TEST_F(FaceTrayTest, AFaceOfOtherVerticesLeavesNothing) {
  FaceTray tray = OpenTray();
  ExpectError([&] { tray.Pin("", Face().topRows(5), Json()); }, "a face of 5 vertices, expected");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(FaceTrayTest, ARemovedFaceIsGoneAndItsIdIsNotUsedAgain) {
  FaceTray tray = OpenTray();
  tray.Pin("", Face(), Json());
  const std::string id = tray.Pin("", Face(), Json());
  tray.Vertices(id);  // It is kept in memory.
  tray.Remove(id);
  EXPECT_FALSE(tray.Has(id));
  EXPECT_THROW(tray.Vertices(id), NotFound);
  EXPECT_THROW(tray.Remove(id), NotFound);
  EXPECT_EQ(tray.Pin("", Face(), Json()), "f-0003");
  EXPECT_EQ(tray.List().size(), 2u);
}

TEST_F(FaceTrayTest, WhatIsNotThereIsNotFound) {
  FaceTray tray = OpenTray();
  tray.Pin("", Face(), Json());
  for (const char* id : {"", "f-0002", "s-0001", "..", "../f-0001", "f-0001/..", "f-0001/face.obj", "mean"}) {
    EXPECT_FALSE(tray.Has(id)) << id;
    EXPECT_THROW(tray.Vertices(id), NotFound) << id;
    EXPECT_THROW(tray.FileOf(id), NotFound) << id;
    EXPECT_THROW(tray.ThumbnailOf(id), NotFound) << id;
    EXPECT_THROW(tray.NameOf(id), NotFound) << id;
    EXPECT_THROW(tray.Remove(id), NotFound) << id;
  }
}

TEST_F(FaceTrayTest, DamagedFoldersAreLeftOut) {
  FaceTray tray = OpenTray();
  for (int i = 0; i < 6; ++i) tray.Pin("", Face(), Json());
  WriteFileAtomically(folder_ / "f-0001/face.json", "{");
  WriteFileAtomically(folder_ / "f-0002/face.json", "[]");
  WriteFileAtomically(folder_ / "f-0003/face.json", R"({"name": 3})");
  fs::remove(folder_ / "f-0004/face.obj");
  fs::remove(folder_ / "f-0005/face.json");
  MakeDirectory(folder_ / "f-0007");
  ASSERT_EQ(tray.List().size(), 1u);
  EXPECT_EQ(tray.List()[0]["id"], "f-0006");
  EXPECT_THROW(tray.Vertices("f-0004"), NotFound);
  EXPECT_THROW(tray.NameOf("f-0005"), NotFound);
  EXPECT_THROW(tray.ThumbnailOf("f-0007"), NotFound);
  WriteFileAtomically(folder_ / "f-0006/face.obj", "v 1 2 3\n");
  ExpectError([&] { tray.Vertices("f-0006"); }, "face.obj");
}

TEST_F(FaceTrayTest, ADamagedRecordIsAnErrorOfOurs) {
  FaceTray tray = OpenTray();
  const std::string id = tray.Pin("Ada", Face(), Json());
  for (const char* record : {"{", "[]", R"({"name": 3})"}) {
    WriteFileAtomically(folder_ / id / "face.json", record);
    EXPECT_THROW(tray.NameOf(id), Error) << record;
  }
}

TEST_F(FaceTrayTest, MoreFacesThanStayInMemoryAreRead) {
  FaceTray tray = OpenTray();
  std::vector<std::string> ids;
  for (int i = 0; i < 18; ++i) ids.push_back(tray.Pin("", Face(1 + 0.01 * i), Json()));
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 18; ++i) EXPECT_EQ(tray.Vertices(ids[size_t(i)]), Face(1 + 0.01 * i)) << i;
}

TEST_F(FaceTrayTest, IsUsedFromSeveralThreads) {
  FaceTray tray = OpenTray();
  const std::string id = tray.Pin("", Face(), Json());
  testing::ExpectTheSameFromThreads(2, [&] {
    const std::string own = tray.Pin("own", Face(2), Json());
    EXPECT_EQ(tray.Vertices(own), Face(2));
    tray.List();
    tray.Remove(own);
    return tray.Vertices(id);
  });
  EXPECT_EQ(tray.List().size(), 1u);
}

}  // namespace
}  // namespace daumier::studio

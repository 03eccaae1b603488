#include "studio/collector.h"

#include "core/files.h"
#include "core/manifest.h"
#include "datasets/read/sketch_database.h"
#include "render/image.h"
#include "tests/studio/pen_drawings.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::studio {
namespace {

using testing::DrawingBody;
using testing::ExpectError;

class CollectorTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new testing::TempDir;
    testing::BuildSyntheticFaces(*data_ / "faces", 1);
    faces_ = new ShownFaces(*data_ / "faces", [] { return faces::FaceTemplate(); });
  }
  static void TearDownTestSuite() {
    delete faces_;
    delete data_;
  }

  static int Shown(const Json& state) { return state.at("face").at("number").get<int>(); }
  Collector Open(const std::string& person = "1", int count = 0) const {
    return Collector(out_.path() / "c", *faces_, {person, count}, {*data_ / "faces"});
  }
  /// The faces that a person draws, in their order.
  std::vector<int> DrawAll(Collector& collector) const {
    std::vector<int> shown;
    for (Json state = collector.State(); !state.at("face").is_null(); state = collector.Add(DrawingBody(shown.back())))
      shown.push_back(Shown(state));
    return shown;
  }

  static inline testing::TempDir* data_ = nullptr;
  static inline ShownFaces* faces_ = nullptr;
  const testing::TempDir out_;
};

TEST_F(CollectorTest, EachFaceIsShownOnceAndCounted) {
  Collector collector = Open();
  const Json begin = collector.State();
  EXPECT_EQ(begin.at("person"), "1");
  EXPECT_EQ(begin.at("done"), 0);
  EXPECT_EQ(begin.at("total"), faces_->size());
  const std::vector<int> shown = DrawAll(collector);
  EXPECT_EQ(std::set<int>(shown.begin(), shown.end()).size(), size_t(faces_->size()));
  EXPECT_EQ(collector.State().at("done"), faces_->size());
  EXPECT_TRUE(collector.State().at("face").is_null());
}

TEST_F(CollectorTest, ADrawingBecomesFilesAndADatabase) {
  Collector collector = Open();
  const int face = Shown(collector.State());
  collector.Add(DrawingBody(face));
  const auto folder = out_ / "c";
  EXPECT_TRUE(std::filesystem::exists(folder / "drawings/00001.svg"));
  const HandDrawing drawing = HandDrawingFromJson(ReadJson(folder / "drawings/00001.json"), "record");
  EXPECT_EQ(drawing.face, faces_->id(face));
  EXPECT_EQ(drawing.strokes[0].times_ms, (std::vector<double>{10, 26.5}));
  EXPECT_EQ(drawing.strokes[0].pressures, (std::vector<double>{0.5, 0.75}));
  const Manifest manifest = ReadManifest(folder, "collection");
  EXPECT_EQ(manifest.counts.at("drawings"), 1);
  VerifyChecksums(folder, manifest);
  EXPECT_EQ(datasets::SketchDatabase(folder / "sketches").strokes(0).size(), 2u);
  EXPECT_TRUE(faces::FaceDatabase(folder / "faces").points(0).isApprox(faces_->Vertices(face), 1e-6));
}

TEST_F(CollectorTest, ALaterStartGoesOnAndLosesNothing) {
  int next = 0;
  {
    Collector collector = Open("7", 3);
    EXPECT_EQ(collector.State().at("total"), 3);
    next = Shown(collector.Add(DrawingBody(Shown(collector.State()))));
  }
  Collector collector = Open("7", 3);
  EXPECT_EQ(collector.State().at("done"), 1);
  EXPECT_EQ(collector.State().at("total"), 3);
  EXPECT_EQ(Shown(collector.State()), next);
  collector.Add(DrawingBody(next));
  EXPECT_TRUE(std::filesystem::exists(out_ / "c/drawings/00001.json"));
  EXPECT_TRUE(std::filesystem::exists(out_ / "c/drawings/00002.json"));
  EXPECT_EQ(datasets::SketchDatabase(out_ / "c/sketches").num_faces(), 2);
}

TEST_F(CollectorTest, AnotherPersonBeginsWithFacesThatNobodyDrew) {
  Collector first = Open("1", 3);
  const std::vector<int> drawn = DrawAll(first);
  Collector second = Open("2", faces_->size() - 3);
  for (const int face : DrawAll(second)) EXPECT_EQ(std::ranges::count(drawn, face), 0) << face;
  EXPECT_EQ(ReadManifest(out_ / "c", "collection").counts.at("persons"), 2);
}

TEST_F(CollectorTest, ASkippedFaceComesAfterAllOthers) {
  Collector collector = Open();
  const Json begin = collector.State();
  const int skipped = Shown(begin);
  const Json state = collector.Skip(skipped);
  EXPECT_EQ(Shown(state), begin.at("next").at("number"));
  EXPECT_EQ(state.at("total"), faces_->size());
  EXPECT_EQ(collector.Skip(skipped), state) << "another face is shown";
  EXPECT_EQ(DrawAll(collector).back(), skipped);
}

TEST_F(CollectorTest, WrongDrawingsLeaveNothing) {
  Collector collector = Open();
  const Json state = collector.State();
  const int face = Shown(state);
  ExpectError([&] { collector.Add(DrawingBody(face + 1)); }, "not the one that is shown");
  Json empty = DrawingBody(face);
  empty["strokes"] = Json::array();
  ExpectError([&] { collector.Add(empty); }, "nothing is drawn");
  ExpectError([&] { collector.Add({{"strokes", Json::array()}}); }, "'face' is no whole number");
  EXPECT_EQ(collector.State(), state);
  EXPECT_TRUE(std::filesystem::is_empty(out_ / "c/drawings"));
}

TEST_F(CollectorTest, OtherFoldersAndNamesAreRefused) {
  ExpectError([&] { Open("Ada Lovelace"); }, "is no name of who draws");
  ExpectError([&] { Open(""); }, "is no name of who draws");
  { Open(); }
  const testing::TempDir other;
  testing::BuildSyntheticFaces(other / "faces", 2);
  const ShownFaces others(other / "faces", [] { return faces::FaceTemplate(); });
  ExpectError([&] { Collector(out_ / "c", others, {}); }, "drawings of other faces");
  ExpectError([&] { Collector(other.path(), others, {}); }, "holds no earlier collection");
}

TEST_F(CollectorTest, ACallRepairsTheDatabaseOfAProgramThatWasKilled) {
  {
    Collector collector = Open();
    collector.Add(DrawingBody(Shown(collector.State())));
  }
  std::filesystem::remove_all(out_ / "c/sketches");
  Open();
  EXPECT_EQ(datasets::SketchDatabase(out_ / "c/sketches").num_faces(), 1);
}

TEST_F(CollectorTest, RoutesGivePicturesAndStates) {
  Collector collector = Open();
  const auto get = [&](const std::string& path) { return Call(collector.routes(), "GET", path, {}); };
  const ApiReply picture = get("/api/collect/faces/0/front.png");
  ASSERT_EQ(picture.status, 200);
  EXPECT_EQ(picture.type, "image/png");
  const render::Image front = render::DecodeImage(picture.body, "front"),
                      side = render::DecodeImage(get("/api/collect/faces/0/side.png").body, "side");
  EXPECT_EQ(front.width, front.height);
  EXPECT_FALSE(front == side);
  for (const char* wrong : {"/api/collect/faces/0/back.png", "/api/collect/faces/99/front.png",
                            "/api/collect/faces/x/front.png", "/api/collect/faces/0/front"})
    EXPECT_EQ(get(wrong).status, 404) << wrong;
  EXPECT_EQ(Json::parse(get("/api/info").body).at("mode"), "collect");
  EXPECT_EQ(Json::parse(get("/api/collect").body), collector.State());
  EXPECT_EQ(Json::parse(get("/api/openapi.json").body).at("paths").size(), collector.routes().size());
  const std::string body = DrawingBody(Shown(collector.State())).dump();
  const ApiReply kept =
      Call(collector.routes(), "POST", "/api/collect/drawings", {.path = {}, .query = {}, .body = body});
  EXPECT_EQ(Json::parse(kept.body).at("done"), 1);
  EXPECT_EQ(Call(collector.routes(), "POST", "/api/collect/drawings", {.path = {}, .query = {}, .body = body}).status,
            400);
}

}  // namespace
}  // namespace daumier::studio

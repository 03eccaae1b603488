#include "studio/head_jobs.h"

#include "geometry/obj.h"
#include "tests/studio/job_plans_fixture.h"

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

TEST_F(JobPlansTest, AHeadIsRigged) {
  EXPECT_EQ(Plan({{"do", "head"}, {"shape", Json::object()}}).what, "head");
  EXPECT_EQ(CommandOf({{"do", "head"}, {"shape", Json::object()}}),
            "daumier rig face.obj --out head.glb --names arkit --json");
  const Json options = {{"names", "vrm"}, {"hair", "bob"},     {"hair_colour", "#804020"},     {"vrm", true},
                        {"print", true},  {"triangles", 5000}, {"clip", Upload("my take.csv")}};
  EXPECT_EQ(CommandOf({{"do", "head"}, {"face", Pinned()}, {"options", options}}),
            "daumier rig face.obj --out head.glb --names vrm --hair bob --hair-colour '#804020' --vrm --print "
            "--triangles 5000 --animate my_take.csv --json");
}

TEST_F(JobPlansTest, AColourWithoutHairIsLeftOut) {
  EXPECT_EQ(CommandOf({{"do", "head"}, {"shape", Json::object()}, {"options", {{"hair_colour", "brown"}}}}),
            "daumier rig face.obj --out head.glb --names arkit --json");
}

TEST_F(JobPlansTest, AHeadsFaceAndClipAreWrittenIntoItsFolder) {
  const fs::path job =
      Written({{"do", "head"}, {"shape", Json::object()}, {"options", {{"clip", Upload("take.csv")}}}});
  EXPECT_EQ(geometry::ReadObj(job / "face.obj").vertices, Mean());
  EXPECT_EQ(ReadFile(job / "take.csv"), "bytes of it");
}

TEST_F(JobPlansTest, AnAvatarOfAPicture) {
  const std::string upload = Upload("woman 1.jpg");
  EXPECT_EQ(CommandOf({{"do", "avatar"}, {"upload", upload}}),
            "daumier avatar woman_1.jpg --out head.glb --as auto --stages stages --names arkit --json");
  const Json options = {{"as", "portrait"}, {"style", "toon"}, {"caricature", 0.5},          {"hair", "auto"},
                        {"names", "rpm"},   {"vrm", true},     {"clip", Upload("take.bvh")}, {"hair_colour", ""}};
  EXPECT_EQ(CommandOf({{"do", "avatar"}, {"upload", upload}, {"options", options}}),
            "daumier avatar woman_1.jpg --out head.glb --as portrait --stages stages --style toon --caricature 0.5 "
            "--names rpm --hair auto --vrm --animate take.bvh --json");
  EXPECT_EQ(ReadFile(Written({{"do", "avatar"}, {"upload", upload}}) / "woman_1.jpg"),
            ReadFile(uploads_.FileOf(upload)));
}

TEST_F(JobPlansTest, APictureThatIsNamedAsAResultIsNotOverwritten) {
  for (const char* name : {"head.png", "head.glb", "stages"}) {
    const std::string command = CommandOf({{"do", "avatar"}, {"upload", Upload(name)}});
    EXPECT_EQ(command.find(std::string("avatar ") + name + " --out head.glb"), std::string::npos) << command;
  }
}

TEST_F(JobPlansTest, LandmarksOfAPersonAreWrittenIntoTheFolder) {
  Json landmarks = Json::array();
  for (int i = 0; i < 68; ++i) landmarks.push_back({i, 2.5 * i});
  const Json body = {{"do", "avatar"}, {"upload", Upload("a.jpg")}, {"landmarks", landmarks}};
  EXPECT_EQ(
      CommandOf(body),
      "daumier avatar a.jpg --out head.glb --as auto --stages stages --landmarks landmarks.pts --names arkit --json");
  const fs::path job = Written(body);
  EXPECT_TRUE(fs::exists(job / "a.jpg"));
  EXPECT_NE(ReadFile(job / "landmarks.pts").find("67.000 167.500"), std::string::npos);
  Json none = body;
  none["landmarks"] = nullptr;
  EXPECT_EQ(CommandOf(none).find("--landmarks"), std::string::npos);
}

TEST_F(JobPlansTest, AnAvatarOfADrawingReadsTheDrawing) {
  const Json body = {{"do", "avatar"}, {"session", DrawnSession()}};
  EXPECT_EQ(CommandOf(body),
            "daumier avatar drawing.svg --out head.glb --as drawing --stages stages --names arkit --json");
  EXPECT_NE(ReadFile(Written(body) / "drawing.svg").find("<svg"), std::string::npos);
}

TEST_F(JobPlansTest, LandmarksOfASessionAreRefused) {
  Json body = {{"do", "avatar"}, {"session", DrawnSession()}, {"landmarks", Json::array()}};
  for (int i = 0; i < 68; ++i) body["landmarks"].push_back({i, i});
  ExpectError([&] { Plan(body); }, "a session has none");
}

TEST_F(JobPlansTest, AnAvatarOfASessionThatIsNoDrawingAnyMoreIsItsFace) {
  const Json body = {{"do", "avatar"}, {"session", MeanSession()}, {"options", {{"hair", "auto"}, {"vrm", true}}}};
  EXPECT_EQ(Plan(body).what, "avatar");
  EXPECT_EQ(CommandOf(body), "daumier rig face.obj --out head.glb --names arkit --vrm --json");
  EXPECT_EQ(geometry::ReadObj(Written(body) / "face.obj").vertices, Mean());
}

TEST_F(JobPlansTest, MeshesAndTurntablesOfAvatarsBeginWithTheAvatar) {
  const Json avatar = {{"upload", Upload("a.jpg")}, {"options", {{"hair", "bob"}, {"names", "rpm"}, {"vrm", true}}}};
  for (const Json& body : {Json{{"do", "mesh"}, {"format", "ply"}, {"avatar", avatar}},
                           Json{{"do", "turntable"}, {"avatar", avatar}, {"options", {{"frames", 2}}}}}) {
    const NewJob job = Plan(body);
    EXPECT_EQ(job.what, body["do"]);
    EXPECT_EQ(job.command,
              "daumier avatar a.jpg --out head.glb --as auto --stages stages --names arkit --hair bob --json")
        << "a head that can be read again";
    EXPECT_NE(job.note.find("No verb"), std::string::npos);
    EXPECT_TRUE(fs::exists(Written(body) / ".head/a.jpg")) << "which is no result";
  }
  ExpectRefused({{"do", "mesh"}, {"format", "obj"}, {"avatar", 3}}, "an avatar is no object");
  ExpectRefused({{"do", "mesh"}, {"format", "obj"}, {"avatar", {{"uplaod", "u-0001"}}}}, "did you mean 'upload'?");
  ExpectRefused({{"do", "mesh"}, {"format", "obj"}, {"avatar", Json::object()}}, "the request has no text 'upload'");
}

}  // namespace
}  // namespace daumier::studio

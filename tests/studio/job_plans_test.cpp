#include "studio/job_plans.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "geometry/ply.h"
#include "render/image.h"
#include "studio/api.h"
#include "tests/studio/shipped_studio.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// With the shipped weights, and a program that is not there: what a job writes before it starts the program is in its folder.
class JobPlansTest : public ::testing::Test {
 protected:
  const JobMaterial& material() const { return material_; }
  NewJob Plan(const Json& body) const { return PlanJob(body, material_); }
  std::string CommandOf(const Json& body) const { return Plan(body).command; }
  std::string Upload(const std::string& name) {
    const bool is_png = name.ends_with(".png"), is_picture = is_png || name.ends_with(".jpg");
    const auto format = is_png ? render::ImageFormat::kPng : render::ImageFormat::kJpeg;
    return uploads_.Add(name,
                        is_picture ? render::EncodeImage(render::Image(32, 32, 3, 90), format) : "bytes of it")["id"];
  }
  std::string Pinned() { return tray_.Pin("Ada", Mean(), Json()); }
  std::string MeanSession() { return desk_.Add({.begins_with_mean = true}); }
  std::string DrawnSession() {
    const std::string id = desk_.Add({});
    desk_.Do(id, {{"do", "draw"}, {"points", {{20, 20}, {30, 25}}}});
    return id;
  }
  static const geometry::Points& Mean() { return testing::ShippedShaper().face_template().neutral; }
  void ExpectRefused(const Json& body, const std::string& why) const {
    ExpectError([&] { Plan(body); }, why);
    EXPECT_THROW(Plan(body), UsageError) << body;
  }
  /// The folder of a job that has tried to start the program.
  fs::path Written(const Json& body) const {
    MakeDirectory(folder_ / "job" / kJobScratch);
    ExpectError([&] { Plan(body).work(folder_ / "job", Task()); },
                "daumier is not there any more. Start the studio again");
    return folder_ / "job";
  }

  const testing::TempDir folder_;
  SketchDesk desk_{folder_ / "sessions", testing::ShippedSketchPredictor(), nullptr};
  FaceTray tray_{folder_ / "faces", testing::ShippedSketchPredictor()->face_template()};
  Uploads uploads_{folder_ / "uploads"};
  const JobMaterial material_{desk_, tray_, testing::ShippedShaper(), uploads_, testing::kNoProgram};
};

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

TEST_F(JobPlansTest, WordsAreQuotedAsAShellReadsThem) {
  const auto command = [&](const char* colour) {
    return CommandOf(
        {{"do", "head"}, {"shape", Json::object()}, {"options", {{"hair", "bob"}, {"hair_colour", colour}}}});
  };
  const std::string begin = "daumier rig face.obj --out head.glb --names arkit --hair bob --hair-colour ";
  EXPECT_EQ(command("brown"), begin + "brown --json");
  EXPECT_EQ(command("rgb(1, 2, 3)"), begin + "'rgb(1, 2, 3)' --json");
  EXPECT_EQ(command("it's; rm -rf ~"), begin + "'it'\\''s; rm -rf ~' --json");
  EXPECT_EQ(command("$(id)"), begin + "'$(id)' --json");
  EXPECT_EQ(command("a\nb"), begin + "'a\nb' --json");
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

TEST_F(JobPlansTest, LandmarksAndDrawingsArePredicted) {
  EXPECT_EQ(CommandOf({{"do", "landmarks"}, {"upload", Upload("a b.png")}}),
            "daumier predict a_b.png --weights landmarks --out landmarks");
  EXPECT_EQ(CommandOf({{"do", "drawing"}, {"upload", Upload("a.svg")}}), "daumier predict a.svg --out predicted");
  EXPECT_TRUE(fs::exists(Written({{"do", "drawing"}, {"upload", Upload("b.svg")}}) / "b.svg"));
}

TEST_F(JobPlansTest, AMeshIsWrittenWithoutTheProgram) {
  for (const std::string format : {"obj", "ply"}) {
    const NewJob job = Plan({{"do", "mesh"}, {"session", MeanSession()}, {"format", format}});
    EXPECT_EQ(job.what, "mesh");
    job.work(folder_.path(), Task());
  }
  EXPECT_EQ(geometry::ReadObj(folder_ / "face.obj").vertices, Mean());
  EXPECT_LT((geometry::ReadPly(folder_ / "face.ply").vertices - Mean()).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(JobPlansTest, ATurntableIsWrittenWithoutTheProgram) {
  const auto body = [](const Json& options) {
    return Json{{"do", "turntable"}, {"shape", Json::object()}, {"options", options}};
  };
  Plan(body({{"frames", 2}, {"size", 64}})).work(folder_.path(), Task());
  EXPECT_TRUE(fs::exists(folder_ / "turn_002.png"));
  EXPECT_FALSE(fs::exists(folder_ / "turn_003.png"));
  ExpectRefused(body({{"frames", 1}}), "frames");
  ExpectRefused(body({{"size", 5000}}), "size");
}

TEST_F(JobPlansTest, FacesAreNamedBySessionsFacesOrShapes) {
  const std::string face = tray_.Pin("", 1.1 * Mean(), Json());
  EXPECT_EQ(FaceOfRequest({{"session", MeanSession()}}, material()), Mean());
  EXPECT_EQ(FaceOfRequest({{"face", face}}, material()), 1.1 * Mean());
  EXPECT_EQ(FaceOfRequest({{"shape", {{"base", face}}}}, material()), 1.1 * Mean());
  EXPECT_EQ(FaceOfRequest({{"shape", {{"base", MeanSession()}}}}, material()), Mean());
  EXPECT_EQ(FaceNamed(face, material()), 1.1 * Mean());
  ExpectError([&] { FaceOfRequest(Json::object(), material()); },
              "the request names no face: 'session', 'face' or 'shape'");
  EXPECT_THROW(FaceOfRequest({{"face", "f-0099"}}, material()), NotFound);
  EXPECT_THROW(FaceOfRequest({{"session", "s-0099"}}, material()), NotFound);
  EXPECT_THROW(FaceOfRequest({{"face", "../faces/f-0001"}}, material()), NotFound);
  EXPECT_THROW(FaceOfRequest({{"session", "s-/../../faces/f-0001"}}, material()), NotFound);
  EXPECT_THROW(FaceOfRequest({{"shape", {{"base", "f-0099"}}}}, material()), NotFound);
  EXPECT_THROW(FaceOfRequest({{"session", 3}}, material()), UsageError);
  ExpectError([&] { FaceNamed(desk_.Add({}), material()); }, "the drawing shows no face yet");
}

TEST_F(JobPlansTest, RefusesWhatIsUnknownOrOutOfRange) {
  const Json shape = Json::object();
  ExpectRefused(Json::object(), "the request has no text 'do'");
  ExpectRefused({{"do", 3}}, "the request has no text 'do'");
  ExpectRefused({{"do", "haed"}},
                "there is no job 'haed' (expected avatar, drawing, head, landmarks, mesh, turntable)");
  ExpectRefused({{"do", "head"}}, "the request names no face");
  ExpectRefused({{"do", "avatar"}}, "the request has no text 'upload'");
  ExpectRefused({{"do", "landmarks"}}, "the request has no text 'upload'");
  ExpectRefused({{"do", "mesh"}, {"shape", shape}}, "the request has no text 'format'");
  ExpectRefused({{"do", "mesh"}, {"shape", shape}, {"format", "fbx"}}, "'format' is 'fbx', expected obj or ply");
  ExpectRefused({{"do", "avatar"}, {"session", desk_.Add({})}}, "the drawing shows no face yet");
  const auto options = [&](const Json& given) { return Json{{"do", "head"}, {"shape", shape}, {"options", given}}; };
  ExpectRefused(options({{"nmaes", "arkit"}}), "names");
  ExpectRefused(options({{"names", "blender"}}), "names");
  ExpectRefused(options({{"hair", "auto"}}), "hair");
  ExpectRefused(options({{"triangles", -1}}), "triangles");
  ExpectRefused(options({{"triangles", 1e9}}), "triangles");
  ExpectRefused(options({{"vrm", "yes"}}), "vrm");
  ExpectRefused({{"do", "avatar"}, {"upload", Upload("a.jpg")}, {"options", {{"caricature", 3}}}}, "caricature");
  for (const Json& landmarks :
       {Json(3), Json::array(), Json::array({{1, 2}}), Json(std::vector<int>(68, 1)),
        Json(std::vector<std::vector<int>>(68, {1})), Json(std::vector<std::vector<std::string>>(68, {"a", "b"}))})
    ExpectRefused({{"do", "avatar"}, {"upload", Upload("a.jpg")}, {"landmarks", landmarks}},
                  "'landmarks' is no list of");
  EXPECT_THROW(Plan({{"do", "avatar"}, {"upload", "u-0099"}}), NotFound);
  EXPECT_THROW(Plan({{"do", "landmarks"}, {"upload", "../sessions/s-0001"}}), NotFound);
  EXPECT_THROW(Plan({{"do", "avatar"}, {"session", "s-0099"}}), NotFound);
  EXPECT_THROW(Plan(options({{"clip", "u-0099"}})), NotFound);
}

TEST_F(JobPlansTest, AKeyThatNoJobHasIsRefused) {
  ExpectRefused({{"do", "turntable"}, {"shape", Json::object()}, {"frames", 2}}, "frames");
  ExpectRefused({{"do", "head"}, {"shape", Json::object()}, {"optoins", Json::object()}}, "options");
}

TEST_F(JobPlansTest, ItsSchemaNamesTheJobsAndTheirOptions) {
  const Json properties = JobSchema()["properties"];
  for (const Json& name : properties["do"]["enum"]) {
    try {
      Plan({{"do", name}});
      ADD_FAILURE() << name << " needs something";
    } catch (const UsageError& error) {
      EXPECT_EQ(std::string(error.what()).find("there is no job"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(properties["do"]["enum"].size(), 6u);
  EXPECT_TRUE(properties["options"]["oneOf"][0]["properties"].contains("caricature"));
  EXPECT_TRUE(properties["options"]["oneOf"][1]["properties"].contains("triangles"));
  EXPECT_TRUE(properties["options"]["oneOf"][2]["properties"].contains("frames"));
}

}  // namespace
}  // namespace daumier::studio

#include "studio/job_plans.h"

#include "geometry/obj.h"
#include "geometry/ply.h"
#include "studio/api.h"
#include "tests/studio/job_plans_fixture.h"

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

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

TEST_F(JobPlansTest, SaysWhichVerbWritesAMeshOrThatNoneDoes) {
  const auto mesh = [&](Json body, const std::string& format) {
    body["do"] = "mesh";
    body["format"] = format;
    return Plan(body);
  };
  const std::string id = MeanSession();
  desk_.Do(id, {{"do", "draw"}, {"points", {{20, 20}, {30, 25}}}});
  EXPECT_EQ(mesh({{"session", id}}, "obj").command,
            "daumier predict --session sessions/" + id + "/session.json --out drawing");
  EXPECT_EQ(mesh({{"session", MeanSession()}}, "obj").command, "") << "nothing is recorded yet";
  const std::string face = Pinned();
  EXPECT_EQ(mesh({{"face", face}}, "obj").note,
            "No verb is needed: it is faces/" + face + "/face.obj in the studio's folder");
  for (const NewJob& job : {mesh({{"face", face}}, "ply"), mesh({{"shape", Json::object()}}, "obj"),
                            Plan({{"do", "turntable"}, {"face", face}})}) {
    EXPECT_EQ(job.command, "");
    EXPECT_NE(job.note.find("POST /api/jobs"), std::string::npos);
  }
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

#include "studio/studio.h"

#include "core/files.h"
#include "render/image.h"
#include "tests/studio/shipped_studio.h"
#include "tests/support/live_link_packets.h"
#include "tests/support/udp_sender.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

/// Calls of one studio with the shipped weights, which all tests share: they name what they make.
class StudioTest : public ::testing::Test {
 protected:
  static ApiReply Reply(std::string_view method, std::string_view path, std::string_view body = "",
                        std::map<std::string, std::string, std::less<>> query = {}) {
    return Call(testing::ShippedStudio::Get().studio().routes(), method, path,
                {.path = {}, .query = std::move(query), .body = body});
  }
  static Json Get(std::string_view path) { return Parsed(Reply("GET", path)); }
  static Json Post(std::string_view path, const Json& body) { return Parsed(Reply("POST", path, body.dump())); }
  static int PostStatus(std::string_view path, const Json& body) { return Reply("POST", path, body.dump()).status; }
  /// Of a reply that succeeded.
  static Json Parsed(const ApiReply& reply) {
    EXPECT_EQ(reply.status, 200) << reply.body;
    EXPECT_EQ(reply.type, "application/json");
    return Json::parse(reply.body);
  }
  static std::string NewSession(const Json& body = Json::object()) { return Post("/api/sessions", body)["id"]; }
  static size_t NumBytes() { return 12 * Get("/api/head")["num_vertices"].get<size_t>(); }
  static Json Ended(const std::string& job) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    Json state = Get("/api/jobs/" + job);
    while ((state["state"] == "queued" || state["state"] == "running") && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      state = Get("/api/jobs/" + job);
    }
    return state;
  }
};

/// Whether a list of objects has one of this id.
bool HasId(const Json& list, const std::string& id) {
  for (const Json& entry : list)
    if (entry["id"] == id) return true;
  return false;
}

TEST_F(StudioTest, KeepsSessionsAndForgetsUploadsAndJobs) {
  EXPECT_TRUE(HasId(Get("/api/sessions")["sessions"], "s-0007"));
  const Json state = Get("/api/sessions/s-0007");
  EXPECT_EQ(state["name"], "Kept");
  EXPECT_EQ(state["sheet"], Json::parse("[300.0, 200.0]"));
  EXPECT_EQ(state["mode"], "follow_up") << "it begins with the mean face";
  const fs::path& folder = testing::ShippedStudio::Get().folder();
  EXPECT_FALSE(fs::exists(folder / "uploads/u-0001/old.csv"));
  EXPECT_FALSE(fs::exists(folder / "jobs/j-0001/old.glb"));
}

TEST_F(StudioTest, SaysWhatItIs) {
  const Json info = Get("/api/info");
  EXPECT_FALSE(info["version"].get<std::string>().empty());
  EXPECT_EQ(info["can"], (Json{{"gestures", true}, {"portraits", true}}));
  EXPECT_EQ(info["sheet"], Json::parse("[512.0, 512.0]"));
}

TEST_F(StudioTest, ItsDescriptionHasEachRoute) {
  const Json paths = Get("/api/openapi.json")["paths"];
  std::set<std::string> seen;
  for (const Route& route : testing::ShippedStudio::Get().studio().routes()) {
    EXPECT_FALSE(route.summary.empty()) << route.path;
    EXPECT_TRUE(seen.insert(route.method + route.path).second) << "twice: " << route.method << route.path;
    EXPECT_TRUE(route.path.starts_with("/api/")) << route.path << " would need no token";
  }
  size_t num_described = 0;
  for (const auto& [path, methods] : paths.items()) num_described += methods.size();
  EXPECT_EQ(num_described, seen.size());
}

TEST_F(StudioTest, SendsTheHead) {
  const Json head = Get("/api/head");
  EXPECT_EQ(Reply("GET", "/api/head/triangles").body.size(), 12 * head["num_triangles"].get<size_t>());
  EXPECT_LE(head["num_face_vertices"], head["num_vertices"]);
}

TEST_F(StudioTest, ASessionIsDrawnNamedAndRemoved) {
  const Json begun = Post("/api/sessions", {{"name", "Mine"}, {"begin", "mean"}});
  const std::string path = "/api/sessions/" + begun["id"].get<std::string>();
  EXPECT_EQ(begun["name"], "Mine");
  EXPECT_EQ(Reply("GET", path + "/vertices").body.size(), NumBytes());
  const Json state = Post(path + "/events", {{"do", "draw"}, {"points", {{5, 5}, {20, 5}}}});
  EXPECT_EQ(state["revision"], 1);
  EXPECT_EQ(state["changed"], true);
  EXPECT_EQ(Json::parse(Reply("GET", path + "/session.json").body)["events"].size(), 1u);
  EXPECT_EQ(Parsed(Reply("PATCH", path, R"({"name": "Other"})"))["name"], "Other");
  EXPECT_EQ(Get(path)["name"], "Other");
  const Json camera = Parsed(Reply("GET", path + "/camera", "", {{"yaw", "30"}}));
  ASSERT_EQ(camera["pixel_from_cm"].size(), 3u);
  for (const Json& row : camera["pixel_from_cm"]) EXPECT_EQ(row.size(), 4u);
  EXPECT_EQ(Reply("GET", path + "/camera", "", {{"yaw", "far"}}).status, 400);
  EXPECT_EQ(Parsed(Reply("DELETE", path)), Json::object());
  EXPECT_EQ(Reply("GET", path).status, 404);
}

TEST_F(StudioTest, ABlankSessionHasNoFaceYet) {
  const std::string id = NewSession(), path = "/api/sessions/" + id;
  const ApiReply none = Reply("GET", path + "/vertices");
  EXPECT_EQ(none.status, 204);
  EXPECT_EQ(none.body, "");
  EXPECT_EQ(Reply("GET", path + "/session.json").status, 404);
  EXPECT_EQ(PostStatus("/api/faces", {{"session", id}}), 400);
  EXPECT_EQ(PostStatus("/api/sessions", {{"begin", id}}), 400);
  EXPECT_EQ(Reply("POST", path + "/preview", R"({"points": [[100, 100], [300, 120]]})").body.size(), NumBytes());
  EXPECT_EQ(PostStatus(path + "/preview", {{"points", {{1, 1}}}}), 400);
  EXPECT_EQ(PostStatus(path + "/preview", Json::object()), 400);
  EXPECT_EQ(PostStatus(path + "/preview", {{"do", "roll"}, {"level", 1}}), 400) << "refinement has not begun";
}

TEST_F(StudioTest, AnEventCanBringItsFaceAlong) {
  const std::string id = NewSession({{"begin", "mean"}}), path = "/api/sessions/" + id;
  for (const char* what : {"refine", "undo"}) {
    const ApiReply reply = Reply("POST", path + "/events", Json({{"do", what}}).dump(), {{"face", "1"}});
    EXPECT_EQ(reply.type, "application/octet-stream");
    uint32_t length = 0;
    ASSERT_GT(reply.body.size(), sizeof length);
    std::memcpy(&length, reply.body.data(), sizeof length);
    EXPECT_EQ(length % 4, 0u) << "float32 numbers begin at a multiple of their size";
    EXPECT_EQ(Json::parse(reply.body.substr(sizeof length, length))["revision"], Get(path)["revision"]);
    EXPECT_EQ(reply.body.substr(sizeof length + length), Reply("GET", path + "/vertices").body);
  }
  const std::string blank = "/api/sessions/" + NewSession() + "/events";
  const std::string none = Reply("POST", blank, R"({"do": "undo"})", {{"face", "1"}}).body;
  uint32_t length = 0;
  std::memcpy(&length, none.data(), sizeof length);
  EXPECT_EQ(none.size(), sizeof length + length) << "there is no face";
}

TEST_F(StudioTest, RefusedEventsAre400AndSayWhy) {
  const std::string path = "/api/sessions/" + NewSession() + "/events";
  const ApiReply reply = Reply("POST", path, R"({"do": "paint"})");
  EXPECT_EQ(reply.status, 400);
  EXPECT_NE(Json::parse(reply.body)["error"].get<std::string>().find("\"paint\" is unknown"), std::string::npos);
  for (const char* body :
       {"", "[]", "{", "draw", R"({"do": "draw", "points": [[1, 1]]})", R"({"do": "undo", "by": 2})"})
    EXPECT_EQ(Reply("POST", path, body).status, 400) << body;
  EXPECT_EQ(Reply("POST", "/api/sessions/s-9999/events", R"({"do": "undo"})").status, 404);
}

TEST_F(StudioTest, SessionsBeginWithExamples) {
  const Json examples = Get("/api/examples")["examples"];
  std::set<std::string> names;
  for (const Json& example : examples) names.insert(example["name"]);
  EXPECT_TRUE(names.contains("side"));
  EXPECT_EQ(examples[0]["title"], "Front");
  const Json state = Post("/api/sessions", {{"example", "side"}});
  EXPECT_EQ(state["name"], "Side");
  EXPECT_EQ(state["has_face"], true);
  for (const char* name :
       {"nothing", "../sessions/side", "..", ".", "/etc/passwd", "side.json", "sub/../side", "..%2Fside"})
    EXPECT_EQ(PostStatus("/api/sessions", {{"example", name}}), 404) << name;
  EXPECT_EQ(PostStatus("/api/sessions", {{"example", 3}}), 400);
}

TEST_F(StudioTest, SessionsBeginWithFacesAndUploads) {
  const std::string face = Post("/api/faces", {{"shape", {{"controls", Json::object()}}}})["id"];
  EXPECT_EQ(Post("/api/sessions", {{"begin", face}})["mode"], "follow_up");
  EXPECT_EQ(Post("/api/sessions", {{"begin", NewSession({{"begin", "mean"}})}})["has_face"], true);
  EXPECT_EQ(PostStatus("/api/sessions", {{"begin", "f-9999"}}), 404);
  EXPECT_EQ(PostStatus("/api/sessions", {{"begin", "../faces/" + face}}), 404);
  EXPECT_EQ(PostStatus("/api/sessions", {{"name", 3}}), 400);
  const std::string recorded = R"({"version": 1, "sheet": [100, 80], "begin": "mean", "events": [{"do": "refine"}]})";
  const Json upload = Parsed(Reply("POST", "/api/uploads", recorded, {{"name", "old.json"}}));
  EXPECT_EQ(upload["kind"], "session");
  EXPECT_EQ(Post("/api/sessions", {{"upload", upload["id"]}})["mode"], "refine");
  EXPECT_EQ(PostStatus("/api/sessions", {{"upload", "u-9999"}}), 404);
  const Json other = Parsed(Reply("POST", "/api/uploads", "1,2", {{"name", "a.csv"}}));
  EXPECT_EQ(PostStatus("/api/sessions", {{"upload", other["id"]}}), 400);
}

TEST_F(StudioTest, FacesArePinnedAndRemoved) {
  const Json shape = {{"controls", Post("/api/shape/random", {{"seed", 4}})["controls"]}};
  const Json pinned = Post("/api/faces", {{"name", "Ada"}, {"shape", shape}});
  const std::string id = pinned["id"], path = "/api/faces/" + id;
  EXPECT_EQ(pinned["name"], "Ada");
  const Json faces = Get("/api/faces")["faces"];
  EXPECT_TRUE(HasId(faces, id));
  EXPECT_EQ(faces.back()["shape"], shape) << "the last that was pinned";
  EXPECT_EQ(Reply("GET", path + "/vertices").body, Reply("POST", "/api/shape", shape.dump()).body);
  const ApiReply thumbnail = Reply("GET", path + "/thumbnail.png");
  EXPECT_EQ(thumbnail.type, "image/png");
  EXPECT_EQ(render::DecodeImage(thumbnail.body, "thumbnail").width, FaceTray::kThumbnail);
  EXPECT_EQ(Reply("DELETE", path).status, 200);
  for (const char* part : {"", "/vertices", "/thumbnail.png"}) EXPECT_NE(Reply("GET", path + part).status, 200) << part;
  EXPECT_EQ(Reply("DELETE", path).status, 404);
  EXPECT_EQ(PostStatus("/api/faces", Json::object()), 400);
}

TEST_F(StudioTest, AShapeIsItsFace) {
  const Json shape = Get("/api/shape");
  EXPECT_EQ(shape["expressions"].size(), 52u);
  const ApiReply mean = Reply("POST", "/api/shape", "{}");
  EXPECT_EQ(mean.type, "application/octet-stream");
  EXPECT_EQ(mean.body.size(), NumBytes());
  EXPECT_EQ(Reply("POST", "/api/shape", R"({"base": "mean", "caricature": 0})").body, mean.body);
  EXPECT_NE(Reply("POST", "/api/shape", R"({"expressions": {"jawOpen": 1}})").body, mean.body);
  const ApiReply unknown = Reply("POST", "/api/shape", R"({"expresions": {}})");
  EXPECT_EQ(unknown.status, 400);
  EXPECT_NE(unknown.body.find("did you mean 'expressions'?"), std::string::npos);
  EXPECT_EQ(Reply("POST", "/api/shape", R"({"base": "f-9999"})").status, 404);
  EXPECT_EQ(Reply("POST", "/api/shape", "[]").status, 400);
}

TEST_F(StudioTest, RandomShapesHaveASeed) {
  const Json first = Post("/api/shape/random", {{"seed", 1}, {"spread", 0.5}});
  EXPECT_EQ(Post("/api/shape/random", {{"seed", 1}}), first);
  EXPECT_NE(Post("/api/shape/random", {{"seed", 2}}), first);
  EXPECT_EQ(PostStatus("/api/shape", first), 200) << "it is part of a document";
  for (const Json& body : {Json{{"seed", -1}}, Json{{"seed", "a"}}, Json{{"spread", 3}}, Json{{"sede", 1}}})
    EXPECT_EQ(PostStatus("/api/shape/random", body), 400) << body;
}

TEST_F(StudioTest, UploadsAreGivenBack) {
  const std::string bytes("a\0\xff", 3);
  const Json upload = Parsed(Reply("POST", "/api/uploads", bytes, {{"name", "../x.bin"}}));
  EXPECT_EQ(upload["name"], "x.bin");
  EXPECT_EQ(Reply("GET", "/api/uploads/" + upload["id"].get<std::string>()).body, bytes);
  EXPECT_EQ(Parsed(Reply("POST", "/api/uploads", "x"))["name"], "file");
  EXPECT_EQ(Reply("POST", "/api/uploads", "", {{"name", "a.png"}}).status, 400);
  EXPECT_EQ(Reply("GET", "/api/uploads/u-9999").status, 404);
  EXPECT_EQ(Reply("GET", "/api/uploads/..").status, 404);
}

TEST_F(StudioTest, AJobsFilesAreFetched) {
  const Json job = Post("/api/jobs", {{"do", "mesh"}, {"shape", Json::object()}, {"format", "ply"}});
  const std::string id = job["id"];
  EXPECT_EQ(job["do"], "mesh");
  const Json ended = Ended(id);
  ASSERT_EQ(ended["state"], "done") << ended;
  EXPECT_EQ(ended["files"][0]["name"], "face.ply");
  const std::string files = "/api/jobs/" + id + "/files/";
  EXPECT_EQ(Reply("GET", files + "face.ply").body.substr(0, 3), "ply");
  for (const char* name :
       {"", "../", "../../sessions/s-0007/about.json", ".child/child.err", "face.obj", "/etc/passwd"})
    EXPECT_EQ(Reply("GET", files + name).status, 404) << name;
  EXPECT_EQ(Reply("DELETE", "/api/jobs/" + id).status, 200);
  EXPECT_EQ(Get("/api/jobs/" + id)["state"], "done");
  EXPECT_EQ(Reply("GET", "/api/jobs/j-9999").status, 404);
  EXPECT_EQ(PostStatus("/api/jobs", {{"do", "nothing"}}), 400);
}

TEST_F(StudioTest, AJobThatFailsSaysWhy) {
  const Json ended = Ended(Post("/api/jobs", {{"do", "head"}, {"shape", Json::object()}})["id"]);
  EXPECT_EQ(ended["state"], "failed");
  EXPECT_EQ(ended["error"], std::string(testing::kNoProgram) + " is not there any more. Start the studio again");
  EXPECT_EQ(ended["command"], "daumier rig face.obj --out head.glb --names arkit --json");
}

TEST_F(StudioTest, ATrackerDrivesAHead) {
  EXPECT_EQ(Reply("GET", "/api/drive").status, 204) << "nothing has come yet";
  EXPECT_EQ(PostStatus("/api/drive", {{"weights", {{"jawOpen", 0.25}}}}), 200);
  Json drive = Get("/api/drive");
  EXPECT_NEAR(drive["weights"]["jawOpen"], 0.25, 1e-6);
  EXPECT_GE(drive["age_ms"], 0);
  EXPECT_LT(drive["age_ms"], 10'000);
  constexpr char kMediaPipe[] =
      R"({"faceBlendshapes": [{"categories": [{"categoryName": "mouthPucker", "score": 0.5}]}]})";
  EXPECT_EQ(Reply("POST", "/api/drive", kMediaPipe).status, 200);
  EXPECT_NEAR(Get("/api/drive")["weights"]["mouthPucker"], 0.5, 1e-6);
  for (const char* body : {"", "{", "3", R"({"weights": {"jawOpen": "wide"}})", "[]"})
    EXPECT_EQ(Reply("POST", "/api/drive", body).status, 400) << body;
  EXPECT_NEAR(Get("/api/drive")["weights"]["mouthPucker"], 0.5, 1e-6) << "what is refused changes nothing";

  EXPECT_EQ(Reply("GET", "/api/live_link").status, 204) << "off unless it is wanted";
  testing::ShippedStudio::Get().studio().ReceiveLiveLink({});
  EXPECT_EQ(Get("/api/live_link")["address"], "127.0.0.1");
  std::vector<float> values(61, 0.0f);
  values[17] = 0.75f;
  const testing::UdpSender sender(Get("/api/live_link")["port"].get<int>());
  sender.Send(testing::LiveLinkBytes(values));
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (Get("/api/drive")["weights"]["jawOpen"] != 0.75 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  drive = Get("/api/drive");
  EXPECT_EQ(drive["weights"].size(), 52u);
  EXPECT_EQ(drive["weights"]["jawOpen"], 0.75);
  EXPECT_EQ(drive["weights"]["mouthPucker"], 0);
}

TEST_F(StudioTest, IsCalledFromSeveralThreads) {
  const std::string shared = NewSession({{"begin", "mean"}});
  constexpr int kThreads = 4;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        const std::string own = NewSession({{"begin", "mean"}});
        const Json event = {{"do", "draw"}, {"points", {{10 * thread, 5}, {10 * thread + 6, 5}}}};
        for (const std::string& id : {shared, own})
          EXPECT_EQ(Post("/api/sessions/" + id + "/events", event)["changed"], true);
        EXPECT_EQ(Get("/api/sessions/" + own)["revision"], 1);
        const Json controls = Post("/api/shape/random", {{"seed", thread}});
        const std::string face = Post("/api/faces", {{"shape", controls}})["id"];
        EXPECT_EQ(Reply("GET", "/api/faces/" + face + "/vertices").body,
                  Reply("POST", "/api/shape", controls.dump()).body);
        Get("/api/sessions");
        EXPECT_EQ(Reply("DELETE", "/api/faces/" + face).status, 200);
      });
  }
  EXPECT_EQ(Get("/api/sessions/" + shared)["revision"], kThreads);
}

}  // namespace
}  // namespace daumier::studio

// `daumier studio` as its users run it.
#include "core/files.h"
#include "core/json.h"
#include "studio/server.h"
#include "tests/cli/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

extern char** environ;

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

/// A studio that runs. It is killed with its owner.
class RunningStudio {
 public:
  explicit RunningStudio(const std::vector<std::string>& options) {
    std::vector<std::string> words = Command({"studio", "--no-browser"});
    words.insert(words.end(), options.begin(), options.end());
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string out = folder_ / "out", err = folder_ / "err";
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT, 0600);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int failed = posix_spawn(&child_, pointers[0], &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    DAUMIER_CHECK(failed == 0, "{} did not start", words[0]);
  }
  ~RunningStudio() {
    if (child_ > 0) EndBy(SIGKILL);
  }
  RunningStudio(const RunningStudio&) = delete;
  RunningStudio& operator=(const RunningStudio&) = delete;

  /// What it has printed once a line is whole.
  std::string Address() const {
    const auto deadline = std::chrono::steady_clock::now() + 30s;
    while (std::chrono::steady_clock::now() < deadline) {
      const std::string out = fs::exists(folder_ / "out") ? ReadFile(folder_ / "out") : "";
      if (out.starts_with("studio: ") && out.ends_with("\n")) return out.substr(8, out.size() - 9);
      std::this_thread::sleep_for(10ms);
    }
    ADD_FAILURE() << "no address: " << Errors();
    return "http://127.0.0.1:1/#token=";
  }
  std::string Errors() const { return ReadFile(folder_ / "err"); }

  Json Get(const std::string& path) const { return Parsed(Client().Get(path, Token())); }
  Json Post(const std::string& path, const Json& body) const {
    return Parsed(Client().Post(path, Token(), body.dump(), "application/json"));
  }
  std::string Bytes(const std::string& path) const {
    const auto result = Client().Get(path, Token());
    return result ? result->body : "";
  }
  /// The job when it has ended.
  Json Job(const Json& body) const {
    const std::string path = "/api/jobs/" + Post("/api/jobs", body)["id"].get<std::string>();
    const auto deadline = std::chrono::steady_clock::now() + 60s;
    Json job = Get(path);
    while ((job["state"] == "queued" || job["state"] == "running") && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(20ms);
      job = Get(path);
    }
    return job;
  }

  /// Its exit code, or minus the signal that ended it. It is killed where it has not ended after 10 s.
  int EndBy(int signal) {
    kill(child_, signal);
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    int status = 0;
    while (waitpid(child_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() > deadline) kill(child_, SIGKILL);
      std::this_thread::sleep_for(5ms);
    }
    child_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  httplib::Client Client() const {
    const std::string address = Address();
    httplib::Client client(address.substr(0, address.find("/#")));
    client.set_read_timeout(30);
    return client;
  }
  httplib::Headers Token() const {
    const std::string address = Address();
    return {{"Authorization", "Bearer " + address.substr(address.find('=') + 1)}};
  }
  static Json Parsed(const httplib::Result& result) {
    EXPECT_TRUE(result) << httplib::to_string(result.error());
    if (!result) return Json::object();
    EXPECT_EQ(result->status, 200) << result->body;
    return Json::parse(result->body);
  }

  const TempDir folder_;
  pid_t child_ = 0;
};

class StudioCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!studio::HasPage()) GTEST_SKIP() << "the program has no page: npm's packages are not installed (./dev setup)";
  }
  std::vector<std::string> InFolder() const { return {"--folder", (folder_ / "mine").string()}; }

  const TempDir folder_;
};

TEST_F(StudioCommand, PrintsItsAddressAndServesUntilItIsEnded) {
  RunningStudio studio(InFolder());
  EXPECT_THAT(studio.Address(), MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/#token=[0-9a-f]+"));
  EXPECT_EQ(studio.Get("/api/info")["can"], (Json{{"gestures", true}, {"portraits", true}}));
  EXPECT_THAT(studio.Bytes("/"), HasSubstr("<html"));
  std::vector<std::string> examples;
  const Json list = studio.Get("/api/examples");
  for (const Json& example : list["examples"]) examples.push_back(example["name"]);
  EXPECT_THAT(examples, ::testing::Contains("front"));
  EXPECT_EQ(studio.EndBy(SIGTERM), 0) << studio.Errors();
  EXPECT_EQ(studio.Errors(), "") << "it is quiet";
}

TEST_F(StudioCommand, CtrlCEndsItToo) {
  RunningStudio studio(InFolder());
  studio.Get("/api/info");
  EXPECT_EQ(studio.EndBy(SIGINT), 0) << studio.Errors();
}

TEST_F(StudioCommand, IsEndedWhileItOpens) {
  RunningStudio studio(InFolder());
  const auto deadline = std::chrono::steady_clock::now() + 30s;
  while (!fs::exists(folder_ / "mine" / "sessions") && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(2ms);
  EXPECT_EQ(studio.EndBy(SIGTERM), 0) << "it was killed where it had not ended after 10 s";
}

TEST_F(StudioCommand, TwoOnOneFolderAreRefused) {
  RunningStudio studio(InFolder());
  const std::string address = studio.Address();
  const ProcessResult second = Daumier({"studio", "--no-browser", "--folder", (folder_ / "mine").string()});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.err, HasSubstr("another studio has this folder open"));
  EXPECT_EQ(second.out, "");
  EXPECT_EQ(studio.Get("/api/sessions")["sessions"], Json::array());
}

TEST_F(StudioCommand, ATakenPortAndOthersAreRefused) {
  RunningStudio studio(InFolder());
  const std::string address = studio.Address();
  const size_t colon = address.rfind(':');
  const std::string port = address.substr(colon + 1, address.find('/', colon) - colon - 1);
  const auto refused = [&](const std::string& number) {
    const ProcessResult result =
        Daumier({"studio", "--no-browser", "--folder", (folder_ / "other").string(), "--port", number});
    EXPECT_EQ(result.exit_code, 2) << number;
    return result.err;
  };
  EXPECT_THAT(refused(port), HasSubstr("port " + port + " is taken"));
  EXPECT_THAT(refused("65536"), HasSubstr("--port"));
  EXPECT_THAT(refused("-1"), HasSubstr("--port"));
}

TEST_F(StudioCommand, DrawingsOutliveAProgramThatIsKilled) {
  std::string id;
  Json before;
  {
    RunningStudio studio(InFolder());
    id = studio.Post("/api/sessions", {{"begin", "mean"}, {"name", "Zoë"}})["id"];
    studio.Post("/api/sessions/" + id + "/events", {{"do", "draw"}, {"points", {{5, 5}, {20, 5}}}});
    before = studio.Get("/api/sessions/" + id);
    EXPECT_EQ(studio.EndBy(SIGKILL), -SIGKILL);
  }
  RunningStudio studio(InFolder());
  EXPECT_EQ(studio.Get("/api/sessions/" + id), before);
}

TEST_F(StudioCommand, KeepsThingsInTheUsersFolderOfData) {
  const char* const data = std::getenv("XDG_DATA_HOME");
  const std::string old = data ? data : "";
  setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
  {
    RunningStudio studio({});
    studio.Get("/api/info");
  }
  data ? setenv("XDG_DATA_HOME", old.c_str(), 1) : unsetenv("XDG_DATA_HOME");
  EXPECT_TRUE(fs::is_directory(folder_ / "daumier" / "studio" / "sessions"));
}

TEST_F(StudioCommand, AJobIsTheProgramItself) {
  RunningStudio studio(InFolder());
  const Json job = studio.Job({{"do", "head"}, {"shape", Json::object()}});
  ASSERT_EQ(job["state"], "done") << job;
  EXPECT_EQ(job["command"], "daumier rig face.obj --out head.glb --names arkit --json");
  EXPECT_TRUE(job["result"].is_object());
  const std::string id = job["id"];
  EXPECT_EQ(studio.Bytes("/api/jobs/" + id + "/files/head.glb").substr(0, 4), "glTF");
}

TEST_F(StudioCommand, AJobThatFailsHasTheProgramsSentence) {
  RunningStudio studio(InFolder());
  const Json job = studio.Job(
      {{"do", "head"}, {"shape", Json::object()}, {"options", {{"hair", "bob"}, {"hair_colour", "nothing"}}}});
  EXPECT_EQ(job["state"], "failed");
  EXPECT_THAT(job["error"].get<std::string>(), StartsWith("--hair-colour nothing: is no colour"));
  EXPECT_EQ(job["files"], Json::array());
}

TEST_F(StudioCommand, AJobEndsWithTheStudio) {
  RunningStudio studio(InFolder());
  const Json job = studio.Post(
      "/api/jobs", {{"do", "turntable"}, {"shape", Json::object()}, {"options", {{"frames", 120}, {"size", 2048}}}});
  EXPECT_EQ(job["do"], "turntable");
  EXPECT_EQ(studio.EndBy(SIGTERM), 0) << studio.Errors();
}

}  // namespace
}  // namespace daumier::testing

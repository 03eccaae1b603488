#include "systems/predict_inputs.h"

#include "core/error.h"
#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <new>
#include <stop_token>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

/// As many drawings as the file has bytes; none is an error.
std::vector<Input> ReadBytes(const fs::path& file) {
  const std::string bytes = ReadFile(file);
  DAUMIER_CHECK(!bytes.empty(), "it is empty");
  return std::vector<Input>(bytes.size(), render::Drawing{});
}

class PredictInputsTest : public ::testing::Test {
 protected:
  PredictInputsTest() {
    system_.name = "portrait";
    system_.read_inputs = ReadBytes;
    system_.input_extensions = {".svg", ".png"};
  }
  fs::path Write(const fs::path& name, const std::string& bytes = "x") const {
    MakeDirectory((folder_ / name).parent_path());
    WriteFileAtomically(folder_ / name, bytes);
    return folder_ / name;
  }

  const testing::TempDir folder_;
  System system_;
};

TEST_F(PredictInputsTest, AFolderStandsForItsInputsByName) {
  for (const char* name : {"b.svg", "a.PNG", "._a.png", ".c.svg", "notes.txt", "deep/d.svg", "manifest.json"})
    Write(fs::path("drawings") / name);
  MakeDirectory(folder_ / "drawings/e.svg");  // A folder.
  fs::create_symlink(folder_ / "drawings/b.svg", folder_ / "drawings/link.svg");
  const fs::path in = folder_ / "drawings", alone = folder_ / "absent.svg";
  EXPECT_EQ(ExpandInputFolders(system_, {alone, in, in / "b.svg"}),
            (std::vector<fs::path>{alone, in / "a.PNG", in / "b.svg", in / "link.svg", in / "b.svg"}));
  EXPECT_EQ(ExpandInputFolders(system_, {in / ""}).size(), 3u);
  MakeDirectory(folder_ / "empty");
  ExpectError([&] { ExpandInputFolders(system_, {folder_ / "empty"}); }, "holds no input (expected files .svg, .png)");
}

TEST_F(PredictInputsTest, ALackOfMemoryIsSaidInWords) {
  const PredictionFailure failure = FailureOf("large.png", std::bad_alloc());
  EXPECT_EQ(failure.cause, "large.png: there is not enough memory for it. Free some, or make it smaller");
}

TEST_F(PredictInputsTest, SkippedFilesAreCountedByKind) {
  for (const char* name : {"b.svg", "a.PNG", "._a.png", ".DS_Store", "deep/d.pdf", "manifest.json"})
    Write(fs::path("drawings") / name);
  EXPECT_EQ(SkippedFilesText(system_, folder_ / "drawings"), "");
  Write("drawings/one.pdf");
  EXPECT_EQ(SkippedFilesText(system_, folder_ / "drawings"), "1 file skipped (.pdf 1)");
  for (const char* name : {"two.PDF", "notes.txt", "README"}) Write(fs::path("drawings") / name);
  EXPECT_EQ(SkippedFilesText(system_, folder_ / "drawings"),
            "4 files skipped (.pdf 2, .txt 1, without an extension 1)");
}

TEST_F(PredictInputsTest, InputsOfTheSameNameAreNumbered) {
  const PredictionInputs read =
      ReadPredictionInputs(system_, {Write("a/face.svg", "xx"), Write("b/Face.svg"), Write("c/face-2.svg")});
  std::vector<std::string> names;
  for (const PredictionInput& input : read.inputs) names.push_back(input.name);
  EXPECT_EQ(names, (std::vector<std::string>{"face", "face-2", "Face-3", "face-2-2"}));
  EXPECT_EQ(read.inputs[1].file, folder_ / "a/face.svg");
}

TEST_F(PredictInputsTest, AFileThatCannotBeReadIsAFailureThatNamesIt) {
  const fs::path empty = Write("empty.svg", ""), absent = folder_ / "absent.svg", good = Write("good.svg");
  const PredictionInputs read = ReadPredictionInputs(system_, {empty, good, absent});
  ASSERT_EQ(read.inputs.size(), 1u);
  EXPECT_EQ(read.inputs[0].name, "good");
  ASSERT_EQ(read.failures.size(), 2u);
  EXPECT_EQ(read.failures[0].cause, empty.string() + ": it is empty");
  EXPECT_EQ(read.failures[1].file, absent);
  EXPECT_EQ(read.failures[1].cause, "cannot read " + absent.string() + ": No such file or directory");
}

TEST_F(PredictInputsTest, APipeIsRefused) {
  const fs::path pipe = folder_ / "pipe.svg";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const PredictionInputs read = ReadPredictionInputs(system_, {pipe});
  ASSERT_EQ(read.failures.size(), 1u);
  EXPECT_EQ(read.failures[0].cause,
            pipe.string() + ": no regular file (a pipe, a socket or a device). Copy it to a file");
}

TEST_F(PredictInputsTest, IsCancelled) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(ReadPredictionInputs(system_, {Write("a.svg")}, Task(source.get_token())), Cancelled);
}

}  // namespace
}  // namespace daumier::systems

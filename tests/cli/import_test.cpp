#include "core/json.h"
#include "geometry/obj.h"
#include "tests/cli/pipeline.h"
#include "tests/support/authors_model.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

/// The program on a checkpoint in the authors' layout.
class ImportCommand : public ::testing::Test {
 protected:
  ImportCommand() { WriteAuthorsFiles(folder_.path()); }
  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  ProcessResult Import(const std::string& checkpoint) const {
    return Daumier({"import", In(checkpoint), "--template", In("template.obj"), "--annotation", In("template.json"),
                    "--out", In("run"), "--json"});
  }

  const TempDir folder_;
};

TEST_F(ImportCommand, MakesARunWhoseFacesAreEdited) {
  const ProcessResult imported = Import("checkpoint.pth");
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_EQ(ParseJson(imported.out, "result").at("training_faces"), 40);
  const ProcessResult random = Daumier({"edit", In("run"), "--random", "2", "--out", In("random")});
  ASSERT_EQ(random.exit_code, 0) << random.err;
  EXPECT_EQ(geometry::ReadObj(folder_ / "random/random_2.obj").vertices.rows(), SyntheticFace().num_vertices());
  const ProcessResult found = Daumier({"edit", In("run"), "--face", In("random/random_1.obj"), "--handle", "30=0,0,0.2",
                                       "--soft", "0.1", "--steps", "1", "--out", In("found")});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const Json edit = ReadJson(folder_ / "found/edit.json");
  EXPECT_EQ(edit.at("model").at("kind"), "hypernetwork");
  EXPECT_LT(edit.at("faces")[0].at("mean_error_mm").get<double>(), 2);
}

TEST_F(ImportCommand, SaysWhatIsWrongWithAFile) {
  const ProcessResult result = Import("template.obj");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("this is no file of PyTorch (torch.save)"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
}

}  // namespace
}  // namespace daumier::testing

// tools/check_layers and tools/check_rooms on small trees with one fault each: a check that cannot fail is none.
#include "core/files.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier {
namespace {

using ::testing::HasSubstr;
using testing::TempDir;

/// A tree of two rooms in good order.
class StructureCheck : public ::testing::Test {
 protected:
  StructureCheck() {
    Write("CMakeLists.txt", "daumier_room(core USES base_libraries)\ndaumier_room(tensor SEES core TORCH USES a b)\n");
    Write("core/a.h", "#pragma once\n#include <vector>\n");
    Write("core/a.cpp", "#include \"core/a.h\"\n");
    Write("tests/core/a_test.cpp", "#include \"core/a.h\"\n#include \"tests/support/b.h\"\n");
    Write("tensor/t.h", "#include \"core/a.h\"\n#include <torch/types.h>\n#include \"embedded/x.h\"\n");
  }

  void Write(const std::string& path, const std::string& text) {
    MakeDirectory((tree_ / path).parent_path());
    WriteFileAtomically(tree_ / path, text);
  }

  testing::ProcessResult Run(const std::string& tool) {
    return testing::RunProcess({(testing::SourceRoot() / "tools" / tool).string(), tree_.path().string()});
  }

  void ExpectFailure(const std::string& tool, const std::string& message) {
    const testing::ProcessResult result = Run(tool);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.out, HasSubstr(message));
    EXPECT_THAT(result.out, HasSubstr("1 failures in"));
  }

  TempDir tree_;
};

TEST_F(StructureCheck, GoodOrderPasses) {
  EXPECT_EQ(Run("check_layers").exit_code, 0) << Run("check_layers").out;
  EXPECT_EQ(Run("check_rooms").exit_code, 0) << Run("check_rooms").out;
}

TEST_F(StructureCheck, LayersRefuseARoomThatMayNotBeSeen) {
  Write("core/a.cpp", "\n  # include  \"tensor/t.h\"\n");
  ExpectFailure("check_layers", "core/a.cpp:2: core may not see tensor: \"tensor/t.h\"");
}

TEST_F(StructureCheck, LayersHoldForTests) {
  Write("tests/core/a_test.cpp", "#include \"tensor/t.h\"\n");
  ExpectFailure("check_layers", "tests/core/a_test.cpp:1: core may not see tensor");
}

TEST_F(StructureCheck, LayersRefuseRelativePaths) {
  Write("tensor/t.h", "#include \"../core/a.h\"\n");
  ExpectFailure("check_layers", "tensor/t.h:1: relative path: \"../core/a.h\"");
}

TEST_F(StructureCheck, LayersRefusePathsThatAreNotFromTheRoot) {
  Write("core/a.cpp", "#include \"a.h\"\n");
  ExpectFailure("check_layers", "core/a.cpp:1: not a path from the root: \"a.h\"");
}

TEST_F(StructureCheck, LayersRefuseUnknownRooms) {
  Write("core/a.cpp", "#include \"cellar/a.h\"\n");
  ExpectFailure("check_layers", "core/a.cpp:1: no such room: \"cellar/a.h\"");
}

TEST_F(StructureCheck, LayersRefuseTestsInTheProduct) {
  Write("core/a.cpp", "#include \"tests/support/b.h\"\n");
  ExpectFailure("check_layers", "core/a.cpp:1: the product includes a test");
}

TEST_F(StructureCheck, LayersRefuseLibTorchInAPlainRoom) {
  Write("core/a.cpp", "#include <ATen/Tensor.h>\n");
  ExpectFailure("check_layers", "core/a.cpp:1: core does not use LibTorch");
}

TEST_F(StructureCheck, MapNamesOnlyRoomsAboveAndInOneLine) {
  Write("CMakeLists.txt", "daumier_room(core SEES tensor)\ndaumier_room(tensor SEES core TORCH)\n");
  ExpectFailure("check_layers", "core sees tensor, which is no room above it");
  Write("CMakeLists.txt", "daumier_room(core)\ndaumier_room(tensor SEES core TORCH\n)\n");
  ExpectFailure("check_layers", "a room has to stand in one line");
}

TEST_F(StructureCheck, RoomsRefuseSourcesWithoutATest) {
  Write("core/deep/b.cpp", "\n");
  ExpectFailure("check_rooms", "core/deep/b.cpp: has no tests/core/deep/b_test.cpp");
  Write("tests/core/deep/b_test.cpp", "");
  EXPECT_EQ(Run("check_rooms").exit_code, 0);
}

TEST_F(StructureCheck, RoomsRefuseAFolderThatIsNotOnTheMap) {
  Write("cellar/b.h", "\n");
  ExpectFailure("check_rooms", "cellar: has files, but is not on the map");
}

TEST_F(StructureCheck, RoomsRefuseARoomWithoutFiles) {
  std::filesystem::remove_all(tree_ / "tensor");
  ExpectFailure("check_rooms", "tensor: on the map, but there are no files");
}

TEST_F(StructureCheck, RoomsRefuseLongFiles) {
  Write("core/long.h", std::string(421, '\n'));
  ExpectFailure("check_rooms", "core/long.h: 421 lines; split it");
}

}  // namespace
}  // namespace daumier

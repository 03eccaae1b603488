// tools/check_layers, check_rooms and check_words on small trees with one fault each: each check has to fail there.
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
    Write("tensor/u.h", "#include \"core/a.h\"\n");
  }

  /// The same tree with nested rooms: systems/ and two sisters in it, one of which has a room with LibTorch inside.
  void NestRooms() {
    Write("CMakeLists.txt",
          "daumier_room(core)\n"
          "daumier_room(tensor SEES core TORCH)\n"
          "daumier_room(systems SEES core)\n"
          "daumier_room(systems/sketch SEES core systems)\n"
          "daumier_room(systems/sketch/train SEES systems/sketch tensor USES x y TORCH)\n"
          "daumier_room(systems/deform SEES systems)\n");
    Write("systems/system.h", "#include \"core/a.h\"\n");
    Write("systems/sketch/run.h", "#include \"core/a.h\"\n#include \"systems/system.h\"\n");
    Write("systems/sketch/deep/run.cpp", "#include \"systems/sketch/run.h\"\n");
    Write("tests/systems/sketch/deep/run_test.cpp", "#include \"systems/sketch/run.h\"\n#include \"core/a.h\"\n");
    Write("systems/sketch/train/recipe.h", "#include <torch/types.h>\n#include \"tensor/t.h\"\n");
    Write("systems/sketch/train/other.h", "#include \"systems/sketch/run.h\"\n");
    Write("systems/deform/run.h", "#include \"systems/system.h\"\n");
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
  ExpectFailure("check_layers", "room core sees tensor, which is not a room above it");
  Write("CMakeLists.txt", "daumier_room(core)\ndaumier_room(tensor SEES core TORCH\n)\n");
  ExpectFailure("check_layers", "daumier_room must be on one line");
}

TEST_F(StructureCheck, MapRefusesARoomTwice) {
  Write("CMakeLists.txt", "daumier_room(core)\ndaumier_room(core)\ndaumier_room(tensor SEES core TORCH)\n");
  ExpectFailure("check_layers", "room core is on the map twice");
}

TEST_F(StructureCheck, LayersRefuseSeesEntriesOfWhichNothingIsIncluded) {
  Write("tensor/t.h", "\n");
  Write("tensor/u.h", "\n");
  ExpectFailure("check_layers", "CMakeLists.txt: room tensor sees core but includes nothing of it");
  Write("tests/tensor/t_test.cpp", "#include \"core/a.h\"\n");
  EXPECT_EQ(Run("check_layers").exit_code, 0) << "its tests use the entry";
}

TEST_F(StructureCheck, LayersRefuseThatAPlainRoomSeesOneWithLibTorch) {
  Write("CMakeLists.txt",
        "daumier_room(core)\ndaumier_room(tensor SEES core TORCH)\ndaumier_room(faces SEES tensor USES a)\n");
  Write("faces/f.h", "#include \"tensor/t.h\"\n");
  ExpectFailure("check_layers", "CMakeLists.txt: room faces without TORCH sees tensor with TORCH");
}

TEST_F(StructureCheck, NestedRoomsInGoodOrderPass) {
  NestRooms();
  EXPECT_EQ(Run("check_layers").exit_code, 0) << Run("check_layers").out;
  EXPECT_EQ(Run("check_rooms").exit_code, 0) << Run("check_rooms").out;
}

TEST_F(StructureCheck, LayersRefuseASisterRoom) {
  NestRooms();
  Write("systems/sketch/deep/run.cpp", "\n#include \"systems/deform/run.h\"\n");
  ExpectFailure("check_layers",
                "systems/sketch/deep/run.cpp:2: systems/sketch may not see systems/deform: \"systems/deform/run.h\"");
}

TEST_F(StructureCheck, LayersHoldForTestsOfNestedRooms) {
  NestRooms();
  Write("tests/systems/sketch/deep/run_test.cpp", "#include \"systems/deform/run.h\"\n");
  ExpectFailure("check_layers", "run_test.cpp:1: systems/sketch may not see systems/deform");
}

TEST_F(StructureCheck, LayersRefuseTheRoomInsideARoom) {
  NestRooms();
  Write("systems/sketch/deep/run.cpp", "#include \"systems/sketch/train/recipe.h\"\n");
  ExpectFailure("check_layers", "systems/sketch may not see systems/sketch/train");
}

TEST_F(StructureCheck, LibTorchOfARoomIsNotThatOfTheRoomAroundIt) {
  NestRooms();
  Write("systems/sketch/deep/run.cpp", "#include <torch/types.h>\n");
  ExpectFailure("check_layers", "systems/sketch/deep/run.cpp:1: systems/sketch does not use LibTorch");
}

TEST_F(StructureCheck, LayersRefuseUnusedEntriesOfNestedRooms) {
  NestRooms();
  Write("systems/sketch/train/other.h", "\n");
  ExpectFailure("check_layers", "room systems/sketch/train sees systems/sketch but includes nothing of it");
}

TEST_F(StructureCheck, RoomsRefuseANestedFolderThatIsNotOnTheMap) {
  Write("studio/pages/b.h", "\n");
  ExpectFailure("check_rooms", "studio/pages: has files, but is not on the map");
}

TEST_F(StructureCheck, RoomsRefuseANestedRoomWithoutFiles) {
  NestRooms();
  std::filesystem::remove_all(tree_ / "systems/sketch/train");
  ExpectFailure("check_rooms", "systems/sketch/train: on the map, but there are no files");
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

TEST_F(StructureCheck, WordsMayNotExceedTheBaseline) {
  // The literals are split so that this file has no hit itself.
  Write("core/a.h",
        "// T"
        "ells what it knew_not; an unknown standard.\n// It go"
        "es\n// on, and it went"
        " on.\n");
  Write("core/data.json",
        "{\"t"
        "old\": 1}");
  Write("tools/word_baseline", "2\n");
  const testing::ProcessResult equal = Run("check_words");
  EXPECT_EQ(equal.exit_code, 0) << equal.out;
  EXPECT_THAT(equal.out, HasSubstr("2 banned words in"));
  EXPECT_THAT(equal.out, ::testing::Not(HasSubstr("lower it")));

  Write("tools/word_baseline", "1\n");
  EXPECT_EQ(Run("check_words").exit_code, 1);
  EXPECT_THAT(Run("check_words").out, HasSubstr("2 banned words in"));

  Write("tools/word_baseline", "3\n");
  EXPECT_EQ(Run("check_words").exit_code, 0);
  EXPECT_THAT(Run("check_words").out, HasSubstr("tools/word_baseline is 3; lower it to 2"));
}

TEST_F(StructureCheck, WordsNeedABaseline) {
  EXPECT_EQ(Run("check_words").exit_code, 1);
  EXPECT_THAT(Run("check_words").out, HasSubstr("tools/word_baseline is missing"));
}

}  // namespace
}  // namespace daumier

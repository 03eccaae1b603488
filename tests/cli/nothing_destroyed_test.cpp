// No verb writes over what it reads, or into a folder that is not its own.
#include "core/files.h"
#include "core/json.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "geometry/obj.h"
#include "tests/cli/pipeline.h"
#include "tests/geometry/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Content of every file below a folder, by name.
std::map<std::string, std::string> BytesBelow(const fs::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    bytes[fs::relative(entry.path(), folder)] = entry.is_regular_file() ? ReadFile(entry.path()) : "";
  return bytes;
}

void WriteRunFolder(const fs::path& run) {
  MakeDirectory(run / "best");
  WriteFileAtomically(run / kBestFile, "weights");
  WriteFileAtomically(ResolvedConfig(run), "system = \"sketch\"\n");
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.details["system"] = "sketch";
  manifest.checksums[kBestFile] = Sha256("weights");
  WriteManifest(run, manifest);
}

/// Inputs of every verb, as far as verbs read them before they write.
void WriteInputs(const fs::path& folder) {
  WriteRunFolder(folder / "run");
  WriteFileAtomically(folder / "face.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0L9 9\"/></svg>");
  WriteFileAtomically(folder / "letter.txt", "precious");
  geometry::WriteObj(folder / "head.obj", Sphere(1, 3));
  Json landmarks = Json::array();
  for (int l = 0; l < 68; ++l) landmarks.push_back(l % 8);
  WriteFileAtomically(folder / "landmarks.json", landmarks.dump());
  for (const char* kind : {"faces", "sketches"}) {
    MakeDirectory(folder / kind);
    WriteManifest(folder / kind, {.kind = kind, .verb = "dataset"});
  }
  WriteFileAtomically(folder / "table.toml", "base = \"demo.toml\"\n[[rows]]\nname = \"a\"\n");
}

struct WritingVerb {
  std::string kind;  ///< Of its folder.
  /// Without --out; `in` holds the inputs.
  std::function<std::vector<std::string>(const fs::path& in)> command;
};

const std::vector<WritingVerb>& WritingVerbs() {
  using Words = std::vector<std::string>;
  static const std::vector<WritingVerb> verbs = {
      {"faces",
       [](const fs::path& in) {
         return Words{"dataset", "faces", "source.path=" + (in / "faces").string()};
       }},
      {"sketches",
       [](const fs::path& in) {
         return Words{"dataset", "sketches", "faces=" + (in / "faces").string()};
       }},
      {"points",
       [](const fs::path& in) {
         return Words{"dataset", "points", "faces=" + (in / "faces").string()};
       }},
      {"gallery",
       [](const fs::path& in) {
         return Words{"dataset", "gallery", in / "faces", in / "sketches"};
       }},
      {"faces",
       [](const fs::path& in) {
         return Words{"register", in / "head.obj", "--landmarks", in / "landmarks.json"};
       }},
      {"run",
       [](const fs::path& in) {
         return Words{"import", in / "head.obj", "--template", in / "head.obj", "--annotation", in / "landmarks.json"};
       }},
      {"run",
       [](const fs::path& in) {
         return Words{"train", SourceRoot() / "configs/sketch/demo.toml", "data.faces=" + (in / "faces").string(),
                      "data.sketches=" + (in / "sketches").string()};
       }},
      {"ablation",
       [](const fs::path& in) {
         return Words{"ablate", in / "table.toml"};
       }},
      {"report",
       [](const fs::path& in) {
         return Words{"eval", in / "run"};
       }},
      {"predictions",
       [](const fs::path& in) {
         return Words{"predict", in / "run", in / "face.svg"};
       }},
      {"export",
       [](const fs::path& in) {
         return Words{"export", in / "run"};
       }},
      {"weights",
       [](const fs::path& in) {
         return Words{"export", in / "run", "--weights"};
       }},
      {"weights", [](const fs::path& in) {
         return Words{"dataset", "model", "source.path=" + (in / "faces").string()};
       }}};
  return verbs;
}

/// Each verb with one of `outs` in turn: how paths are compared is tested in core/.
void ForEachVerb(const std::vector<std::string>& outs,
                 const std::function<void(const WritingVerb& verb, const std::string& out)>& action) {
  size_t turn = 0;
  for (const WritingVerb& verb : WritingVerbs()) action(verb, outs[turn++ % outs.size()]);
}

std::string NameOf(const WritingVerb& verb) {
  const std::vector<std::string> words = verb.command("");
  return words[0] == "dataset" ? words[0] + " " + words[1] : words[0];
}

/// Expects that the verb refuses `out` and changes no byte below `folder`.
void ExpectRefused(const WritingVerb& verb, const fs::path& in, const std::string& out, const fs::path& folder) {
  const auto before = BytesBelow(folder);
  std::vector<std::string> arguments = verb.command(in);
  arguments.insert(arguments.end(), {"--out", out});
  const ProcessResult result = Daumier(arguments);
  EXPECT_EQ(result.exit_code, 2) << NameOf(verb) << " --out " << out << ": " << result.err;
  EXPECT_EQ(BytesBelow(folder), before) << NameOf(verb) << " --out " << out;
}

TEST(NothingIsDestroyed, AFolderThatHoldsTheInputs) {
  const TempDir folder;
  const fs::path in = folder / "mine";
  WriteInputs(in);
  fs::create_directory_symlink(in, folder / "link");
  ForEachVerb({"mine", "mine/", "link", "mine/run/.."}, [&](const WritingVerb& verb, const std::string& out) {
    ExpectRefused(verb, in, (folder.path() / out).string(), folder.path());
  });
}

TEST(NothingIsDestroyed, AFolderOfAnotherKindOrOfAnotherProgram) {
  const TempDir folder;
  WriteInputs(folder / "in");
  MakeDirectory(folder / "other");
  WriteFileAtomically(folder / "other/letter.txt", "precious");
  MakeDirectory(folder / "web");
  WriteFileAtomically(folder / "web/manifest.json", "{\"name\": \"app\"}");
  MakeDirectory(folder / "session");
  WriteManifest(folder / "session", {.kind = "session"});
  const auto expect = [&](const WritingVerb& verb, const std::string& out) {
    ExpectRefused(verb, folder / "in", (folder.path() / out).string(), folder.path());
  };
  ForEachVerb({"other", "session", "web", "in/run/best", "in/landmarks.json"}, expect);
}

/// The run, the faces, the sketches are folders of a kind of their own.
TEST(NothingIsDestroyed, AnInputItself) {
  const TempDir folder;
  WriteInputs(folder / "in");
  ForEachVerb({"run", "faces", "sketches"}, [&](const WritingVerb& verb, const std::string& out) {
    if (out != verb.kind) ExpectRefused(verb, folder / "in", folder / "in" / out, folder.path());
  });
}

TEST(NothingIsDestroyed, AnInputInAFolderOfTheVerbItself) {
  for (const WritingVerb& verb : WritingVerbs()) {
    if (verb.kind == "ablation") continue;  // It reads its config alone, and writes no file of such a name.
    const TempDir folder;
    WriteInputs(folder / "own");
    WriteManifest(folder / "own", {.kind = verb.kind});
    ExpectRefused(verb, folder / "own", folder / "own", folder.path());
  }
}

TEST(NothingIsDestroyed, AFileInAReplacedFolderThatTheVerbDidNotWrite) {
  const TempDir folder;
  WriteInputs(folder / "in");
  for (const WritingVerb& verb : WritingVerbs()) {
    if (verb.kind != "report" && verb.kind != "export" && verb.kind != "weights") continue;
    const fs::path out = folder / verb.kind;
    fs::remove_all(out);
    MakeDirectory(out);
    WriteManifest(out, {.kind = verb.kind});
    WriteFileAtomically(out / "notes.txt", "precious");
    ExpectRefused(verb, folder / "in", out, folder.path());
  }
}

TEST(NothingIsDestroyed, ByDraw) {
  const TempDir folder;
  const std::string mesh = folder / "head.obj", out = folder / "head.svg", picture = folder / "head.png";
  geometry::WriteObj(mesh, Sphere(2, 3));
  const std::string before = ReadFile(mesh);
  fs::create_symlink(mesh, folder / "link.svg");
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--force"}}) {
    std::vector<std::string> arguments{"draw", mesh, "--out", folder / "link.svg"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult onto_itself = Daumier(arguments);
    EXPECT_EQ(onto_itself.exit_code, 2);
    EXPECT_THAT(onto_itself.err, HasSubstr("is the input"));
  }
  EXPECT_EQ(ReadFile(mesh), before);
  WriteFileAtomically(out, "<svg><!-- mine --></svg>");
  WriteFileAtomically(picture, "mine");
  for (const std::string& file : {out, picture}) {
    const std::string mine = ReadFile(file);
    const ProcessResult result = Daumier({"draw", mesh, "--out", file});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("--force"));
    EXPECT_EQ(ReadFile(file), mine);
    EXPECT_EQ(Daumier({"draw", mesh, "--out", file, "--force"}).exit_code, 0);
    EXPECT_NE(ReadFile(file), mine);
  }
  EXPECT_EQ(Daumier({"draw", mesh, "--out", out}).exit_code, 0) << "an SVG of its own";
  const ProcessResult nowhere = Daumier({"draw", mesh, "--out", folder / "absent/head.svg"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("is no folder"));
}

}  // namespace
}  // namespace daumier::testing

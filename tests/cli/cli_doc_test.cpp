#include "core/files.h"
#include "tests/cli/pipeline.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace daumier::testing {
namespace {

const std::vector<std::string> kCommands = {"dataset faces",
                                            "dataset sketches",
                                            "dataset points",
                                            "dataset portraits",
                                            "dataset gestures",
                                            "dataset model",
                                            "dataset gallery",
                                            "dataset stats",
                                            "dataset controls",
                                            "register",
                                            "import",
                                            "train",
                                            "eval",
                                            "ablate",
                                            "predict",
                                            "edit",
                                            "score",
                                            "benchmark make",
                                            "benchmark check",
                                            "benchmark baseline",
                                            "benchmark rows",
                                            "draw",
                                            "rig",
                                            "avatar",
                                            "studio",
                                            "export",
                                            "info"};

std::vector<std::string> Words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// docs/cli.md: the help of every command.
std::string CommandLineDocument() {
  std::string document =
      "# Command line\n\nThe help of every command, as `daumier COMMAND --help` prints it. Every command also takes "
      "`--quiet` and\n`--threads N` (`daumier --help`).\n\n"
      "| exit code | meaning |\n|---|---|\n"
      "| 0 | done |\n"
      "| 1 | the work failed or was interrupted, or at least one of several inputs failed; the others are written |\n"
      "| 2 | the command line or a config is wrong |\n\n"
      "Results go to stdout; progress, warnings and errors go to stderr. A warning does not change the exit code. For "
      "example,\n`predict` warns if a sheet holds several faces: it predicts the largest one, and each with "
      "`--all`.\n\n"
      "A test compares this page with the program; `DAUMIER_WRITE_DOCS=1 ctest --test-dir build/release -R '^cli$'` "
      "writes it.\n";
  for (const std::string& command : kCommands) {
    std::vector<std::string> arguments = Words(command);
    arguments.push_back("--help");
    const ProcessResult help = Daumier(arguments);
    EXPECT_EQ(help.exit_code, 0) << command << ": " << help.err;
    std::string text = help.out;
    text.erase(text.find_last_not_of('\n') + 1);
    document += fmt::format("\n## daumier {}\n\n```text\n{}\n```\n", command, text);
  }
  return document;
}

TEST(CommandLineDocument, IsTheHelpOfEveryCommand) {
  const std::filesystem::path page = SourceRoot() / "docs/cli.md";
  const std::string document = CommandLineDocument();
  if (std::getenv("DAUMIER_WRITE_DOCS") != nullptr) WriteFileAtomically(page, document);
  EXPECT_EQ(ReadFile(page), document);
}

TEST(CommandLineDocument, HasEveryVerb) {
  std::istringstream lines(Daumier({"--help"}).out);
  std::string line;
  while (std::getline(lines, line) && line != "Subcommands:") {
  }
  int num_verbs = 0;
  while (std::getline(lines, line)) {
    const std::vector<std::string> words = Words(line);
    if (words.empty()) continue;
    ++num_verbs;
    const bool found = std::any_of(kCommands.begin(), kCommands.end(),
                                   [&](const std::string& command) { return Words(command)[0] == words[0]; });
    EXPECT_TRUE(found) << words[0];
  }
  EXPECT_GT(num_verbs, 5);
}

}  // namespace
}  // namespace daumier::testing

#include "cli/program.h"

#include "cli/verb.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "core/runtime.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace daumier::cli {
namespace {

constexpr int kDone = 0, kFailed = 1, kMisused = 2;

/// What is wrong, the help of the option that it is about, and where the rest of the help is.
std::string FailureText(const CLI::App* app, const CLI::Error& error) {
  const CLI::App* command = app;
  std::string name = app->get_name();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  const std::string what = error.what();
  std::string text = fmt::format("{}: {}\n", name, what);
  for (const CLI::Option* option : command->get_options()) {
    if (what.starts_with(option->get_name() + ":") || what.starts_with(option->get_name() + " "))
      text += fmt::format("  {}  {}\n", option->get_name(), option->get_description());
  }
  return text + fmt::format("See {} --help\n", name);
}

/// The words of the command line, last first. An axis such as -z behind an option is its value, not a short option.
std::vector<std::string> ReversedWords(int argc, char** argv) {
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool is_axis = word == "-x" || word == "-y" || word == "-z";
    if (is_axis && !words.empty() && (words.back() == "--up" || words.back() == "--front")) {
      words.back() += "=" + word;
    } else {
      words.push_back(word);
    }
  }
  std::reverse(words.begin(), words.end());
  return words;
}

}  // namespace

int RunProgram(int argc, char** argv) {
  CLI::App app{"Trains, evaluates and exports systems for stylised 3D faces.", "daumier"};
  app.require_subcommand(1);
  app.failure_message(FailureText);
  bool quiet = false;
  int threads = 0;
  app.add_flag("-q,--quiet", quiet, "Only warnings and errors on stderr");
  app.add_option("--threads", threads, "Threads to use; all cores by default")->check(CLI::Range(0, 1024));

  std::function<void()> action;
  for (const Verb& verb : {DatasetVerb(), RegisterVerb(), TrainVerb(), AblateVerb(), EvalVerb(), PredictVerb(),
                           DrawVerb(), ExportVerb(), InfoVerb()}) {
    CLI::App* command = app.add_subcommand(verb.name, verb.summary);
    command->callback([&action, keep = verb.keeps_freed_memory, run = verb.set_up(*command)] {
      action = [keep, run] {
        if (keep) KeepFreedMemory();
        run();
      };
    });
  }

  try {
    app.parse(ReversedWords(argc, argv));
    if (quiet) log::SetLevel(log::Level::kWarning);
    SetUpRuntime(threads);
    CatchInterrupts();
    action();
    return kDone;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kMisused;
  } catch (const UsageError& error) {
    fmt::print(stderr, "daumier: {}\n", error.what());
    return kMisused;
  } catch (const std::exception& error) {
    fmt::print(stderr, "daumier: {}\n", error.what());
    return kFailed;
  }
}

}  // namespace daumier::cli

#include "cli/program.h"

#include "cli/verb.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "core/options.h"
#include "core/runtime.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

namespace daumier::cli {
namespace {

constexpr int kDone = 0, kFailed = 1, kMisused = 2;

std::vector<std::string> NamesOfCommands(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* verb : command.get_subcommands(nullptr)) names.push_back(verb->get_name());
  return names;
}

/// What to say of a word that is none of the command's own commands; empty if there is no such word.
std::string UnknownVerb(const CLI::App& command) {
  const std::vector<std::string> verbs = NamesOfCommands(command);
  if (verbs.empty()) return "";
  for (const std::string& word : command.remaining()) {
    if (word.starts_with('-')) continue;
    std::string nearest = NearestWord(word, {verbs.begin(), verbs.end()});
    for (const CLI::App* verb : command.get_subcommands(nullptr)) {
      if (std::ranges::count(NamesOfCommands(*verb), word) > 0) nearest = verb->get_name() + " " + word;
    }
    return fmt::format("there is no command '{}' (expected {}){}", word, fmt::join(verbs, ", "),
                       nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
  }
  return "";
}

/// Of a word such as --epochs that is no option of a command that takes key=value: how to write it.
std::string KeyValueHint(const CLI::App& command) {
  if (command.get_option_no_throw("overrides") == nullptr && command.get_option_no_throw("inputs") == nullptr)
    return "";
  for (const std::string& word : command.remaining()) {
    if (word.starts_with("--"))
      return fmt::format("  Options of a config have no dashes: {}=VALUE\n", word.substr(2, word.find('=') - 2));
  }
  return "";
}

/// What is wrong, the help of the option that it is about, and where the rest of the help is.
std::string FailureText(const CLI::App* app, const CLI::Error& error) {
  const CLI::App* command = app;
  std::string name = app->get_name();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  if (const std::string unknown = UnknownVerb(*command); !unknown.empty())
    return fmt::format("{}: {}\nSee {} --help\n", name, unknown, name);
  std::string what = error.what();
  if (what.find("subcommand is required") != std::string::npos)
    what = fmt::format("a command is missing (expected {})", fmt::join(NamesOfCommands(*command), ", "));
  std::string text = fmt::format("{}: {}\n", name, what);
  for (const CLI::Option* option : command->get_options()) {
    if (what.starts_with(option->get_name() + ":") || what.starts_with(option->get_name() + " "))
      text += fmt::format("  {}  {}\n", option->get_name(), option->get_description());
  }
  return text + KeyValueHint(*command) + fmt::format("See {} --help\n", name);
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
  // The program's own options may follow the verb. CLI11's fallthrough would also take the name of a file for a verb.
  const auto is_own = [](const std::string& word) {
    return word == "-q" || word == "--quiet" || word == "--threads" || word.starts_with("--threads=");
  };
  std::vector<std::string> own, others;
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--") {
      others.insert(others.end(), words.begin() + ptrdiff_t(i), words.end());
      break;
    }
    (is_own(words[i]) ? own : others).push_back(words[i]);
    if (words[i] == "--threads" && i + 1 < words.size()) own.push_back(words[++i]);
  }
  words = std::move(own);
  words.insert(words.end(), others.begin(), others.end());
  std::reverse(words.begin(), words.end());
  return words;
}

/// Libraries that cannot have the memory that they need end the program or spoil it, oneDNN among them.
constexpr rlim_t kLeastAddressSpace = rlim_t{1} << 30;

/// @throws Error if the limit of the address space (ulimit -v) is too low.
void CheckAddressSpace() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= kLeastAddressSpace)
    return;
  throw Error(fmt::format(
      "there is not enough memory: the limit of the address space is {} MB, and {} are needed. Raise it: ulimit -v {}",
      limit.rlim_cur >> 20, kLeastAddressSpace >> 20, kLeastAddressSpace >> 10));
}

}  // namespace

int RunProgram(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // A file beyond a limit (ulimit -f) is an error of writing, as a full disk is.
  CLI::App app{"Trains, evaluates and exports systems for stylised 3D faces.", "daumier"};
  app.require_subcommand(1);
  app.set_version_flag("--version", DAUMIER_VERSION, "Print the version and exit");
  app.failure_message(FailureText);
  bool quiet = false;
  int threads = 0;
  app.add_flag("-q,--quiet", quiet, "Only warnings and errors on stderr");
  app.add_option("--threads", threads, "Threads to use; all cores by default")->check(CLI::Range(0, 1024));

  std::function<void()> action;
  for (const Verb& verb :
       {DatasetVerb(), RegisterVerb(), ImportVerb(), TrainVerb(), AblateVerb(), EvalVerb(), PredictVerb(), EditVerb(),
        ScoreVerb(), BenchmarkVerb(), DrawVerb(), RigVerb(), AvatarVerb(), StudioVerb(), ExportVerb(), InfoVerb()}) {
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
    CheckAddressSpace();
    SetUpRuntime(threads);
    CatchInterrupts();
    action();
    return kDone;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kMisused;
  } catch (const UsageError& error) {
    fmt::print(stderr, "daumier: {}\n", error.what());
    return kMisused;
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "daumier: cannot access {}: {}. Check its name and permissions, or name another one\n",
               error.path1().string(), error.code().message());
    return kFailed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "daumier: there is not enough memory. Free some, raise the limit (ulimit -v), or give fewer or smaller "
               "inputs\n");
    return kFailed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "daumier: {}\n", error.what());
    return kFailed;
  }
}

}  // namespace daumier::cli

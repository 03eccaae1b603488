#include "cli/program.h"

#include "cli/verb.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "core/runtime.h"

#include <fmt/core.h>

#include <cstdio>

namespace daumier::cli {
namespace {

constexpr int kDone = 0, kFailed = 1, kMisused = 2;

}  // namespace

int RunProgram(int argc, char** argv) {
  CLI::App app{"Trains, evaluates and exports systems for stylised 3D faces."};
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::help);
  bool quiet = false;
  int threads = 0;
  app.add_flag("-q,--quiet", quiet, "Only warnings and errors on stderr");
  app.add_option("--threads", threads, "Threads to use; all cores by default")->check(CLI::Range(0, 1024));

  std::function<void()> action;
  for (const Verb& verb : {DatasetVerb(), RegisterVerb(), TrainVerb(), AblateVerb(), EvalVerb(), PredictVerb(),
                           DrawVerb(), ExportVerb(), InfoVerb()}) {
    CLI::App* command = app.add_subcommand(verb.name, verb.summary);
    command->callback([&action, run = verb.set_up(*command)] { action = run; });
  }

  try {
    app.parse(argc, argv);
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

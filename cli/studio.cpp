#include "cli/study_arguments.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/files.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "core/program_folder.h"
#include "core/runtime.h"
#include "faces/face_database.h"
#include "studio/collector.h"
#include "studio/server.h"
#include "studio/shown_faces.h"
#include "studio/study.h"
#include "systems/deform/open_code_model.h"
#include "systems/portrait/portrait_run_folder.h"
#include "systems/shipped_weights.h"
#include "systems/sketch/gesture_run_folder.h"
#include "systems/sketch/system.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

struct StudioArguments {
  fs::path folder;
  int port = 0;
  std::string live_link;
  bool opens_browser = true;
  StudyArguments study;
};

/// $XDG_DATA_HOME/daumier/studio, by default ~/.local/share/daumier/studio.
fs::path DefaultFolder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value ? value : "");
  };
  fs::path data = variable("XDG_DATA_HOME");
  if (!data.is_absolute()) {
    const fs::path home = variable("HOME");
    if (home.empty()) throw UsageError("there is no home folder to keep drawings in. Name a folder with --folder");
    data = home / ".local" / "share";
  }
  return data / "daumier" / "studio";
}

/// One studio at a time keeps its things in a folder.
class FolderOwner {
 public:
  explicit FolderOwner(const fs::path& folder) {
    MakeDirectory(folder);
    descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DAUMIER_CHECK(descriptor_ >= 0, "{}: it cannot be opened", folder.string());
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      throw UsageError(
          fmt::format("{}: another studio has this folder open. Use that one, or name another folder with --folder",
                      folder.string()));
  }
  ~FolderOwner() { close(descriptor_); }
  FolderOwner(const FolderOwner&) = delete;
  FolderOwner& operator=(const FolderOwner&) = delete;

 private:
  int descriptor_ = -1;
};

studio::StudioWeights WeightsOfStudio() {
  const std::vector<fs::path> places = systems::WeightsPlaces();
  studio::StudioWeights weights{.sketch = {}, .face_model = deform::ShippedModel()};
  for (const systems::ShippedWeights& shipped : systems::ListWeights(places)) {
    if (shipped.system == sketch::kSystem && weights.sketch.empty()) weights.sketch = shipped.directory;
    if (shipped.system == sketch::kGestureSystem) weights.gestures = shipped.directory;
    if (shipped.system == portrait::kPortraitSystem) weights.has_portraits = true;
  }
  if (weights.sketch.empty())
    throw UsageError("there are no weights of the task `sketch`. Restore weights/, or set DAUMIER_WEIGHTS");
  return weights;
}

/// Recorded sessions of the documentation, where they are installed or in the repository.
fs::path ExamplesFolder() {
  const fs::path below = fs::path("docs") / "examples" / "sessions";
  const auto above =
      NearestAbove(ProgramFolder(), [&](const fs::path& folder) { return fs::is_directory(folder / below); });
  return above ? *above / below : fs::path();
}

/// Opens the address in the desktop's browser, if there is one.
void OpenBrowser(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open", argument = address;
  char* words[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, words[0], nullptr, nullptr, words, environ) != 0)
    log::Info("There is no xdg-open here: open the address yourself");
}

/// Prints the address, and serves until Ctrl-C.
void ServePage(studio::Server& server, const StudioArguments& arguments, const std::string& kept) {
  fmt::print("studio: {}\n", server.Address());
  std::fflush(stdout);
  log::Info("{}. Ctrl-C ends the studio", kept);
  if (arguments.opens_browser) OpenBrowser(server.Address());
  server.Serve(InterruptToken());
}

void ServeCollection(const StudioArguments& arguments) {
  const fs::path out = OutOfStudy(arguments.study);
  studio::CheckCollection(out, {arguments.study.collect});
  const studio::ShownFaces faces(arguments.study.collect,
                                 [] { return faces::ReadFaceTemplate(deform::ShippedModel()); });
  const FolderOwner owner(out);
  studio::Collector collector(out, faces, CollectorOptionsOf(arguments.study), {arguments.study.collect});
  studio::Server server(collector.routes(), arguments.port);
  ServePage(server, arguments, fmt::format("Drawings are kept in {}", out.string()));
}

void ServeStudy(const StudioArguments& arguments) {
  const fs::path votes = OutOfStudy(arguments.study);
  studio::Study study(arguments.study.study, votes, VoteKindOf(arguments.study), ParticipantOf(arguments.study),
                      std::make_unique<const studio::DisplayHead>(faces::ReadFaceTemplate(deform::ShippedModel())));
  studio::Server server(study.routes(), arguments.port);
  ServePage(server, arguments, fmt::format("Votes are kept in {}", votes.string()));
}

void ServeStudio(const StudioArguments& arguments) {
  ShareOneHeap();
  CheckStudyArguments(arguments.study);
  if (!studio::HasPage())
    throw UsageError(
        "this program was built without the studio's page, which needs Node.js and npm's packages: ./dev build "
        "daumier");
  if (!arguments.study.collect.empty()) return ServeCollection(arguments);
  if (!arguments.study.study.empty()) return ServeStudy(arguments);
  std::optional<studio::LiveLinkPlace> live_link;
  if (!arguments.live_link.empty()) live_link = studio::ParseLiveLinkPlace(arguments.live_link);
  const fs::path folder = fs::absolute(arguments.folder.empty() ? DefaultFolder() : arguments.folder);
  const FolderOwner owner(folder);
  studio::Studio studio(folder, WeightsOfStudio(), ExamplesFolder(), fs::read_symlink("/proc/self/exe"));
  if (live_link) studio.ReceiveLiveLink(*live_link);
  studio::Server server(studio, arguments.port);
  ServePage(server, arguments, fmt::format("Drawings and faces are kept in {}", folder.string()));
}

}  // namespace

Verb StudioVerb() {
  return {"studio", "A page in the browser on which faces are drawn, shaped, and taken away as heads",
          [](CLI::App& command) {
            auto arguments = std::make_shared<StudioArguments>();
            command.add_option(
                "--folder", arguments->folder,
                "Folder in which drawings and faces are kept. Without it: daumier/studio in the user's folder "
                "of data ($XDG_DATA_HOME, ~/.local/share)");
            command.add_option("--port", arguments->port, "Port on 127.0.0.1; 0: a free one")
                ->check(CLI::Range(0, 65535))
                ->capture_default_str();
            CLI::Option* const live_link = command.add_option(
                "--live-link", arguments->live_link,
                "Receive UDP packets of Live Link Face, which drive the head: a port of 127.0.0.1, as 11111, or "
                "ADDRESS:PORT of this machine, where any program that reaches it may send them");
            AddStudyArguments(command, arguments->study);
            for (const char* mode : {"--collect", "--study"}) live_link->excludes(command.get_option(mode));
            command.add_flag("!--no-browser", arguments->opens_browser, "Do not open the browser");
            return [arguments] { ServeStudio(*arguments); };
          },
          /*keeps_freed_memory=*/false};
}

}  // namespace daumier::cli

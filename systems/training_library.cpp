#include "systems/training_library.h"

#include "core/error.h"
#include "core/runtime.h"

#include <dlfcn.h>

#include <algorithm>

namespace daumier::systems {
namespace {

const TrainingLibrary& Load() {
  // The program's run path names its own folder and ../lib.
  void* const handle = dlopen(kTrainingLibraryFile, RTLD_NOW | RTLD_LOCAL);
  DAUMIER_CHECK(handle != nullptr, "{} cannot be loaded ({}). Build it: ./dev build daumier_training",
                kTrainingLibraryFile, dlerror());
  const auto get = reinterpret_cast<const TrainingLibrary* (*)()>(dlsym(handle, kTrainingLibrarySymbol));
  DAUMIER_CHECK(get != nullptr, "{} is not Daumier's training library. Build it: ./dev build daumier_training",
                kTrainingLibraryFile);
  const TrainingLibrary& library = *get();
  DAUMIER_CHECK(library.version == DAUMIER_VERSION, "{} is of version {} (expected {}). Build both: ./dev build",
                kTrainingLibraryFile, library.version, DAUMIER_VERSION);
  return library;
}

}  // namespace

const SystemTraining& TrainingLibrary::at(std::string_view name) const {
  const auto found = std::ranges::find(systems, name, &SystemTraining::name);
  if (found != systems.end()) return *found;
  std::vector<std::string_view> names;
  for (const SystemTraining& system : systems) names.push_back(system.name);
  throw Error(fmt::format("the training library has no task '{}' (it has {})", name, fmt::join(names, ", ")));
}

const TrainingLibrary& LoadTrainingLibrary() {
  static const TrainingLibrary& library = []() -> const TrainingLibrary& {
    const TrainingLibrary& loaded = Load();
    loaded.set_up(NumThreads());
    return loaded;
  }();
  return library;
}

}  // namespace daumier::systems

#include "systems/training_library.h"

#include "core/error.h"
#include "core/runtime.h"
#include "systems/elf_file.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace daumier::systems {
namespace {

constexpr const char* kBuildIt = "Build it: ./dev build daumier_training";

/// The file that dlopen finds by its name: in the folders of LD_LIBRARY_PATH and of the program's run path, which are
/// its own and ../lib. Empty if it is in none.
std::filesystem::path FindLibrary() {
  void* const program = dlopen(nullptr, RTLD_LAZY);
  Dl_serinfo size = {};
  if (program == nullptr || dlinfo(program, RTLD_DI_SERINFOSIZE, &size) != 0) return {};
  std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
  auto* const folders = reinterpret_cast<Dl_serinfo*>(memory.data());
  *folders = size;
  if (dlinfo(program, RTLD_DI_SERINFO, folders) != 0) return {};
  for (unsigned int i = 0; i < folders->dls_cnt; ++i) {
    const std::filesystem::path file = std::filesystem::path(folders->dls_serpath[i].dls_name) / kTrainingLibraryFile;
    if (std::filesystem::is_regular_file(file)) return file;
  }
  return {};
}

const TrainingLibrary& Load() {
  const std::filesystem::path file = FindLibrary();
  try {
    if (!file.empty()) CheckElfIsWhole(file);
  } catch (const Error& error) {
    throw Error(fmt::format("{}. {}", error.what(), kBuildIt));
  }
  void* const handle = dlopen(file.empty() ? kTrainingLibraryFile : file.c_str(), RTLD_NOW | RTLD_LOCAL);
  DAUMIER_CHECK(handle != nullptr, "{} cannot be loaded ({}). {}", kTrainingLibraryFile, dlerror(), kBuildIt);
  const auto get = reinterpret_cast<const TrainingLibrary* (*)()>(dlsym(handle, kTrainingLibrarySymbol));
  DAUMIER_CHECK(get != nullptr, "{} is not Daumier's training library. {}", kTrainingLibraryFile, kBuildIt);
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

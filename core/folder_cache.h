#pragma once
#include "core/manifest.h"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <typeindex>

namespace daumier {

/// Opened folders that the stages of one job share: a database is opened, and so verified, once.
class FolderCache {
 public:
  /// T(folder), constructed by the first call for the folder, and again if its manifest has changed since. The
  /// reference lives as long as the cache. Thread-safe. @throws what T(folder) throws.
  template <class T>
  const T& Open(const std::filesystem::path& folder) {
    const std::scoped_lock lock(mutex_);
    const bool has_manifest = std::filesystem::exists(folder / "manifest.json");
    const Key key{typeid(T), std::filesystem::weakly_canonical(folder).string(), has_manifest ? DataHash(folder) : ""};
    auto entry = folders_.find(key);
    if (entry == folders_.end()) entry = folders_.emplace(key, std::make_shared<const T>(folder)).first;
    return *static_cast<const T*>(entry->second.get());
  }

  /// How many folders were opened, each once.
  size_t size() const {
    const std::scoped_lock lock(mutex_);
    return folders_.size();
  }

 private:
  using Key = std::tuple<std::type_index, std::string, std::string>;

  mutable std::mutex mutex_;
  std::map<Key, std::shared_ptr<const void>> folders_;
};

}  // namespace daumier

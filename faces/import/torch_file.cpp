#include "faces/import/torch_file.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/archive.h"
#include "faces/import/torch_tensors.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

namespace daumier::faces {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kZip = "PK\x03\x04";
/// The first pickle of the format before PyTorch 1.6: the number 0x1950a86a20f9469cfc6c.
constexpr std::string_view kOlder = "\x80\x02\x8a\x0a\x6c\xfc\x9c\x46\xf9\x20\x6a\xa8\x50\x19.";
constexpr const char* kRepair =
    "Write the tensors alone, in Python, of a file that you trust: state = torch.load(FILE, map_location=\"cpu\"), "
    "state = state[\"model\"] or state.state_dict() if need be, torch.save(dict(state), \"state.pth\")";

std::string BeginningOf(const fs::path& path) {
  std::string bytes(kOlder.size(), '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(bytes.data(), std::ssize(bytes));
  bytes.resize(static_cast<size_t>(stream.gcount()));
  return bytes;
}

/// Calls `read()`, and adds the repair to its errors.
template <class Read>
auto WithRepair(Read read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Error(fmt::format("{}. {}", error.what(), kRepair));
  }
}

/// Tensors whose elements are read storage by storage, so that one storage is in memory at a time.
class StateReader {
 public:
  StateReader(std::map<std::string, StoredTensor> tensors, const fs::path& path)
      : path_(path.string()), tensors_(std::move(tensors)) {
    // Elements have a byte or more, and few tensors share them: a file that claims more is made up.
    int64_t rest = int64_t(fs::file_size(path));
    for (const auto& [name, tensor] : tensors_) {
      DAUMIER_CHECK(tensor.size() <= rest, "{}: the tensor '{}' has more elements than the file has bytes", path_,
                    name);
      rest -= tensor.size();
      by_storage_[tensor.storage].push_back(&name);
    }
  }

  bool Wants(const std::string& storage) const { return by_storage_.contains(storage); }

  void Take(const std::string& storage, std::string_view bytes) {
    const auto found = by_storage_.find(storage);
    if (found == by_storage_.end()) return;
    for (const std::string* const name : found->second) {
      const StoredTensor& tensor = tensors_.at(*name);
      DAUMIER_CHECK(std::ssize(bytes) == tensor.storage_bytes(),
                    "{}: the storage of '{}' has {} bytes, expected {}: the file is truncated or damaged", path_, *name,
                    bytes.size(), tensor.storage_bytes());
      state_[*name] = Elements(tensor, bytes);
    }
    by_storage_.erase(found);
  }

  NamedArrays State() && {
    if (!by_storage_.empty()) {
      throw Error(fmt::format("{}: there are no elements of '{}': the file is truncated or damaged", path_,
                              *by_storage_.begin()->second.front()));
    }
    return std::move(state_);
  }

 private:
  const std::string path_;
  const std::map<std::string, StoredTensor> tensors_;
  std::map<std::string, std::vector<const std::string*>> by_storage_;  ///< Names of the tensors still missing.
  NamedArrays state_;
};

/// What an entry NAME/data/KEY is called below NAME.
std::string_view BelowFirstFolder(std::string_view path) {
  return path.substr(path.find('/') == std::string_view::npos ? path.size() : path.find('/') + 1);
}

NamedArrays ReadZip(const fs::path& path) {
  const auto largest = int64_t(fs::file_size(path));  // Entries are not compressed.
  constexpr std::string_view kData = "data/";
  bool is_script = false;
  std::optional<std::string> pickle;
  ForEachFile(
      path,
      [&](const std::string& entry) {
        const std::string_view name = BelowFirstFolder(entry);
        is_script |= name == "constants.pkl" || name.starts_with("code/");
        return name == "data.pkl" || name == "byteorder";
      },
      [&](const std::string& entry, std::string_view content) {
        if (BelowFirstFolder(entry) == "data.pkl") {
          pickle = content;
        } else {
          DAUMIER_CHECK(content == "little",
                        "{}: the numbers are those of a big-endian machine. Write it on another one", path.string());
        }
      },
      largest);
  DAUMIER_CHECK(!is_script,
                "{}: this is TorchScript, a program with its tensors; expected a state. In Python: "
                "torch.save(torch.jit.load(FILE).state_dict(), \"state.pth\")",
                path.string());
  DAUMIER_CHECK(pickle.has_value(), "{}: this archive is none of PyTorch's (there is no data.pkl)", path.string());
  StateReader reader(
      WithRepair([&] { return TensorsOf(ReadPickle(*pickle, path.string(), TorchNames()), path.string()); }), path);
  const auto key = [&](const std::string& entry) { return std::string(BelowFirstFolder(entry).substr(kData.size())); };
  ForEachFile(
      path,
      [&](const std::string& entry) { return BelowFirstFolder(entry).starts_with(kData) && reader.Wants(key(entry)); },
      [&](const std::string& entry, std::string_view content) { reader.Take(key(entry), content); }, largest);
  return std::move(reader).State();
}

/// Five pickles (magic number, version, sizes of this machine's integers, the state, the keys of its storages) and of
/// each storage its number of elements and these.
NamedArrays ReadOlder(const fs::path& path) {
  const MappedFile file(path);
  std::string_view rest = file.bytes();
  const auto next = [&] {
    Pickle pickle = WithRepair([&] { return ReadPickle(rest, path.string(), TorchNames()); });
    rest.remove_prefix(pickle.num_bytes);
    return pickle;
  };
  for (int i = 0; i < 3; ++i) next();
  const Pickle state = next(), keys = next();
  std::map<std::string, int64_t> num_bytes = StorageBytes(state, path.string());
  StateReader reader(WithRepair([&] { return TensorsOf(state, path.string()); }), path);
  for (const int key : keys[keys.root].items) {
    const std::string& storage = keys[key].text;
    DAUMIER_CHECK(num_bytes.contains(storage), "{}: the storage '{}' is that of no tensor: the file is damaged",
                  path.string(), storage);
    const int64_t size = num_bytes[storage] + int64_t(sizeof(int64_t));
    DAUMIER_CHECK(std::ssize(rest) >= size, "{}: the storage '{}' is beyond the end of the file: it is truncated",
                  path.string(), storage);
    reader.Take(storage, rest.substr(sizeof(int64_t), size_t(num_bytes[storage])));
    rest.remove_prefix(size_t(size));
  }
  return std::move(reader).State();
}

}  // namespace

bool IsTorchFile(const fs::path& path) {
  const std::string beginning = BeginningOf(path);
  return beginning.starts_with(kZip) || beginning.starts_with(kOlder);
}

NamedArrays ReadTorchState(const fs::path& path) {
  DAUMIER_CHECK(fs::is_regular_file(path), "{}: there is no such file", path.string());
  const std::string beginning = BeginningOf(path);
  if (beginning.starts_with(kZip)) return ReadZip(path);
  DAUMIER_CHECK(beginning.starts_with(kOlder),
                "{}: this is no file of PyTorch (torch.save), or it is damaged in its first bytes", path.string());
  return ReadOlder(path);
}

}  // namespace daumier::faces

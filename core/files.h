#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace daumier {

/// The whole file. @throws Error naming the file and the cause.
std::string ReadFile(const std::filesystem::path& path);

/// Writes under a temporary name next to `path`, flushes to disk, then renames: readers see the old file or the whole
/// new one, also where several threads or processes write it at once. Other files are left as they are.
/// @throws Error naming the file and the cause (no such folder, no permission, disk full); nothing is left behind then.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes);

/// Whether a name is a temporary one of `file`, which a killed writer may leave: "manifest.json.12-3.tmp".
bool IsTemporaryNameOf(std::string_view name, std::string_view file);

/// The same, but a file that has these bytes already is not touched.
void WriteFileIfChanged(const std::filesystem::path& path, std::string_view bytes);

/// Lower-case hexadecimal SHA-256 of bytes / of a file's content.
std::string Sha256(std::string_view bytes);
std::string Sha256OfFile(const std::filesystem::path& path);

/// A read-only memory mapping of a whole file.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;

  std::string_view bytes() const { return {data_, size_}; }

 private:
  const char* data_ = nullptr;
  size_t size_ = 0;
};

/// Whether a path below a folder is no content of it but a file of the system that copied or packed it: a name that begins
/// with a dot (macOS: .DS_Store, resource forks ._NAME) or lies in a folder of such a name or __MACOSX.
bool IsSystemFile(const std::filesystem::path& path_below_folder);

/// The text without the folder in front of paths in it, for files that hold no path of the machine.
std::string WithoutFolder(std::string text, const std::filesystem::path& folder);

/// Creates a folder and its parents. @throws Error naming the path and the cause.
void MakeDirectory(const std::filesystem::path& path);

}  // namespace daumier

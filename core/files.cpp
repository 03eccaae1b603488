#include "core/files.h"

#include "core/error.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

namespace daumier {
namespace fs = std::filesystem;
namespace {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : value_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return value_; }
  bool valid() const { return value_ >= 0; }

 private:
  int value_;
};

fs::path FolderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// What the number of a failed system call means to a person.
std::string Cause(int error_number) {
  switch (error_number) {
    case ENOSPC:
      return "no space left on the disk; free some or choose another folder";
    case EDQUOT:
      return "disk quota exceeded; free some space or choose another folder";
    case EACCES:
    case EPERM:
      return "permission denied; change the permissions, or choose another place";
    case ENAMETOOLONG:
      return "the name is too long; choose a shorter one";
    case EMFILE:
    case ENFILE:
      return "too many open files; close other programs, or raise the limit (ulimit -n)";
    case EFBIG:
      return "the file would be larger than the limit; raise it (ulimit -f)";
    case EROFS:
      return "the file system is read-only; choose another place";
    default:
      return std::strerror(error_number);
  }
}

size_t SizeOfOpenFile(const Descriptor& file, const fs::path& path) {
  struct stat status = {};
  DAUMIER_CHECK(fstat(file.get(), &status) == 0, "cannot read {}: {}", path.string(), Cause(errno));
  DAUMIER_CHECK(S_ISREG(status.st_mode), "cannot read {}: not a file", path.string());
  return static_cast<size_t>(status.st_size);
}

/// Calls `take(bytes)` for the content of the file, piece by piece.
template <class Take>
void ForEachPiece(const Descriptor& file, const fs::path& path, Take take) {
  constexpr size_t kPieceSize = size_t{1} << 20;
  const auto piece = std::make_unique<char[]>(kPieceSize);
  for (;;) {
    const ssize_t num_read = read(file.get(), piece.get(), kPieceSize);
    if (num_read == 0) return;
    if (num_read < 0 && errno == EINTR) continue;
    DAUMIER_CHECK(num_read > 0, "cannot read {}: {}", path.string(), Cause(errno));
    take(std::string_view(piece.get(), static_cast<size_t>(num_read)));
  }
}

/// Returns 0 or the errno of what failed.
int WriteAndFlush(const Descriptor& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t num_written = write(file.get(), bytes.data(), bytes.size());
    if (num_written < 0 && errno == EINTR) continue;
    if (num_written < 0) return errno;
    bytes.remove_prefix(static_cast<size_t>(num_written));
  }
  return fsync(file.get()) == 0 ? 0 : errno;
}

/// A name that no other writer uses. IsTemporaryNameOf holds of it unless the file's own name leaves no room for more.
fs::path UnusedTemporaryName(const fs::path& path) {
  constexpr size_t kMostKept = 220;  // Bytes, of the 255 that a name may have.
  static std::atomic<unsigned> count = 0;
  const std::string name = path.filename().string().substr(0, kMostKept);
  return FolderOf(path) / fmt::format("{}.{}-{}.tmp", name, getpid(), ++count);
}

/// Puts the bytes under a new name next to `path`, which is returned in `temporary`. Returns 0 or the errno of what failed.
/// Where the file system and /proc allow it, the file has no name before it is whole, so that a killed writer leaves nothing.
int WriteTemporary(const fs::path& path, std::string_view bytes, fs::path& temporary) {
  const Descriptor nameless(FolderOf(path), O_TMPFILE | O_WRONLY);
  if (nameless.valid()) {
    if (const int error = WriteAndFlush(nameless, bytes); error != 0) return error;
    const std::string link = fmt::format("/proc/self/fd/{}", nameless.get());
    do {
      temporary = UnusedTemporaryName(path);
      if (linkat(AT_FDCWD, link.c_str(), AT_FDCWD, temporary.c_str(), AT_SYMLINK_FOLLOW) == 0) return 0;
    } while (errno == EEXIST);
  }
  for (;;) {
    const fs::path name = UnusedTemporaryName(path);
    const Descriptor file(name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
    if (!file.valid() && errno == EEXIST) continue;
    if (!file.valid()) return errno;
    temporary = name;
    return WriteAndFlush(file, bytes);
  }
}

class Sha256Hash {
 public:
  Sha256Hash() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    DAUMIER_CHECK(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1, "OpenSSL has no SHA-256");
  }
  void Add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string Hex() {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int size = 0;
    EVP_DigestFinal_ex(context_.get(), digest, &size);
    std::string hex;
    for (unsigned int i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
    return hex;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string ReadFile(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  DAUMIER_CHECK(file.valid(), "cannot read {}: {}", path.string(), Cause(errno));
  std::string bytes;
  bytes.reserve(SizeOfOpenFile(file, path));
  ForEachPiece(file, path, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

void WriteFileAtomically(const fs::path& path, std::string_view bytes) {
  fs::path temporary;
  int error = WriteTemporary(path, bytes, temporary);
  if (error == 0 && rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    if (!temporary.empty()) unlink(temporary.c_str());
    throw Error(fmt::format("cannot write {}: {}", path.string(), Cause(error)));
  }
  const Descriptor directory(FolderOf(path), O_RDONLY | O_DIRECTORY);
  if (directory.valid()) fsync(directory.get());  // Makes the rename last; some file systems cannot, and need not.
}

bool IsTemporaryNameOf(std::string_view name, std::string_view file) {
  return name.starts_with(file) && name.substr(file.size()).starts_with('.') && name.ends_with(".tmp");
}

void WriteFileIfChanged(const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  const bool is_same =
      fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) == bytes.size() && ReadFile(path) == bytes;
  if (!is_same) WriteFileAtomically(path, bytes);
}

std::string Sha256(std::string_view bytes) {
  Sha256Hash hash;
  hash.Add(bytes);
  return hash.Hex();
}

std::string Sha256OfFile(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  DAUMIER_CHECK(file.valid(), "cannot read {}: {}", path.string(), Cause(errno));
  SizeOfOpenFile(file, path);
  Sha256Hash hash;
  ForEachPiece(file, path, [&](std::string_view piece) { hash.Add(piece); });
  return hash.Hex();
}

MappedFile::MappedFile(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  DAUMIER_CHECK(file.valid(), "cannot read {}: {}", path.string(), Cause(errno));
  size_ = SizeOfOpenFile(file, path);
  if (size_ == 0) return;  // An empty mapping is an error to mmap; no bytes need none.
  void* mapping = mmap(nullptr, size_, PROT_READ, MAP_SHARED, file.get(), 0);
  DAUMIER_CHECK(mapping != MAP_FAILED, "cannot map {}: {}", path.string(), Cause(errno));
  data_ = static_cast<const char*>(mapping);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(const_cast<char*>(data_), size_);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

bool IsSystemFile(const std::filesystem::path& path_below_folder) {
  return std::any_of(path_below_folder.begin(), path_below_folder.end(), [](const std::filesystem::path& part) {
    const std::string name = part.string();
    return name == "__MACOSX" || (name.starts_with('.') && name != "." && name != "..");
  });
}

std::string WithoutFolder(std::string text, const fs::path& folder) {
  if (folder.empty()) return text;
  const std::string prefix = (folder / "").string();
  for (size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at))
    text.erase(at, prefix.size());
  return text;
}

void MakeDirectory(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  DAUMIER_CHECK(!error && fs::is_directory(path, error), "cannot create folder {}: {}", path.string(),
                error ? Cause(error.value()) : "a file of that name exists");
}

}  // namespace daumier

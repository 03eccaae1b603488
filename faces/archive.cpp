#include "faces/archive.h"

#include "core/error.h"
#include "core/files.h"
#include "core/late_library.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace daumier::faces {

namespace {

constexpr size_t kBlock = size_t{1} << 22;

/// The functions of libarchive that are used here, by its names without `archive_`.
struct Libarchive {
  LateLibrary library{DAUMIER_LIBARCHIVE, "reads tar and zip archives"};
  decltype(archive_read_new)* read_new = library["archive_read_new"];
  decltype(archive_read_free)* read_free = library["archive_read_free"];
  decltype(archive_read_support_filter_all)* support_filters = library["archive_read_support_filter_all"];
  decltype(archive_read_support_format_tar)* support_tar = library["archive_read_support_format_tar"];
  decltype(archive_read_support_format_zip)* support_zip = library["archive_read_support_format_zip"];
  decltype(archive_read_open_filename)* open = library["archive_read_open_filename"];
  decltype(archive_read_next_header)* next_header = library["archive_read_next_header"];
  decltype(archive_read_data)* read_data = library["archive_read_data"];
  decltype(archive_error_string)* error_string = library["archive_error_string"];
  decltype(archive_entry_pathname)* pathname = library["archive_entry_pathname"];
  decltype(archive_entry_filetype)* filetype = library["archive_entry_filetype"];
  decltype(archive_entry_size)* size = library["archive_entry_size"];
};

const Libarchive& LoadedLibarchive() {
  static const Libarchive functions;
  return functions;
}

void ForEachFileOfFolder(const std::filesystem::path& folder, const std::function<bool(const std::string&)>& wanted,
                         const std::function<void(const std::string&, std::string_view)>& use) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) paths.push_back(std::filesystem::relative(entry.path(), folder).generic_string());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) {
    if (!IsSystemFile(path) && wanted(path)) use(path, MappedFile(folder / path).bytes());
  }
}

}  // namespace

void ForEachFile(const std::filesystem::path& folder_or_archive,
                 const std::function<bool(const std::string& path)>& wanted,
                 const std::function<void(const std::string& path, std::string_view content)>& use, int64_t largest) {
  DAUMIER_CHECK(std::filesystem::exists(folder_or_archive), "{} does not exist", folder_or_archive.string());
  if (std::filesystem::is_directory(folder_or_archive)) return ForEachFileOfFolder(folder_or_archive, wanted, use);

  const Libarchive& functions = LoadedLibarchive();
  const std::unique_ptr<archive, decltype(functions.read_free)> reader(functions.read_new(), functions.read_free);
  functions.support_filters(reader.get());
  functions.support_tar(reader.get());
  functions.support_zip(reader.get());
  const auto check = [&](la_ssize_t code) {
    DAUMIER_CHECK(code >= ARCHIVE_WARN || code > 0,
                  "{} cannot be read as a tar or zip archive: {}; it may be truncated, get it again",
                  folder_or_archive.string(),
                  functions.error_string(reader.get()) ? functions.error_string(reader.get()) : "no cause given");
  };
  check(functions.open(reader.get(), folder_or_archive.c_str(), 1 << 20));
  archive_entry* entry = nullptr;
  std::string content;
  for (int code = functions.next_header(reader.get(), &entry); code != ARCHIVE_EOF;
       code = functions.next_header(reader.get(), &entry)) {
    check(code);
    const char* const name = functions.pathname(entry);  // Null where it is no text in the file's encoding.
    DAUMIER_CHECK(name != nullptr, "{}: the name of an entry is not readable; the archive is damaged",
                  folder_or_archive.string());
    const std::string path = name;
    if (functions.filetype(entry) != AE_IFREG || IsSystemFile(path) || !wanted(path)) continue;
    const int64_t size = functions.size(entry);
    DAUMIER_CHECK(size >= 0 && size <= largest, "{}: {} claims {} bytes", folder_or_archive.string(), path, size);
    // Grows with the bytes read, not with the size that the header claims.
    content.clear();
    for (la_ssize_t got = 1; got > 0;) {
      const size_t begin = content.size();
      content.resize(std::min<size_t>(begin + kBlock, static_cast<size_t>(size) + 1));
      got = functions.read_data(reader.get(), content.data() + begin, content.size() - begin);
      check(got);
      content.resize(begin + static_cast<size_t>(std::max<la_ssize_t>(got, 0)));
    }
    DAUMIER_CHECK(static_cast<int64_t>(content.size()) <= size,
                  "{}: the size of {} is not known: the archive is truncated, get it again", folder_or_archive.string(),
                  path);
    DAUMIER_CHECK(static_cast<int64_t>(content.size()) == size, "{}: {} is truncated, {} of {} bytes",
                  folder_or_archive.string(), path, content.size(), size);
    use(path, content);
  }
}

}  // namespace daumier::faces

#pragma once
#include <filesystem>
#include <string>
#include <vector>

/// The one rule of what a command may write: only what is new, and what the same command has written. Every verb checks
/// its --out by these functions before its work begins. Paths are compared as files, not as text: links, relative
/// paths and trailing slashes name the same file.
namespace daumier {

/// How an earlier result of a command is recognised.
struct OutputKind {
  std::string name;  ///< Manifest::kind of the finished folder: "report".
  /// Files that a folder without a manifest holds, all of them, if the command was stopped in it. Empty: there is none.
  std::vector<std::string> begun = {};
};

/// For a command that writes into `out` and keeps what is there. Files of the desktop (.DS_Store, ._NAME, Thumbs.db) and
/// of a writer that was killed (IsTemporaryNameOf) do not count as content.
/// @throws UsageError naming `out`, what was found and the repair, if `out` is a file, cannot be a folder, holds
/// anything but an earlier result of `kind`, is one of the inputs or has one below it; Error if it may not be written.
void CheckOutputFolder(const std::filesystem::path& out, const OutputKind& kind,
                       const std::vector<std::filesystem::path>& inputs = {});

/// For a command that replaces the whole of `out`: as CheckOutputFolder for a folder with a manifest. In addition every
/// file in it has to be as that manifest lists it, so that no file of another origin and no correction by hand is lost.
void CheckReplacedFolder(const std::filesystem::path& out, const std::string& kind,
                         const std::vector<std::filesystem::path>& inputs = {});

/// Of Manifest::details: the names of the files that a command was writing when it wrote the manifest. They are its own
/// whatever they hold, so that a command that was killed can be run again.
inline constexpr const char* kUnfinishedFiles = "unfinished";

/// For files that a command writes into its folder: each of `names` is absent from `folder`, has the checksum that the
/// folder's manifest lists, or is listed as unfinished. @throws UsageError naming the first file that is not.
void CheckOwnFiles(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Whether a command may replace a file that exists.
enum class ExistingFile { kKept, kReplaced };

/// For a command that writes one file. @throws UsageError if `file` is a folder or one of the inputs, if its folder does
/// not exist, or if it exists and is to be kept.
void CheckOutputFile(const std::filesystem::path& file, ExistingFile existing,
                     const std::vector<std::filesystem::path>& inputs = {});

}  // namespace daumier

#pragma once
#include "core/json.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// What a kit of frozen seeds has to be, small enough for a repository: two kits are compared by their records.
namespace daumier::benchmark {

inline constexpr const char* kRecordFile = "record.json";

/// Of all files of one kind of a person in a split and a task, inputs or truth: "inputs/test/drawings/person-072.png".
struct RecordEntry {
  std::string sha256;               ///< Of their names and checksums; the first 16 digits.
  std::vector<double> fingerprint;  ///< Mean over them of Fingerprint.
};
struct KitRecord {
  std::string name;
  std::map<std::string, RecordEntry> entries;
};

/// Four numbers that change with a file's numbers as little as these do: of .npy, .pts and .xyz means of the numbers weighted by four
/// waves over their index; of a picture the mean grey values of its quarters. A large change of few numbers may be missed.
std::vector<double> Fingerprint(const std::filesystem::path& file);
/// Differences of fingerprints up to which files count as equivalent: by the extension, in the files' own unit (cm, pixels, grey
/// values).
double FingerprintTolerance(const std::string& extension);

/// checksums: of the files of a kit by name.
KitRecord RecordOf(const std::filesystem::path& kit, const std::map<std::string, std::string>& checksums,
                   const std::string& name);
/// An entry a line, numbers of six digits.
std::string RecordText(const KitRecord& record);
/// @throws Error naming the file if it is no record.
KitRecord ReadRecord(const std::filesystem::path& file);

/// What differs between files and their manifest.
struct KitDamage {
  std::vector<std::string> missing, changed, extra;
  bool none() const { return missing.empty() && changed.empty() && extra.empty(); }
};
/// Every file of a kit against its checksum. @throws Error as ReadManifest.
KitDamage CheckKit(const std::filesystem::path& kit);

/// Entries of a record that are the same bytes, that are equivalent (by the fingerprint), and that differ.
struct RecordComparison {
  int num_same = 0;
  std::vector<std::string> equivalent, different;
  double largest_share = 0;  ///< Greatest difference of a fingerprint as a share of its tolerance.
};
RecordComparison CompareRecords(const KitRecord& expected, const KitRecord& found);

}  // namespace daumier::benchmark

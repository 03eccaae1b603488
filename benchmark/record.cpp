#include "benchmark/record.h"

#include "benchmark/kit.h"
#include "core/error.h"
#include "core/files.h"
#include "core/npy.h"
#include "render/image.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace daumier::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr size_t kNumWaves = 4, kNumDigits = 16;

/// Means of the numbers times waves of other lengths, so that moved, exchanged and permuted numbers are seen.
std::vector<double> WavesOf(const std::vector<double>& numbers) {
  std::vector<double> waves(kNumWaves);
  for (size_t i = 0; i < numbers.size(); ++i)
    for (size_t k = 0; k < kNumWaves; ++k)
      waves[k] += (k == 0 ? 1 : std::cos(0.7 * double(k) * double(i))) * numbers[i] / double(numbers.size());
  return waves;
}

std::vector<double> NumbersIn(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::istringstream number(word);
    double value = 0;
    if (number >> value) numbers.push_back(value);
  }
  return numbers;
}

/// Mean grey values of the quarters of a picture.
std::vector<double> CellsOf(const render::Image& picture) {
  std::vector<double> sums(4), counts(4);
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const size_t cell = size_t(2 * (2 * row / picture.height) + 2 * column / picture.width);
      for (int c = 0; c < picture.channels; ++c) sums[cell] += picture.at(row, column, c);
      counts[cell] += picture.channels;
    }
  }
  for (size_t cell = 0; cell < sums.size(); ++cell) sums[cell] /= std::max(counts[cell], 1.0);
  return sums;
}

/// "inputs/test/drawings/person-072.png" of "inputs/test/drawings/person-072-a-clean.png"; empty for files of no person.
std::string EntryOf(const std::string& name) {
  const fs::path path(name);
  const std::string stem = path.filename().string();
  if (!stem.starts_with("person-")) return "";
  return (path.parent_path() / stem.substr(0, stem.find('-', 7))).generic_string() + path.extension().string();
}

}  // namespace

std::vector<double> Fingerprint(const fs::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".npy") {
    const NpyTable table = ReadNpy(file);
    return WavesOf({table.numbers.begin(), table.numbers.end()});
  }
  if (extension == ".png") return CellsOf(render::ReadImage(file));
  return WavesOf(NumbersIn(ReadFile(file)));
}

double FingerprintTolerance(const std::string& extension) {
  if (extension == ".png") return 0.05;   // Of 255.
  if (extension == ".pts") return 0.002;  // Pixels.
  return 2e-5;                            // Cm: 0.0002 mm.
}

KitRecord RecordOf(const fs::path& kit, const std::map<std::string, std::string>& checksums, const std::string& name) {
  KitRecord record{.name = name, .entries = {}};
  std::map<std::string, std::pair<std::string, int>> texts;
  for (const auto& [file, checksum] : checksums) {
    const std::string key = EntryOf(file);
    if (key.empty()) continue;
    auto& [text, count] = texts[key];
    text += file + " " + checksum + "\n";
    ++count;
    std::vector<double>& sum = record.entries[key].fingerprint;
    const std::vector<double> numbers = Fingerprint(kit / file);
    sum.resize(numbers.size());
    for (size_t k = 0; k < numbers.size(); ++k) sum[k] += numbers[k];
  }
  for (auto& [key, entry] : record.entries) {
    entry.sha256 = Sha256(texts[key].first).substr(0, kNumDigits);
    for (double& number : entry.fingerprint) number /= texts[key].second;
  }
  return record;
}

std::string RecordText(const KitRecord& record) {
  std::string text = fmt::format("{{\"name\": {}, \"entries\": {{\n", Json(record.name).dump());
  size_t count = 0;
  for (const auto& [key, entry] : record.entries)
    text += fmt::format("\"{}\": [\"{}\", {:.6f}]{}\n", key, entry.sha256, fmt::join(entry.fingerprint, ", "),
                        ++count < record.entries.size() ? "," : "");
  return text + "}}\n";
}

KitRecord ReadRecord(const fs::path& file) {
  const Json json = ReadJson(file);
  try {
    KitRecord record{.name = json.at("name").get<std::string>(), .entries = {}};
    for (const auto& [key, values] : json.at("entries").items()) {
      RecordEntry& entry = record.entries[key];
      entry.sha256 = values.at(0).get<std::string>();
      for (size_t i = 1; i < values.size(); ++i) entry.fingerprint.push_back(values.at(i).get<double>());
    }
    return record;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: no record of a kit: {}", file.string(), TextOf(error)));
  }
}

KitDamage CheckKit(const fs::path& kit) {
  const Manifest manifest = ReadManifest(kit, kBenchmarkKind);
  KitDamage damage;
  for (const auto& [name, checksum] : manifest.checksums) {
    if (!fs::exists(kit / name)) {
      damage.missing.push_back(name);
    } else if (Sha256OfFile(kit / name) != checksum) {
      damage.changed.push_back(name);
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(kit)) {
    const fs::path below = entry.path().lexically_relative(kit);
    if (entry.is_directory() || IsSystemFile(below) || below == "manifest.json") continue;
    if (!manifest.checksums.contains(below.generic_string())) damage.extra.push_back(below.generic_string());
  }
  std::ranges::sort(damage.extra);
  return damage;
}

RecordComparison CompareRecords(const KitRecord& expected, const KitRecord& found) {
  RecordComparison comparison;
  for (const auto& [key, entry] : expected.entries) {
    const auto other = found.entries.find(key);
    if (other == found.entries.end() || other->second.fingerprint.size() != entry.fingerprint.size()) {
      comparison.different.push_back(key);
      continue;
    }
    double share = 0;
    for (size_t k = 0; k < entry.fingerprint.size(); ++k)
      share = std::max(share, std::abs(entry.fingerprint[k] - other->second.fingerprint[k]) /
                                  FingerprintTolerance(fs::path(key).extension().string()));
    comparison.largest_share = std::max(comparison.largest_share, share);
    if (other->second.sha256 == entry.sha256) {
      ++comparison.num_same;
    } else {
      (share <= 1 ? comparison.equivalent : comparison.different).push_back(key);
    }
  }
  for (const auto& [key, entry] : found.entries)
    if (!expected.entries.contains(key)) comparison.different.push_back(key);
  return comparison;
}

}  // namespace daumier::benchmark

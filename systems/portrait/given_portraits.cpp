#include "systems/portrait/given_portraits.h"

#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/safetensors.h"
#include "datasets/build/portrait_shard.h"
#include "datasets/build/sharded_build.h"
#include "datasets/read/portrait_camera.h"
#include "render/draw.h"
#include "systems/open_network.h"
#include "systems/portrait/landmark_files.h"
#include "systems/portrait/landmark_run_folder.h"
#include "systems/portrait/picture_files.h"
#include "systems/portrait/portrait_crop.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPicturesFile = "pictures.json";
/// Of the metadata of a shard: the rows of pictures.json, with confidences in place of numbers of portraits.
constexpr const char* kPictures = "pictures";
constexpr int kPicturesPerShard = 16;

/// Neither closed nor open.
constexpr float kUnknownGapMm = 2.25f;
static_assert(kUnknownGapMm > kClosedEyeMm && kUnknownGapMm < kOpenEyeMm && kUnknownGapMm > kClosedMouthMm &&
              kUnknownGapMm < kOpenMouthMm);

std::optional<fs::path> MaskFileOf(const fs::path& picture) {
  const fs::path file = picture.parent_path() / (picture.stem().string() + "_mask.png");
  return fs::is_regular_file(file) ? std::optional(file) : std::nullopt;
}

/// What a picture NAME of a folder is, and the files next to it.
struct GivenPicture {
  fs::path file;  ///< Relative.
  int person = 0;
  std::optional<fs::path> landmarks = {}, mask = {};
};

std::vector<GivenPicture> ListPictures(const fs::path& folder) {
  std::vector<GivenPicture> pictures;
  std::map<fs::path, int> persons;
  for (const fs::path& file : PicturesBelow(folder)) {
    const fs::path person = file.has_parent_path() ? file.parent_path() : file;
    const int number = persons.emplace(person, int(persons.size())).first->second;
    const fs::path path = folder / file;
    pictures.push_back({file, number, LandmarkFileIn(path.parent_path(), path.stem().string()), MaskFileOf(path)});
  }
  return pictures;
}

/// SHA-256 over names and contents of the pictures and of the files next to them.
std::string ChecksumOf(const fs::path& folder, const std::vector<GivenPicture>& pictures) {
  const auto content = [](const fs::path& file) {
    try {
      return Sha256OfFile(file);
    } catch (const Error&) {
      return std::string("unreadable");
    }
  };
  std::string all;
  for (const GivenPicture& picture : pictures) {
    all += picture.file.generic_string() + '\n' + content(folder / picture.file) + '\n';
    for (const auto& file : {picture.landmarks, picture.mask}) all += (file ? content(*file) : "none") + '\n';
  }
  return Sha256(all);
}

/// Its faces. @throws Error with the cause for which it is dropped.
std::vector<DetectedFace> FacesOf(const LandmarkDetector& detector, const GivenPicture& given,
                                  const render::Image& picture) {
  if (given.landmarks) {
    const std::vector<float> landmarks = ReadLandmarks(*given.landmarks);
    DAUMIER_CHECK(Overlap(BoxOf(landmarks), {0, 0, double(picture.width), double(picture.height)}) > 0,
                  "{}: all landmarks are outside of the picture of {} x {}", given.landmarks->string(), picture.width,
                  picture.height);
    return {detector.FindGiven(picture, landmarks)};
  }
  std::optional<DetectedFace> candidate;
  std::vector<DetectedFace> faces = detector.FindAll(picture, &candidate);
  DAUMIER_CHECK(!faces.empty() || candidate, "no face");
  DAUMIER_CHECK(!faces.empty(), "a face of confidence {:.2f}, expected {:.2f} or more", candidate->confidence,
                detector.options().least_confidence);
  return faces;
}

datasets::PortraitRecord RecordOf(const render::Image& picture, const render::Image& mask, const DetectedFace& face,
                                  const GivenPortraitsOptions& options) {
  datasets::PortraitRecord record;
  const PictureMap map = CropOfLandmarks(face.landmarks, options.size);
  record.picture =
      render::EncodeImage(render::ToRgb(WarpPicture(picture, map)), render::ImageFormat::kJpeg, options.quality);
  record.mask = render::EncodeImage(WarpPicture(mask, map, Sampling::kNearest), render::ImageFormat::kPng);
  const std::vector<float> landmarks = MapLandmarks(face.landmarks, map);
  std::ranges::copy(landmarks, record.landmarks.begin());
  const auto is_inside = [](float value) { return value >= 0 && value < float(kPortraitSide); };
  for (size_t n = 0; n < record.visibility.size(); ++n)
    record.visibility[n] = face.landmark_confidences[n] >= float(options.seen) && is_inside(landmarks[2 * n]) &&
                           is_inside(landmarks[2 * n + 1]);
  record.states.fill(kUnknownGapMm);
  return record;
}

struct GivenBuild {
  const LandmarkDetector& detector;
  const GivenPortraitsOptions& options;
  const fs::path& folder;
  std::vector<GivenPicture> pictures;

  /// Adds the portraits of a picture to `records`, and returns its row of the metadata.
  Json AddPortraits(const GivenPicture& given, std::vector<datasets::PortraitRecord>& records) const;
  std::string WriteShard(int shard, const fs::path& file) const;
};

Json GivenBuild::AddPortraits(const GivenPicture& given, std::vector<datasets::PortraitRecord>& records) const {
  Json row = {{"file", given.file.generic_string()}};
  try {
    const render::Image picture = render::ReadImage(folder / given.file);
    std::optional<render::Image> mask;
    if (given.mask) mask = ReadMask(*given.mask, picture.height, picture.width);
    std::vector<datasets::PortraitRecord> portraits;
    Json confidences = Json::array();
    for (const DetectedFace& face : FacesOf(detector, given, picture)) {
      portraits.push_back(RecordOf(picture, mask ? *mask : face.Mask(picture.height, picture.width), face, options));
      portraits.back().face = portraits.back().person = given.person;
      confidences.push_back(face.confidence);
    }
    records.insert(records.end(), std::make_move_iterator(portraits.begin()), std::make_move_iterator(portraits.end()));
    row["confidences"] = confidences;
  } catch (const std::exception& error) {
    const std::string cause = WithoutFolder(error.what(), folder), name = given.file.string() + ": ";
    row["dropped"] = cause.starts_with(name) ? cause.substr(name.size()) : cause;
  }
  return row;
}

std::string GivenBuild::WriteShard(int shard, const fs::path& file) const {
  std::vector<datasets::PortraitRecord> records;
  Json rows = Json::array();
  const size_t begin = size_t(shard) * kPicturesPerShard, end = std::min(begin + kPicturesPerShard, pictures.size());
  for (size_t i = begin; i < end; ++i) rows.push_back(AddPortraits(pictures[i], records));
  // Names of files may be no UTF-8.
  const std::string text = rows.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (!records.empty()) return datasets::WritePortraitShard(file, records, {{kPictures, text}});
  SafetensorsWriter none;
  none.SetMetadata("kind", "portraits");
  none.SetMetadata(kPictures, text);
  return none.Write(file);
}

/// Removes shards without portraits, numbers the others again, and returns the rows of pictures.json.
Json KeepPortraits(const fs::path& directory, int num_shards, Manifest& manifest) {
  Json all = Json::array();
  int num_kept = 0, num_images = 0;
  std::set<int> persons;
  for (int s = 0; s < num_shards; ++s) {
    const std::string name = datasets::PortraitShardName(s), place = datasets::PortraitShardName(num_kept);
    const int first = num_images;
    {
      const SafetensorsFile shard(directory / name);
      for (Json row : ParseJson(shard.metadata().at(kPictures), name)) {
        if (row.contains("confidences")) {
          row["portraits"] = Json::array();
          for (size_t k = 0; k < row.at("confidences").size(); ++k) row["portraits"].push_back(num_images++);
        }
        all.push_back(std::move(row));
      }
      if (num_images > first)
        for (const int32_t person : shard.at("persons").As<int32_t>()) persons.insert(person);
    }
    const std::string checksum = manifest.checksums.at(name);
    manifest.checksums.erase(name);
    if (num_images == first) {
      fs::remove(directory / name);
      continue;
    }
    if (place != name) fs::rename(directory / name, directory / place);
    manifest.checksums[place] = checksum;
    ++num_kept;
  }
  manifest.counts["images"] = num_images;
  manifest.counts["shards"] = num_kept;
  manifest.counts["persons"] = persons.size();
  return all;
}

GivenPortraits SummaryOf(const Json& rows) {
  GivenPortraits summary{.num_pictures = int(rows.size())};
  for (const Json& row : rows) {
    if (row.contains("dropped")) summary.dropped.push_back({row.at("file"), row.at("dropped")});
    if (row.contains("portraits")) summary.num_portraits += int(row.at("portraits").size());
  }
  return summary;
}

void FailIfAllDropped(const GivenPortraits& summary, const fs::path& pictures) {
  constexpr size_t kMostShown = 5;
  if (summary.num_portraits > 0) return;
  std::string text =
      fmt::format("{}: none of {} pictures has a face that is kept", pictures.string(), summary.num_pictures);
  for (size_t i = 0; i < std::min(kMostShown, summary.dropped.size()); ++i)
    text += fmt::format("\n  {}: {}", summary.dropped[i].file, summary.dropped[i].cause);
  throw Error(text);
}

}  // namespace

std::vector<fs::path> PicturesBelow(const fs::path& folder) {
  DAUMIER_CHECK(fs::is_directory(folder), "{} is no folder of pictures", folder.string());
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path file = entry.path().lexically_relative(folder);
    if (entry.is_regular_file() && IsPictureFile(file) && !IsSystemFile(file)) files.insert(file);
  }
  std::set<fs::path> stems;
  for (const fs::path& file : files) stems.insert(file.parent_path() / file.stem());
  std::erase_if(files, [&](const fs::path& file) {
    const std::string stem = file.stem().string(), suffix = "_mask";
    return stem.ends_with(suffix) && stems.contains(file.parent_path() / stem.substr(0, stem.size() - suffix.size()));
  });
  DAUMIER_CHECK(!files.empty(), "{} holds no picture (expected files {})", folder.string(),
                fmt::join(PictureExtensions(), ", "));
  return {files.begin(), files.end()};
}

GivenPortraits ReadGivenPortraits(const fs::path& directory) {
  const fs::path file = directory / kPicturesFile;
  try {
    return SummaryOf(ReadJson(file).at("pictures"));
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: malformed: {}", file.string(), TextOf(error)));
  }
}

GivenPortraits BuildGivenPortraits(const LandmarkDetector& detector, const Json& network, const fs::path& pictures,
                                   const GivenPortraitsOptions& options, const fs::path& directory, const Task& task) {
  const GivenBuild given{detector, options, pictures, ListPictures(pictures)};
  const int num_pictures = int(given.pictures.size());
  const datasets::PortraitOptics optics;
  datasets::ShardedBuild build;
  build.manifest.kind = "portraits";
  build.manifest.verb = "dataset portraits";
  build.manifest.config = ToJson(options);
  build.manifest.config.erase("landmark_run");
  build.manifest.sources = Json::array({{{"name", "given pictures"},
                                         {"version", ""},
                                         {"checksum", ChecksumOf(pictures, given.pictures)},
                                         {"licence", options.licence}}});
  build.manifest.counts = {{"pictures", num_pictures}};
  build.manifest.details = {{"known_faces", false},  {"network", network},           {"size", optics.size},
                            {"focal", optics.focal}, {"distance", optics.distance},  {"centre", {0.0, 0.0, 0.0}},
                            {"vertices", false},     {"expressions", Json::array()}, {"styles", {"given"}}};
  if (fs::exists(directory / "manifest.json")) {
    // How many portraits there are is not in the plan.
    const Manifest finished = ReadManifest(directory, "portraits");
    for (const char* count : {"images", "shards", "persons"})
      if (finished.counts.contains(count)) build.manifest.counts[count] = finished.counts.at(count);
  }
  build.num_shards = (num_pictures + kPicturesPerShard - 1) / kPicturesPerShard;
  build.num_units = num_pictures;
  build.unit = "pictures";
  build.units_per_shard = kPicturesPerShard;
  build.shard_name = datasets::PortraitShardName;
  build.write_shard = [&](int shard, const fs::path& file) { return given.WriteShard(shard, file); };
  build.finish = [&](const fs::path& folder, Manifest& manifest) {
    const Json rows = KeepPortraits(folder, build.num_shards, manifest);
    const GivenPortraits summary = SummaryOf(rows);
    if (summary.num_portraits == 0) fs::remove_all(folder);
    FailIfAllDropped(summary, pictures);
    WriteFileAtomically(folder / kPicturesFile, Json{{"format_version", 1}, {"pictures", rows}}.dump(1) + "\n");
    manifest.checksums[kPicturesFile] = Sha256OfFile(folder / kPicturesFile);
  };
  datasets::BuildShards(directory, build, task);
  return ReadGivenPortraits(directory);
}

GivenPortraits BuildGivenPortraits(const fs::path& pictures, const GivenPortraitsOptions& options,
                                   const fs::path& directory, const Task& task) {
  if (options.landmark_run.empty())
    throw UsageError("portraits of given pictures need landmark_run=RUN, a run that finds landmarks");
  PicturesBelow(pictures);  // Before the network is opened.
  const LandmarkRunFolder run = ReadLandmarkRunFolder(options.landmark_run);
  const LandmarkDetector detector(run.network_options, systems::OpenNetwork(options.landmark_run, {}),
                                  options.detector);
  const Json network = {{"system", kLandmarkSystem}, {"weights", Sha256OfFile(BestWeights(options.landmark_run))}};
  return BuildGivenPortraits(detector, network, pictures, options, directory, task);
}

}  // namespace daumier::portrait

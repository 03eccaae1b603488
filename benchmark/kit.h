#pragma once
#include "core/manifest.h"
#include "eval/landmark_score.h"
#include "faces/face_model.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::benchmark {

/// What is predicted: from a drawing a face; from landmarks of a caricature its face; from a portrait the face; from a portrait 68
/// landmarks.
enum class KitTask { kDrawings, kCaricatures, kPortraits, kLandmarks };
inline constexpr std::array<std::string_view, 4> kKitTaskNames = {"drawings", "caricatures", "portraits", "landmarks"};
enum class KitSplit { kTrain, kValidation, kTest };
inline constexpr std::array<std::string_view, 3> kKitSplitNames = {"train", "validation", "test"};

/// By their names. @throws UsageError naming the nearest, or all.
KitTask KitTaskNamed(const std::string& name);
KitSplit KitSplitNamed(const std::string& name);

/// An input with its truth.
struct KitItem {
  std::string name;   ///< Of its input and its prediction: "person-007-a-rough".
  int person = 0;     ///< From 0, over all splits.
  std::string truth;  ///< Of its truth: "person-007-a"; several drawings show one face.
  std::string group;  ///< Style of a drawing or a portrait, "level-2" of a caricature.
};

inline constexpr const char* kBenchmarkKind = "benchmark";
inline constexpr int kBenchmarkVersion = 1;

/// The folder of inputs of a task: portraits are those of landmarks, too.
std::string InputFolder(KitTask task, KitSplit split);
std::string TruthFolder(KitTask task, KitSplit split);

/// A folder that `daumier benchmark make` wrote:
///   inputs/SPLIT/drawings/NAME.png, inputs/SPLIT/portraits/NAME.png,
///   inputs/SPLIT/caricatures/NAME.pts (pixels) and NAME.xyz (68 rows x y z, cm)
///   truth/SPLIT/{drawings,caricatures,portraits}/NAME.npy: V x 3 float32, cm, of template.obj
///   truth/SPLIT/portraits/NAME.pts: 68 landmarks, pixels; truth/SPLIT/drawings/labels.json (eval/drawing_labels.h)
///   template.obj, landmarks.txt (68 vertices of it), template.safetensors, template.json; manifest.json
class Kit {
 public:
  /// Reads the manifest and the template. @throws Error naming the folder if it is no kit or of a newer version.
  explicit Kit(std::filesystem::path directory);

  const std::vector<KitItem>& items(KitTask task, KitSplit split) const { return items_[size_t(task)][size_t(split)]; }
  /// The input; of a caricature its landmarks in the picture.
  std::filesystem::path InputFile(KitTask task, KitSplit split, const KitItem& item) const;

  /// V x 3, cm. @throws Error naming the file: missing, of another number of vertices.
  geometry::Points TrueFace(KitTask task, KitSplit split, const KitItem& item) const;
  /// @throws Error naming the file.
  eval::LandmarkRow TrueLandmarks(KitSplit split, const KitItem& item) const;
  /// Of a side of the pictures of landmarks, pixels.
  double portrait_size() const { return portrait_size_; }

  const faces::FaceTemplate& face_template() const { return face_template_; }
  const Manifest& manifest() const { return manifest_; }
  const std::filesystem::path& directory() const { return directory_; }
  std::string name() const { return manifest_.details.at("name").get<std::string>(); }

 private:
  std::filesystem::path directory_;
  Manifest manifest_;
  faces::FaceTemplate face_template_;
  std::array<std::array<std::vector<KitItem>, 3>, 4> items_;
  double portrait_size_ = 0;
};

/// 68 landmarks of a file in any form that faces::OrderLandmarks orders. @throws Error naming the file, and the landmark that is
/// absent or no finite number; or if points are not those of a picture.
eval::LandmarkRow ReadLandmarkRow(const std::filesystem::path& file);

/// The text of an iBUG .pts file; three decimals.
std::string PtsText(const eval::LandmarkRow& row);

/// Items as they are in the manifest.
Json ItemsToJson(const std::vector<KitItem>& items);

}  // namespace daumier::benchmark

#include "rig/clip_json.h"

#include "core/error.h"
#include "core/json.h"
#include "rig/arkit_names.h"
#include "rig/recording_builder.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>

namespace daumier::rig {
namespace {

constexpr double kMediaPipeRate = 30;  ///< Of a webcam.

/// The value of the first of `keys` that an object has; null where it has none.
const Json* FindKey(const Json& object, std::initializer_list<const char*> keys) {
  if (!object.is_object()) return nullptr;
  for (const char* key : keys)
    if (const auto found = object.find(key); found != object.end()) return &*found;
  return nullptr;
}

const Json* FacesOf(const Json& frame) {
  return FindKey(frame, {"faceBlendshapes", "face_blendshapes"});
}
const Json* CategoryName(const Json& category) {
  return FindKey(category, {"categoryName", "category_name", "name"});
}
bool IsCategory(const Json& json) {
  return CategoryName(json) != nullptr && FindKey(json, {"score", "value", "weight"}) != nullptr;
}
bool IsCategoryList(const Json& json) {
  return json.is_array() && !json.empty() && IsCategory(json.front());
}

/// What holds the weights of a frame: a list of categories, or an object {NAME: SCORE}. Null: there is no face.
const Json* WeightsOf(const Json& frame) {
  if (frame.is_null() || (frame.is_array() && frame.empty())) return nullptr;
  if (IsCategoryList(frame)) return &frame;
  if (frame.is_array()) return WeightsOf(frame.front());  // The faces of a picture.
  if (const Json* faces = FacesOf(frame)) return WeightsOf(*faces);
  if (const Json* categories = FindKey(frame, {"categories"})) return WeightsOf(*categories);
  if (const Json* inner = FindKey(frame, {"blendshapes", "blendShapes", "weights", "scores"}))
    if (inner->is_structured() || inner->is_null()) return WeightsOf(*inner);
  return &frame;
}

size_t NumFaces(const Json& frame) {
  const Json* faces = FacesOf(frame);
  return faces != nullptr && faces->is_array() && !IsCategoryList(*faces) ? faces->size() : 1;
}

/// A frame's own time.
struct FrameTime {
  double time;
  bool is_milliseconds;
};
std::optional<FrameTime> TimeOf(const Json& frame) {
  if (const Json* time = FindKey(frame, {"timestampMs", "timestamp_ms", "timeMs", "time_ms", "ms"}))
    if (time->is_number()) return FrameTime{time->get<double>(), true};
  if (const Json* time = FindKey(frame, {"timestamp", "time", "t", "seconds", "ts"}))
    if (time->is_number()) return FrameTime{time->get<double>(), false};
  return std::nullopt;
}
bool IsTimeKey(std::string_view key) {
  constexpr std::string_view kKeys[] = {"timestampMs", "timestamp_ms", "timeMs", "time_ms", "ms",
                                        "timestamp",   "time",         "t",      "seconds", "ts",
                                        "frame",       "index",        "id"};
  return std::ranges::find(kKeys, key) != std::end(kKeys);
}

/// The frames of a document, and what is next to their list.
struct FrameList {
  std::vector<const Json*> frames;
  const Json* around = nullptr;
};

FrameList FramesOf(const Json& document) {
  FrameList list;
  const Json* frames = nullptr;
  if (document.is_array() && !IsCategoryList(document)) {
    frames = &document;
  } else if (const Json* named = FindKey(document, {"frames", "results", "data", "recording"});
             named != nullptr && named->is_array()) {
    frames = named;
  } else if (const Json* shapes =
                 FindKey(document, {"faceBlendshapes", "face_blendshapes", "blendshapes", "blendShapes"});
             shapes != nullptr && shapes->is_array() && !IsCategoryList(*shapes)) {
    frames = shapes;
  }
  if (frames == nullptr) {
    list.frames.push_back(&document);
  } else {
    list.around = &document;
    for (const Json& frame : *frames) list.frames.push_back(&frame);
  }
  return list;
}

/// Pitch, yaw and roll of R = R_y R_x R_z.
std::array<double, 3> TurnOfRotation(const Eigen::Matrix3d& rotation) {
  const double pitch = std::asin(std::clamp(-rotation(1, 2), -1.0, 1.0));
  return {pitch, std::atan2(rotation(0, 2), rotation(2, 2)), std::atan2(rotation(1, 0), rotation(1, 1))};
}

/// The 16 numbers of a matrix in the file's order; nothing where there are not 16.
std::vector<double> NumbersOfMatrix(const Json& matrix) {
  const Json* data = FindKey(matrix, {"data", "packedData", "packed_data"});
  if (data == nullptr) data = &matrix;
  std::vector<double> numbers;
  if (!data->is_structured()) return {};
  for (const Json& entry : *data) {  // Also {"0": ..., "1": ...}, which is what a Float32Array becomes.
    if (entry.is_number()) numbers.push_back(entry.get<double>());
    if (!entry.is_array()) continue;
    for (const Json& number : entry)
      if (number.is_number()) numbers.push_back(number.get<double>());
  }
  return numbers.size() == 16 ? numbers : std::vector<double>();
}

/// The turn of the head by the matrix from the canonical face to the camera's space; nothing without one. Whether
/// the file lists rows or columns follows from the last row, 0 0 0 1.
std::optional<std::array<double, 3>> HeadTurnOf(const Json& frame) {
  const Json* matrices = FindKey(frame, {"facialTransformationMatrixes", "facial_transformation_matrixes",
                                         "facialTransformationMatrix", "transformationMatrix", "matrix"});
  if (matrices == nullptr) return std::nullopt;
  std::vector<double> numbers = NumbersOfMatrix(*matrices);
  if (numbers.empty() && matrices->is_array() && !matrices->empty()) numbers = NumbersOfMatrix(matrices->front());
  if (numbers.empty()) return std::nullopt;
  Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
  const Eigen::RowVector4d last(0, 0, 0, 1);
  if (matrix.row(3) != last && matrix.col(3).transpose() == last) matrix.transposeInPlace();
  Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const double scale = std::cbrt(rotation.determinant());
  if (!(scale > 1e-6) || !(scale < 1e6)) return std::nullopt;
  return TurnOfRotation(rotation / scale);
}

class ClipJsonReader {
 public:
  explicit ClipJsonReader(const std::string& name) : name_(name), builder_(name) {}

  Recording Read(const FrameList& list) {
    const std::vector<double> seconds = TimesOf(list);
    size_t num_of_several = 0;
    for (size_t i = 0; i < list.frames.size(); ++i) {
      const Json* weights = WeightsOf(*list.frames[i]);
      if (weights == nullptr || weights->empty()) {
        builder_.CountWithoutFace();
        continue;
      }
      num_of_several += NumFaces(*list.frames[i]) > 1 ? 1 : 0;
      const std::string place = fmt::format("frame {}", i + 1);
      builder_.AddFrame(seconds[i], place);
      AddWeights(*weights, place);
      if (const auto turn = HeadTurnOf(*list.frames[i])) builder_.SetTurn(TurnedPart::kHead, *turn);
    }
    if (num_of_several > 0)
      builder_.Warn(fmt::format("{} frame{} several faces, of which the first is read", num_of_several,
                                num_of_several == 1 ? " has" : "s have"));
    return builder_.Finish(/*is_in_radians=*/true);
  }

 private:
  void AddScore(std::string_view target_name, const Json& score, const std::string& place) {
    if (target_name == "_neutral" || target_name == "neutral") return;
    const auto target = builder_.FindTarget(target_name);
    if (!target) return;
    DAUMIER_CHECK(score.is_number(),
                  "{}: {}: {} is {} (expected a number from 0 to 1). Correct it, or remove the frame", name_, place,
                  target_name, score.dump().substr(0, 40));
    builder_.SetWeight(*target, score.get<double>());
  }

  void AddWeights(const Json& weights, const std::string& place) {
    if (weights.is_object()) {
      for (const auto& [key, score] : weights.items()) {
        if (score.is_number() ? !IsTimeKey(key) : FindArkitName(key).has_value()) AddScore(key, score, place);
      }
      return;
    }
    DAUMIER_CHECK(weights.is_array(),
                  "{}: {}: is {} (expected categories [{{\"categoryName\", \"score\"}}, ...] or {{NAME: SCORE}})",
                  name_, place, weights.dump().substr(0, 40));
    for (const Json& category : weights) {
      DAUMIER_CHECK(IsCategory(category) && CategoryName(category)->is_string(),
                    "{}: {}: {} is no category (expected {{\"categoryName\": \"jawOpen\", \"score\": 0.5}})", name_,
                    place, category.dump().substr(0, 60));
      AddScore(CategoryName(category)->get_ref<const std::string&>(), *FindKey(category, {"score", "value", "weight"}),
               place);
    }
  }

  std::vector<double> Even(size_t count, double rate) const {
    std::vector<double> seconds(count);
    for (size_t i = 0; i < count; ++i) seconds[i] = double(i) / rate;
    return seconds;
  }

  std::vector<double> TimesOf(const FrameList& list) {
    const size_t count = list.frames.size();
    if (list.around != nullptr) {
      const Json* times = FindKey(*list.around, {"timestamps", "times", "timestampsMs", "timestamps_ms"});
      if (times != nullptr && times->is_array() && times->size() == count) {
        const bool is_milliseconds = FindKey(*list.around, {"timestampsMs", "timestamps_ms"}) == times;
        std::vector<double> numbers;
        for (const Json& time : *times)
          if (time.is_number()) numbers.push_back(time.get<double>());
        if (numbers.size() == count) return SecondsOf(std::move(numbers), is_milliseconds);
      }
      const Json* rate = FindKey(*list.around, {"fps", "frameRate", "frame_rate", "framesPerSecond", "exportFps"});
      if (rate != nullptr && rate->is_number() && rate->get<double>() > 0) return Even(count, rate->get<double>());
    }
    std::vector<double> numbers;
    bool is_milliseconds = false;
    for (const Json* frame : list.frames) {
      const auto time = TimeOf(*frame);
      if (!time) break;
      numbers.push_back(time->time);
      is_milliseconds = time->is_milliseconds;
    }
    if (numbers.size() == count) return SecondsOf(std::move(numbers), is_milliseconds);
    builder_.Warn(
        fmt::format("{}: {} frames a second are assumed",
                    numbers.empty() ? "states no times" : fmt::format("frame {} states no time", numbers.size() + 1),
                    kMediaPipeRate));
    return Even(count, kMediaPipeRate);
  }

  const std::string& name_;
  RecordingBuilder builder_;
};

/// A frame a line; nothing where a line is no JSON.
std::optional<Json> ParseLines(std::string_view text) {
  Json frames = Json::array();
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    auto frame = TryParseJson(line);
    if (!frame) return std::nullopt;
    frames.push_back(std::move(*frame));
  }
  return frames;
}

}  // namespace

Recording ParseClipJson(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::optional<Json> document = TryParseJson(text);
  if (!document) document = ParseLines(text);
  if (!document) document = ParseJson(text, name);  // Throws.
  const FrameList list = FramesOf(*document);
  DAUMIER_CHECK(!list.frames.empty(), "{}: contains no frame (the list is empty)", name);
  return ClipJsonReader(name).Read(list);
}

}  // namespace daumier::rig

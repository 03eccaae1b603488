#include "eval/drawing_labels.h"

#include "core/error.h"
#include "core/json.h"
#include "core/options.h"
#include "faces/face_points.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace daumier::eval {
namespace {

/// The index of `word` in `names`. @throws Error suggesting the nearest.
template <size_t N>
size_t IndexOfTerm(const std::array<std::string_view, N>& names, const std::string& word, const char* what) {
  const auto found = std::ranges::find(names, word);
  if (found != names.end()) return size_t(found - names.begin());
  const std::string nearest = NearestWord(word, {names.begin(), names.end()});
  throw Error(fmt::format("there is no {} '{}' ({})", what, word,
                          nearest.empty() ? fmt::format("expected {}", fmt::join(names, ", "))
                                          : fmt::format("did you mean '{}'?", nearest)));
}

template <class State, size_t N>
std::optional<State> StateIn(const Json& drawing, const char* key, const std::array<std::string_view, N>& names) {
  const auto found = drawing.find(key);
  if (found == drawing.end() || found->is_null()) return std::nullopt;
  return static_cast<State>(IndexOfTerm(names, found->get<std::string>(), key));
}

LabelledDrawing DrawingFromJson(const std::string& name, const Json& json, const std::filesystem::path& folder) {
  LabelledDrawing drawing{.name = name};
  drawing.file = folder / json.at("file").get<std::string>();
  drawing.group = drawing.file.extension() == ".ndjson" ? "doodles" : "pictures";
  drawing.line = json.value("line", 1);
  drawing.usable = json.value("usable", true);
  if (const auto found = json.find("interocular"); found != json.end() && !found->is_null())
    drawing.interocular = found->get<double>();
  DAUMIER_CHECK(std::isfinite(drawing.interocular) && drawing.interocular >= 0, "interocular is {:g}, expected > 0",
                drawing.interocular);
  drawing.mouth = StateIn<faces::MouthState>(json, "mouth", faces::kMouthStateNames);
  drawing.eyes = StateIn<faces::EyeState>(json, "eyes", faces::kEyeStateNames);
  int num_fixed = 0;
  for (const auto& [point_name, point] : json.at("points").items()) {
    const size_t index = IndexOfTerm(faces::kFacePointNames, point_name, "point");
    if (point.is_null()) continue;
    DAUMIER_CHECK(point.size() == 2, "{} has {} numbers, expected x and y", point_name, point.size());
    drawing.points[index] = Eigen::Vector2d(point.at(0).get<double>(), point.at(1).get<double>());
    if (!faces::ContourOf(static_cast<faces::FacePoint>(index))) ++num_fixed;
  }
  DAUMIER_CHECK(!drawing.is_scored() || num_fixed >= 2,
                "it has {} points besides those of contours, expected 2 or more. Set \"usable\": false", num_fixed);
  return drawing;
}

}  // namespace

std::vector<LabelledDrawing> ReadDrawingLabels(const std::filesystem::path& file) {
  const Json labels = ReadJson(file);
  DAUMIER_CHECK(labels.is_object() && labels.contains("drawings") && labels.at("drawings").is_object() &&
                    !labels.at("drawings").empty(),
                "{}: no labels of drawings (expected {{\"drawings\": {{NAME: {{\"file\": ..., \"points\": ...}}}}}})",
                file.string());
  std::vector<LabelledDrawing> drawings;
  for (const auto& [name, json] : labels.at("drawings").items()) {
    try {
      drawings.push_back(DrawingFromJson(name, json, file.parent_path()));
    } catch (const Json::exception& error) {
      throw Error(fmt::format("{}: drawing '{}' is malformed: {}", file.string(), name, TextOf(error)));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: drawing '{}': {}", file.string(), name, error.what()));
    }
  }
  return drawings;
}

}  // namespace daumier::eval

#include "systems/portrait/landmark_report.h"

#include "core/error.h"
#include "core/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace daumier::portrait {
namespace {

using ErrorList = std::vector<LandmarkErrors>;

double MeanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

/// Null values where nothing was found, or where the truth of a part is not known.
Json ErrorSummary(const ErrorList& errors) {
  if (errors.empty()) return {{"median", nullptr}, {"mean", nullptr}, {"p90", nullptr}, {"eyes_median", nullptr}};
  const auto values = [&](const std::function<double(const LandmarkErrors&)>& of) {
    std::vector<double> list;
    for (const LandmarkErrors& error : errors)
      if (std::isfinite(of(error))) list.push_back(of(error));
    return list;
  };
  const std::vector<double> all = values([](const LandmarkErrors& error) { return error.all; });
  Json summary = {{"median", Percentile(all, 50)}, {"mean", MeanOf(all)}, {"p90", Percentile(all, 90)}};
  for (size_t part = 0; part < kLandmarkParts.size(); ++part) {
    const std::vector<double> of_part = values([part](const LandmarkErrors& error) { return error.parts[part]; });
    summary[std::string(kLandmarkParts[part].name) + "_median"] =
        of_part.empty() ? Json() : Json(Percentile(of_part, 50));
  }
  return summary;
}

std::string PercentText(const Json& summary, const char* key) {
  const Json& value = summary.at(key);
  return value.is_null() ? "-" : fmt::format("{:.2f} %", 100 * value.get<double>());
}

constexpr std::array<const char*, kNumPictureClasses> kClassNames = {"background", "skin",  "brows", "eyes",
                                                                     "lips",       "mouth", "ears",  "hair"};
constexpr std::array<const char*, kNumFaceStates> kStateNames = {"is_face", "right_eye_closed", "left_eye_closed",
                                                                 "mouth_open"};

}  // namespace

Json PicturesToJson(std::span<const PictureMeasurement> pictures) {
  ErrorList found, boxed, rival;
  std::vector<double> milliseconds;
  Json list = Json::array();
  bool has_rival = false;
  for (const PictureMeasurement& picture : pictures) {
    if (picture.errors) found.push_back(*picture.errors);
    if (picture.boxed) boxed.push_back(*picture.boxed);
    if (picture.rival) rival.push_back(*picture.rival);
    has_rival = has_rival || picture.rival.has_value();
    milliseconds.push_back(picture.milliseconds);
    list.push_back({{"name", picture.name},
                    {"found", picture.found},
                    {"confidence", picture.face ? picture.face->confidence : 0},
                    {"error", picture.errors ? Json(picture.errors->all) : Json()},
                    {"eyes", picture.errors && std::isfinite(picture.errors->parts[3]) ? Json(picture.errors->parts[3])
                                                                                       : Json()}});
  }
  Json json = ErrorSummary(found);
  json["num"] = pictures.size();
  json["found"] = found.size();
  json["box_given"] = ErrorSummary(boxed);
  json["box_given"]["num"] = boxed.size();
  json["rival"] = Json();
  if (has_rival) {
    json["rival"] = ErrorSummary(rival);
    json["rival"]["num_found"] = rival.size();
  }
  json["milliseconds"] = Percentile(milliseconds, 50);
  json["pictures"] = list;
  return json;
}

Json NegativesToJson(std::span<const NegativeMeasurement> negatives, double least_confidence) {
  const auto count = [&](double threshold) {
    return std::ranges::count_if(negatives, [&](const auto& picture) { return picture.confidence >= threshold; });
  };
  Json by_threshold = Json::object(), list = Json::array();
  for (const double threshold : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
    by_threshold[fmt::format("{:.2f}", threshold)] = count(threshold);
  for (const NegativeMeasurement& picture : negatives)
    if (picture.confidence >= 0.1) list.push_back({{"name", picture.name}, {"confidence", picture.confidence}});
  return {{"num", negatives.size()},
          {"least_confidence", least_confidence},
          {"false_faces", count(least_confidence)},
          {"by_threshold", by_threshold},
          {"pictures", list}};
}

reports::ReportTable PicturesTable(const Json& pictures) {
  reports::ReportTable table{"Given pictures, errors of the eye distance",
                             {"landmarks", "found", "median", "mean", "p90", "eyes, median"},
                             {}};
  const auto add = [&](const char* name, const Json& summary, size_t found) {
    table.rows.push_back({name, fmt::format("{} of {}", found, pictures.at("num").get<size_t>()),
                          PercentText(summary, "median"), PercentText(summary, "mean"), PercentText(summary, "p90"),
                          PercentText(summary, "eyes_median")});
  };
  add("network, face searched", pictures, pictures.at("found").get<size_t>());
  if (!pictures.at("box_given").at("median").is_null())
    add("network, box given", pictures.at("box_given"), pictures.at("box_given").at("num").get<size_t>());
  if (!pictures.at("rival").is_null())
    add("rival", pictures.at("rival"), pictures.at("rival").at("num_found").get<size_t>());
  return table;
}

Json TonesToJson(const std::map<int, std::vector<double>>& errors_of_tones) {
  Json tones = Json::object();
  std::vector<double> means;
  for (const auto& [tone, errors] : errors_of_tones) {
    means.push_back(MeanOf(errors));
    tones[fmt::format("{}", tone)] = {{"error", means.back()}, {"num", errors.size()}};
  }
  const auto [least, most] = std::ranges::minmax(means);
  return {{"tones", tones}, {"spread", (most - least) / MeanOf(means)}};
}

Json LabelsToJson(const LabelCounts& counts) {
  Json json = {{"mean", counts.mean_iou()}};
  for (size_t k = 0; k < kClassNames.size(); ++k) json[kClassNames[k]] = counts.iou(PictureClass(k));
  return json;
}

Json StatesToJson(std::span<const PortraitMeasurement> portraits) {
  Json json = Json::object();
  for (size_t k = 0; k < kStateNames.size(); ++k) {
    int64_t known = 0, wrong = 0;
    for (const PortraitMeasurement& portrait : portraits) {
      known += portrait.known_states[k];
      wrong += portrait.wrong_states[k];
    }
    json[kStateNames[k]] = {{"num", known}, {"wrong", known > 0 ? Json(double(wrong) / double(known)) : Json()}};
  }
  return json;
}

}  // namespace daumier::portrait

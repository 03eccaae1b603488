#include "faces/annotation_file.h"

#include "core/error.h"
#include "core/json.h"
#include "embedded/annotations.h"

#include <algorithm>
#include <set>

namespace daumier::faces {

namespace {

/// One JSON object of an annotation file, whose messages contain its position in the file.
class Entry {
 public:
  Entry(const Json& json, std::string where, const std::set<std::string>& known)
      : json_(json), where_(std::move(where)) {
    DAUMIER_CHECK(json_.is_object(), "{}: expected an object", where_);
    for (const auto& [key, value] : json_.items())
      DAUMIER_CHECK(known.count(key) == 1, "{}: unknown key '{}'", where_, key);
  }

  bool has(const std::string& key) const { return json_.contains(key); }
  const Json& at(const std::string& key) const {
    DAUMIER_CHECK(has(key), "{}: '{}' is missing", where_, key);
    return json_.at(key);
  }
  template <class T>
  T get(const std::string& key) const {
    try {
      return at(key).get<T>();
    } catch (const Json::exception&) {
      throw Error(fmt::format("{}: '{}' has the wrong type", where_, key));
    }
  }
  template <class T>
  T get(const std::string& key, T otherwise) const {
    return has(key) ? get<T>(key) : otherwise;
  }
  const std::string& where() const { return where_; }

 private:
  const Json& json_;
  std::string where_;
};

void CheckFormat(const Entry& file) {
  const int format = file.get<int>("format");
  DAUMIER_CHECK(format == AnnotationFile::kFormat, "{}: format {} is not known; this program reads format {}",
                file.where(), format, AnnotationFile::kFormat);
}

WaypointLoop ParseLoop(const Json& json, const std::string& where) {
  const Entry entry(json, where, {"name", "waypoints", "mirror_of"});
  return {entry.get<std::string>("name"), entry.get<std::vector<int>>("waypoints", {}),
          entry.get<std::string>("mirror_of", "")};
}

RegionRule ParseRegion(const std::string& name, const Json& json, const std::string& where) {
  const Entry entry(json, where, {"loop", "seed", "mirror_of", "range", "vertices"});
  RegionRule rule{.name = name,
                  .loop = entry.get<std::vector<int>>("loop", {}),
                  .seed = entry.get<int>("seed", -1),
                  .mirror_of = entry.get<std::string>("mirror_of", ""),
                  .range = {},
                  .vertices = entry.get<std::vector<int>>("vertices", {})};
  if (entry.has("range")) {
    rule.range = entry.get<std::pair<int, int>>("range");
    DAUMIER_CHECK(rule.range->first <= rule.range->second, "{}: range [{}, {}] is empty", where, rule.range->first,
                  rule.range->second);
  }
  DAUMIER_CHECK(
      rule.range || !rule.mirror_of.empty() || !rule.vertices.empty() || (rule.loop.size() > 2 && rule.seed >= 0),
      "{}: a region needs loop and seed, mirror_of, range, or vertices", where);
  return rule;
}

CurveRule ParseCurve(const Json& json, const std::string& where) {
  const Entry entry(json, where, {"name", "kind", "view", "closed", "waypoints", "mirror"});
  CurveRule rule;
  rule.curve.name = entry.get<std::string>("name");
  rule.curve.kind = entry.get<std::string>("kind");
  const auto& kinds = CurveKinds();
  DAUMIER_CHECK(std::find(kinds.begin(), kinds.end(), rule.curve.kind) != kinds.end(),
                "{}: unknown kind '{}', expected one of {}", where, rule.curve.kind, fmt::join(kinds, ", "));
  const std::string view = entry.get<std::string>("view");
  DAUMIER_CHECK(view == "frontal" || view == "side", "{}: view '{}' is neither frontal nor side", where, view);
  rule.curve.view = view == "side" ? View::kSide : View::kFrontal;
  rule.curve.closed = entry.get<bool>("closed", false);
  rule.curve.vertices = entry.get<std::vector<int>>("waypoints");
  rule.mirror = entry.get<bool>("mirror", false);
  return rule;
}

}  // namespace

AnnotationFile ParseAnnotationFile(std::string_view text, std::string_view name) {
  const Json json = ParseJson(text, std::string(name));
  const Entry file(json, std::string(name),
                   {"format", "source", "landmarks", "hairline", "cm_per_unit", "crop", "regions", "curves"});
  CheckFormat(file);
  AnnotationFile result;
  const auto landmarks = file.get<std::vector<int>>("landmarks");
  DAUMIER_CHECK(landmarks.size() == 68, "{}: {} landmarks, expected 68", name, landmarks.size());
  std::copy(landmarks.begin(), landmarks.end(), result.landmarks.begin());
  result.hairline = file.get<int>("hairline");

  if (file.has("cm_per_unit")) {
    result.cm_per_unit = file.get<double>("cm_per_unit");
    DAUMIER_CHECK(*result.cm_per_unit > 0, "{}: 'cm_per_unit' is {}, expected a positive number", name,
                  *result.cm_per_unit);
  }
  if (file.has("crop")) {
    const Entry crop(file.at("crop"), fmt::format("{}: crop", name), {"seed", "cuts"});
    result.crop_seed = crop.get<int>("seed");
    for (const Json& cut : crop.at("cuts"))
      result.cuts.push_back(ParseLoop(cut, fmt::format("{}: cut {}", name, result.cuts.size())));
  }
  if (file.has("regions")) {
    for (const auto& [region, rule] : file.at("regions").items())
      result.regions.push_back(ParseRegion(region, rule, fmt::format("{}: region {}", name, region)));
  }
  if (file.has("curves")) {
    for (const Json& curve : file.at("curves"))
      result.curves.push_back(ParseCurve(curve, fmt::format("{}: curve {}", name, result.curves.size())));
  }
  return result;
}

std::vector<ExpressionRecipe> ParseExpressionFile(std::string_view text, std::string_view name) {
  const Json json = ParseJson(text, std::string(name));
  const Entry file(json, std::string(name), {"format", "source", "expressions"});
  CheckFormat(file);
  std::vector<ExpressionRecipe> recipes;
  std::set<std::string> names;
  for (const Json& item : file.at("expressions")) {
    const Entry entry(item, fmt::format("{}: expression {}", name, recipes.size()), {"name", "weights"});
    ExpressionRecipe& recipe = recipes.emplace_back();
    recipe.name = entry.get<std::string>("name");
    DAUMIER_CHECK(names.insert(recipe.name).second, "{}: the name '{}' comes twice", entry.where(), recipe.name);
    for (const auto& [shape, weight] : entry.at("weights").items()) {
      DAUMIER_CHECK(weight.is_number(), "{}: the weight of {} is no number", entry.where(), shape);
      recipe.weights.emplace_back(shape, weight.get<float>());
    }
  }
  DAUMIER_CHECK(!recipes.empty() && recipes[0].name == "neutral" && recipes[0].weights.empty(),
                "{}: the first expression has to be neutral, without weights", name);
  return recipes;
}

std::string_view EmbeddedAnnotation(const std::string& stem) {
  const auto found = EmbeddedFiles().find(stem);
  DAUMIER_CHECK(found != EmbeddedFiles().end(), "this program was built without the annotation {}", stem);
  return found->second;
}

}  // namespace daumier::faces

#include "studio/shape_document.h"

#include "core/error.h"
#include "core/options.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace daumier::studio {
namespace {

double NumberFrom(const Json& json, const std::string& key, Range range) {
  if (!json.is_number() || !(json.get<double>() >= range.min && json.get<double>() <= range.max))
    throw UsageError(fmt::format("'{}' is {}, expected a number from {} to {}", key, json.dump().substr(0, 40),
                                 range.min, range.max));
  return json.get<double>();
}

std::string NameFrom(const Json& json, const std::string& key) {
  if (!json.is_string()) throw UsageError(fmt::format("'{}' is {}, expected a name", key, json.dump().substr(0, 40)));
  return json.get<std::string>();
}

std::map<std::string, double> NumbersFrom(const Json& json, const std::string& key, Range range) {
  if (!json.is_object()) throw UsageError(fmt::format("'{}' is no object of numbers", key));
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : json.items()) numbers[name] = NumberFrom(value, name, range);
  return numbers;
}

ShapeHandle HandleFrom(const Json& json) {
  const Json move = json.is_object() ? json.value("move", Json()) : Json();
  if (!move.is_array() || move.size() != 3 || !json.value("vertex", Json()).is_number_integer())
    throw UsageError("'handles' is a list of {\"vertex\": number, \"move\": [x, y, z]}");
  constexpr double kMostVertex = 1e9;
  ShapeHandle handle{.vertex = int(NumberFrom(json.at("vertex"), "vertex", {0, kMostVertex})), .move = {}};
  for (int axis = 0; axis < 3; ++axis)
    handle.move[axis] = NumberFrom(move[size_t(axis)], "move", {-kMostMove, kMostMove});
  return handle;
}

ShapeDocument::Toward TowardFrom(const Json& json) {
  if (!json.is_object() || !json.contains("face") || !json.contains("share"))
    throw UsageError("'toward' is {\"face\": a pinned face, \"share\": 0 to 1}");
  return {NameFrom(json.at("face"), "face"), NumberFrom(json.at("share"), "share", {0, 1})};
}

}  // namespace

ShapeDocument ShapeDocument::Neutral() const {
  ShapeDocument neutral = *this;
  neutral.expressions.clear();
  neutral.gains.clear();
  return neutral;
}

ShapeDocument ShapeDocument::WithoutHandles() const {
  ShapeDocument document = *this;
  document.handles.clear();
  return document;
}

ShapeDocument ShapeFromJson(const Json& json) {
  static const std::set<std::string> keys = {"base",       "toward",  "controls",    "exaggeration",
                                             "caricature", "handles", "expressions", "gains"};
  if (!json.is_object()) throw UsageError("a shape is an object");
  ShapeDocument shape;
  for (const auto& [key, value] : json.items()) {
    if (!keys.contains(key)) {
      const std::string nearest = NearestWord(key, keys);
      throw UsageError(fmt::format("a shape has no '{}'{}", key.substr(0, 40),
                                   nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
    }
    if (value.is_null()) continue;
    if (key == "base") shape.base = NameFrom(value, key);
    if (key == "toward") shape.toward = TowardFrom(value);
    if (key == "controls") shape.controls = NumbersFrom(value, key, {-3, 3});
    if (key == "exaggeration") shape.exaggeration = NumberFrom(value, key, {0, kMostExaggeration});
    if (key == "caricature") shape.caricature = NumberFrom(value, key, {0, kMostCaricature});
    if (key == "expressions") shape.expressions = NumbersFrom(value, key, {kLeastExpression, kMostExpression});
    if (key == "gains") shape.gains = NumbersFrom(value, key, {0, kMostGain});
    if (key == "handles") {
      if (!value.is_array()) throw UsageError("'handles' is no list");
      for (const Json& handle : value) shape.handles.push_back(HandleFrom(handle));
    }
  }
  return shape;
}

Json ShapeSchema() {
  const auto number = [](double least, double greatest) {
    return Json{{"type", "number"}, {"minimum", least}, {"maximum", greatest}};
  };
  const auto numbers = [&](double least, double greatest) {
    return Json{{"type", "object"}, {"additionalProperties", number(least, greatest)}};
  };
  const Json text = {{"type", "string"}};
  const Json move = {{"type", "array"}, {"items", number(-kMostMove, kMostMove)}, {"minItems", 3}, {"maxItems", 3}};
  Json properties;
  properties["base"] = {{"type", "string"}, {"description", "\"mean\", a pinned face or a session"}};
  properties["toward"] = {{"type", "object"}, {"properties", {{"face", text}, {"share", number(0, 1)}}}};
  properties["controls"] = numbers(-3, 3);
  properties["exaggeration"] = number(0, kMostExaggeration);
  properties["caricature"] = number(0, kMostCaricature);
  properties["handles"] = {
      {"type", "array"},
      {"items", {{"type", "object"}, {"properties", {{"vertex", {{"type", "integer"}}}, {"move", move}}}}}};
  properties["expressions"] = numbers(kLeastExpression, kMostExpression);
  properties["gains"] = numbers(0, kMostGain);
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

}  // namespace daumier::studio

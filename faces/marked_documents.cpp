#include "faces/marked_documents.h"

#include "core/error.h"
#include "core/json.h"

#include <charconv>
#include <cmath>
#include <pugixml.hpp>

namespace daumier::faces {
namespace {

/// Keys below which programs store a list of points, and a point's coordinates.
constexpr const char* kListKeys[] = {"landmarks", "points", "controlPoints", "vertices", "landmark_points"};
constexpr const char* kPlaceKeys[] = {"coordinates", "position", "point", "xyz", "pos"};

/// Numbers of a JSON value that is a point; nothing where it is null. @throws Error naming the entry.
class JsonPoints {
 public:
  explicit JsonPoints(const std::filesystem::path& path) : name_(path.string()) {}

  MarkedPoints Parse(const Json& json) {
    AddList(json);
    const bool has_labels = std::any_of(marked_.labels.begin(), marked_.labels.end(),
                                        [](const std::string& label) { return !label.empty(); });
    if (!has_labels) marked_.labels.clear();
    marked_.dimension = dimension_.value_or(1);
    return std::move(marked_);
  }

 private:
  [[noreturn]] void Fail(const Json& json) const {
    const std::string text = json.is_structured() ? fmt::format("{} of {} entries", json.type_name(), json.size())
                                                  : json.dump().substr(0, 40);
    throw Error(
        fmt::format("{}: point {}: found {}, expected coordinates or a vertex", name_, marked_.points.size(), text));
  }

  void AddList(const Json& json) {
    const Json* list = &json;
    // [[[x, y], ...]]: one face of several.
    while (list->is_array() && list->size() == 1 && list->front().is_array() && !list->front().empty() &&
           list->front().front().is_array())
      list = &list->front();
    if (list->is_array()) {
      for (const Json& entry : *list) AddPoint(entry, "");
    } else if (list->is_object() && list->contains("markups") && list->at("markups").is_array()) {
      for (const Json& markup : list->at("markups")) AddMarkup(markup);
    } else if (list->is_object()) {
      CheckLists(*list);
      for (const char* key : kListKeys) {
        if (!list->contains(key) || !list->at(key).is_structured()) continue;
        const Json& points = list->at(key);
        if (points.is_array()) {
          for (const Json& entry : points) AddPoint(entry, "");
        } else {
          for (const auto& [label, entry] : points.items()) AddPoint(entry, label);
        }
        return;
      }
      for (const auto& [label, entry] : list->items()) AddPoint(entry, label);
    } else {
      Fail(*list);
    }
  }

  /// Keys of lists with something else.
  void CheckLists(const Json& json) const {
    for (const char* key : {"markups", "landmarks", "points", "controlPoints", "landmark_points"}) {
      DAUMIER_CHECK(!json.contains(key) || json.at(key).is_structured(), "{}: \"{}\" is {}, expected a list of {}",
                    name_, key, json.at(key).dump().substr(0, 40),
                    std::string_view(key) == "markups" ? "markups" : "points");
    }
  }

  void AddMarkup(const Json& markup) {
    if (!markup.is_object() || !markup.contains("controlPoints") || !markup.at("controlPoints").is_array())
      Fail(markup);
    const Json frame = markup.value("coordinateSystem", Json());
    if (frame == "LPS" || frame == "1") marked_.frame = PatientFrame::kLps;
    if (frame == "RAS" || frame == "0") marked_.frame = PatientFrame::kRas;
    for (const Json& point : markup.at("controlPoints")) AddPoint(point, "");
  }

  void AddPoint(const Json& json, std::string label) {
    if (json.is_null()) return Add(std::nullopt, 0, std::move(label));
    if (json.is_number()) return Add(geometry::Vector3(json.get<double>(), 0, 0), 1, std::move(label));
    if (json.is_array()) return AddPlace(json, std::move(label));
    if (!json.is_object()) Fail(json);
    for (const char* key : {"label", "name", "id"}) {
      if (label.empty() && json.contains(key) && (json.at(key).is_string() || json.at(key).is_number()))
        label = json.at(key).is_string() ? json.at(key).get<std::string>() : json.at(key).dump();
    }
    const Json status = json.value("positionStatus", Json());
    if (status == "undefined" || status == "missing") return Add(std::nullopt, 0, std::move(label));
    for (const char* key : kPlaceKeys) {
      if (!json.contains(key)) continue;
      const Json& place = json.at(key);
      if (place.is_null()) return Add(std::nullopt, 0, std::move(label));
      if (place.is_array()) return AddPlace(place, std::move(label));
      if (place.is_object()) return AddAxes(place, std::move(label));
    }
    if (json.contains("vertex") && json.at("vertex").is_number())
      return Add(geometry::Vector3(json.at("vertex").get<double>(), 0, 0), 1, std::move(label));
    AddAxes(json, std::move(label));
  }

  void AddAxes(const Json& json, std::string label) {
    if (!json.contains("x") || !json.contains("y")) Fail(json);
    Json place = {json.at("x"), json.at("y")};
    if (json.contains("z")) place.push_back(json.at("z"));
    AddPlace(place, std::move(label));
  }

  void AddPlace(const Json& numbers, std::string label) {
    if (numbers.empty()) return Add(std::nullopt, 0, std::move(label));
    if (numbers.size() > 3) Fail(numbers);
    geometry::Vector3 place = geometry::Vector3::Zero();
    bool is_there = true;
    for (size_t axis = 0; axis < numbers.size(); ++axis) {
      if (!numbers[axis].is_number() && !numbers[axis].is_null()) Fail(numbers);
      is_there = is_there && numbers[axis].is_number();
      if (numbers[axis].is_number()) place[Eigen::Index(axis)] = numbers[axis].get<double>();
    }
    Add(is_there ? std::optional(place) : std::nullopt, static_cast<int>(numbers.size()), std::move(label));
  }

  /// `dimension` 0: that of the others.
  void Add(std::optional<geometry::Vector3> place, int dimension, std::string label) {
    if (dimension > 0) {
      DAUMIER_CHECK(!dimension_ || *dimension_ == dimension, "{}: point {} has {} numbers, those before have {}", name_,
                    marked_.points.size(), dimension, *dimension_);
      dimension_ = dimension;
    }
    DAUMIER_CHECK(!place || place->allFinite(), "{}: point {} is not finite", name_, marked_.points.size());
    marked_.points.push_back(place);
    marked_.labels.push_back(std::move(label));
  }

  std::string name_;
  MarkedPoints marked_;
  std::optional<int> dimension_;
};

double AttributeNumber(const pugi::xml_node& node, const char* key, const std::string& name, size_t point) {
  const std::string_view text = node.attribute(key).value();
  double number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  DAUMIER_CHECK(error == std::errc() && stop == text.data() + text.size() && std::isfinite(number),
                "{}: point {}: {}=\"{}\" is not a number", name, point, key, text);
  return number;
}

}  // namespace

MarkedPoints ParseMarkedJson(std::string_view text, const std::filesystem::path& path) {
  return JsonPoints(path).Parse(ParseJson(text, path.string()));
}

MarkedPoints ParseMarkedXml(std::string_view text, const std::filesystem::path& path) {
  const std::string name = path.string();
  pugi::xml_document document;
  const auto parsed = document.load_buffer(text.data(), text.size());
  DAUMIER_CHECK(parsed, "{}: not XML: {}", name, parsed.description());
  const pugi::xml_node root = document.document_element();
  MarkedPoints marked;
  if (std::string_view(root.name()) == "PickedPoints") {
    for (const pugi::xml_node& point : root.children("point")) {
      marked.labels.emplace_back(point.attribute("name").value());
      const bool is_active = point.attribute("active").as_int(1) != 0;
      marked.points.emplace_back();
      if (!is_active) continue;
      const size_t number = marked.points.size() - 1;
      marked.points.back() =
          geometry::Vector3(AttributeNumber(point, "x", name, number), AttributeNumber(point, "y", name, number),
                            AttributeNumber(point, "z", name, number));
    }
    return marked;
  }
  const pugi::xml_node images = root.child("images"), image = images.child("image"), box = image.child("box");
  DAUMIER_CHECK(std::string_view(root.name()) == "dataset" && box,
                "{}: found <{}>, expected MeshLab's <PickedPoints> or imglab's <dataset>", name, root.name());
  DAUMIER_CHECK(!image.next_sibling("image") && !box.next_sibling("box"),
                "{}: holds several boxes (expected one). Write a file for each picture", name);
  marked.dimension = 2;
  for (const pugi::xml_node& part : box.children("part")) {
    const size_t number = marked.points.size();
    marked.labels.emplace_back(part.attribute("name").value());
    marked.points.emplace_back(
        geometry::Vector3(AttributeNumber(part, "x", name, number), AttributeNumber(part, "y", name, number), 0));
  }
  return marked;
}

}  // namespace daumier::faces

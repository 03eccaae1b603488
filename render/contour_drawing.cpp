#include "render/contour_drawing.h"

#include "render/contour_strokes.h"

#include <pugixml.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace daumier::render {
namespace {

std::vector<std::string> AttributeNames(const pugi::xml_node& node) {
  std::vector<std::string> names;
  for (const pugi::xml_attribute& attribute : node.attributes()) names.emplace_back(attribute.name());
  return names;
}

}  // namespace

bool IsContourDrawing(const std::filesystem::path& file) {
  const std::vector<std::string> of_root = {"xmlns",  "width",        "height",         "viewBox",        "fill",
                                            "stroke", "stroke-width", "stroke-linecap", "stroke-linejoin"},
                                 of_path = {"class", "d"};
  pugi::xml_document document;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  if (!document.load_file(file.c_str(), pugi::parse_default | pugi::parse_comments)) return false;
  const pugi::xml_node root = document.document_element();
  if (std::string_view(root.name()) != "svg" || AttributeNames(root) != of_root || root.next_sibling()) return false;
  return std::ranges::all_of(root.children(), [&](const pugi::xml_node& path) {
    return std::string_view(path.name()) == "path" && AttributeNames(path) == of_path &&
           std::ranges::count(ContourKinds(), path.attribute("class").value()) == 1;
  });
}

}  // namespace daumier::render

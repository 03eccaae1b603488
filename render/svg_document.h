#pragma once
#include "render/svg_css.h"

#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::render {

/// Elements within elements; a deeper file is damaged or made to overflow the stack.
inline constexpr int kMaxSvgDepth = 200;

/// An SVG file as a tree: unpacked if it is gzip, the entities of its DOCTYPE replaced, parsed and indexed.
class SvgDocument {
 public:
  /// `name` is what errors call the file.
  /// @throws Error if the bytes are not XML, truncated, too deep, or have another root than <svg>; if they unpack to
  /// more than 64 MB, or entities expand to more.
  SvgDocument(std::string name, std::string bytes);

  const std::string& name() const { return name_; }
  pugi::xml_node root() const { return document_.document_element(); }
  /// The rules of all <style> elements.
  const CssStyleSheet& sheet() const { return sheet_; }

  /// The name of an element of SVG's namespace without its prefix; empty for elements of others. A file without
  /// namespaces is SVG as a whole.
  std::string_view SvgName(const pugi::xml_node& node) const;
  /// The first element with an id; null if there is none.
  pugi::xml_node ById(const std::string& id) const;
  /// The element that href or xlink:href of a node refers to within the file; null if there is none.
  pugi::xml_node Referenced(const pugi::xml_node& node) const;

  /// "file:line: <element>".
  std::string Where(const pugi::xml_node& node) const;

 private:
  std::string_view NamespaceOf(const pugi::xml_node& node) const;
  void Index();

  std::string name_, bytes_;
  pugi::xml_document document_;
  std::string root_namespace_;
  std::map<std::string, pugi::xml_node, std::less<>> by_id_;
  CssStyleSheet sheet_;
};

/// The value of href, or of xlink:href by any prefix; empty if there is neither.
std::string_view HrefOf(const pugi::xml_node& node);

}  // namespace daumier::render

#include "render/svg_document.h"

#include "core/error.h"
#include "render/gzip.h"
#include "render/svg_text.h"

#include <algorithm>

namespace daumier::render {
namespace {

constexpr size_t kMaxBytes = size_t{64} << 20;
constexpr int kMaxEntityDepth = 8;

using Entities = std::map<std::string, std::string, std::less<>>;

/// <!ENTITY name "value"> of the internal subset of a DOCTYPE; Illustrator writes namespaces and styles
/// that way.
Entities EntitiesOf(std::string_view bytes) {
  Entities entities;
  const size_t doctype = bytes.find("<!DOCTYPE");
  if (doctype == std::string_view::npos) return entities;
  const size_t open = bytes.find_first_of("[>", doctype);
  if (open == std::string_view::npos || bytes[open] == '>') return entities;
  std::string_view subset = bytes.substr(open, bytes.find("]>", open) - open);
  constexpr std::string_view kMark = "<!ENTITY";
  for (size_t at = subset.find(kMark); at != std::string_view::npos; at = subset.find(kMark)) {
    subset = Trimmed(subset.substr(at + kMark.size()));
    const std::string_view name = subset.substr(0, subset.find_first_of(kSvgSpace));
    subset = Trimmed(subset.substr(name.size()));
    if (subset.empty() || (subset[0] != '"' && subset[0] != '\'')) continue;
    const size_t end = subset.find(subset[0], 1);
    if (end == std::string_view::npos) break;
    entities.try_emplace(std::string(name), subset.substr(1, end - 1));
    subset.remove_prefix(end + 1);
  }
  return entities;
}

/// @throws Error if entities contain each other or expand to too much.
void AppendExpanded(std::string_view text, const Entities& entities, int depth, std::string& expanded) {
  DAUMIER_CHECK(depth < kMaxEntityDepth, "entities are nested more than {} deep", kMaxEntityDepth);
  while (!text.empty()) {
    const size_t mark = std::min(text.find('&'), text.size());
    expanded.append(text.substr(0, mark));
    DAUMIER_CHECK(expanded.size() <= kMaxBytes, "its entities expand to more than {} MB", kMaxBytes >> 20);
    text.remove_prefix(mark);
    if (text.empty()) return;
    const size_t end = text.find(';');
    const auto found = end == std::string_view::npos ? entities.end() : entities.find(text.substr(1, end - 1));
    if (found == entities.end()) {
      expanded += '&';
      text.remove_prefix(1);
    } else {
      AppendExpanded(found->second, entities, depth + 1, expanded);
      text.remove_prefix(end + 1);
    }
  }
}

std::string WithoutEntities(std::string bytes) {
  const Entities entities = EntitiesOf(bytes);
  if (entities.empty()) return bytes;
  const size_t end = bytes.find("]>");
  if (end == std::string::npos) return bytes;
  std::string expanded = bytes.substr(0, end);
  AppendExpanded(std::string_view(bytes).substr(end), entities, 0, expanded);
  return expanded;
}

}  // namespace

std::string_view HrefOf(const pugi::xml_node& node) {
  if (const auto href = node.attribute("href")) return Trimmed(href.value());
  for (const auto& attribute : node.attributes())
    if (std::string_view(attribute.name()).ends_with(":href")) return Trimmed(attribute.value());
  return {};
}

SvgDocument::SvgDocument(std::string name, std::string bytes) : name_(std::move(name)) {
  try {
    bytes_ = WithoutEntities(IsGzip(bytes) ? Gunzip(bytes, kMaxBytes) : std::move(bytes));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name_, error.what()));
  }
  const auto result = document_.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_auto);
  const auto line = [&](ptrdiff_t offset) {
    return 1 + std::count(bytes_.begin(), bytes_.begin() + std::clamp<ptrdiff_t>(offset, 0, std::ssize(bytes_)), '\n');
  };
  DAUMIER_CHECK(result, "{}:{}: not XML, or truncated: {}", name_, line(result.offset), result.description());
  DAUMIER_CHECK(LocalName(root()) == "svg", "{}: the outermost element is <{}>, expected <svg>", name_, root().name());
  root_namespace_ = NamespaceOf(root());
  Index();
}

std::string SvgDocument::Where(const pugi::xml_node& node) const {
  const auto offset = std::clamp<ptrdiff_t>(node.offset_debug(), 0, std::ssize(bytes_));
  return fmt::format("{}:{}: <{}>", name_, 1 + std::count(bytes_.begin(), bytes_.begin() + offset, '\n'), node.name());
}

std::string_view SvgDocument::NamespaceOf(const pugi::xml_node& node) const {
  const std::string_view name = node.name();
  const size_t colon = name.find(':');
  const std::string_view prefix = colon == std::string_view::npos ? "" : name.substr(0, colon);
  const std::string declaration = prefix.empty() ? "xmlns" : fmt::format("xmlns:{}", prefix);
  for (auto at = node; at; at = at.parent())
    if (const auto attribute = at.attribute(declaration.c_str())) return attribute.value();
  return prefix;
}

std::string_view SvgDocument::SvgName(const pugi::xml_node& node) const {
  const std::string_view space = NamespaceOf(node);
  return space == root_namespace_ || space == "http://www.w3.org/2000/svg" ? LocalName(node) : std::string_view();
}

pugi::xml_node SvgDocument::ById(const std::string& id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? pugi::xml_node() : found->second;
}

pugi::xml_node SvgDocument::Referenced(const pugi::xml_node& node) const {
  const std::string_view href = HrefOf(node);
  return href.starts_with('#') ? ById(std::string(href.substr(1))) : pugi::xml_node();
}

void SvgDocument::Index() {
  struct Level {
    pugi::xml_node node;
    int depth;
  };
  std::vector<Level> open{{root(), 0}};
  while (!open.empty()) {
    const auto [node, depth] = open.back();
    open.pop_back();
    DAUMIER_CHECK(depth < kMaxSvgDepth, "{}: elements are nested more than {} deep", Where(node), kMaxSvgDepth);
    if (const auto id = node.attribute("id")) by_id_.try_emplace(id.value(), node);
    const std::string_view type = node.attribute("type").value();
    if (SvgName(node) == "style" && (type.empty() || Lowered(type) == "text/css")) {
      std::string css;
      for (const auto& child : node.children()) css += child.value();
      const std::string_view media = node.attribute("media").value();
      sheet_.Add(media.empty() ? css : fmt::format("@media {} {{{}}}", media, css));
    }
    // The last child goes onto the stack first, so that elements come in the order of the file.
    for (auto child = node.last_child(); child; child = child.previous_sibling())
      if (child.type() == pugi::node_element) open.push_back({child, depth + 1});
  }
}

}  // namespace daumier::render

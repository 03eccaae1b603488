#include "render/xournal.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/gzip.h"
#include "render/number_list.h"

#include <pugixml.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace daumier::render {
namespace {

constexpr size_t kMostBytes = size_t{256} << 20;

/// One page, as far as it is read.
struct XournalPage {
  Drawing drawing;
  int num_texts = 0, num_pictures = 0, num_marked = 0;
};

/// "#rrggbbaa" of solid colours in the short form that compares: without "#", in small letters, the alpha cut off.
std::string ColourOf(const pugi::xml_node& node) {
  std::string colour = node.attribute("color").value();
  std::transform(colour.begin(), colour.end(), colour.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (colour == "white") return "ffffff";
  if (colour.starts_with("#")) return colour.substr(1, 6);
  return colour;
}

bool IsTransparent(const pugi::xml_node& node) {
  const std::string_view colour = node.attribute("color").value();
  return colour.starts_with("#") && colour.ends_with("00") && colour.size() == 9;
}

Stroke StrokeOf(const pugi::xml_node& node) {
  const std::vector<double> numbers = NumbersOf(node.text().get());
  DAUMIER_CHECK(numbers.size() % 2 == 0, "a <stroke> has {} numbers, expected pairs of x and y", numbers.size());
  Stroke stroke;
  for (size_t i = 0; i < numbers.size(); i += 2) stroke.points.push_back({float(numbers[i]), float(numbers[i + 1])});
  return stroke;
}

XournalPage PageOf(const pugi::xml_node& node) {
  XournalPage page;
  page.drawing.width = node.attribute("width").as_double();
  page.drawing.height = node.attribute("height").as_double();
  const pugi::xml_node background = node.child("background");
  const std::string paper = background.attribute("color") ? ColourOf(background) : "ffffff";
  for (const pugi::xml_node& layer : node.children("layer")) {
    for (const pugi::xml_node& element : layer.children()) {
      const std::string_view name = element.name(), tool = element.attribute("tool").value();
      page.num_texts += name == "text" || name == "teximage";
      page.num_pictures += name == "image";
      if (name != "stroke" || tool == "eraser" || ColourOf(element) == paper || IsTransparent(element)) continue;
      if (tool == "highlighter") {
        ++page.num_marked;
        continue;
      }
      Stroke stroke = StrokeOf(element);
      if (!stroke.points.empty()) page.drawing.strokes.push_back(std::move(stroke));
    }
  }
  return page;
}

/// The content of the document, whether it is compressed or not.
std::string Unpacked(std::string bytes) {
  return IsGzip(bytes) ? Gunzip(bytes, kMostBytes) : bytes;
}

void WarnOfWhatIsLeftOut(const std::string& name, const XournalPage& page) {
  std::string what;
  for (const auto& [count, kind] : {std::pair{page.num_texts, "texts"},
                                    {page.num_pictures, "pictures"},
                                    {page.num_marked, "strokes of the highlighter"}})
    if (count > 0) what += fmt::format("{}{} {}", what.empty() ? "" : ", ", count, kind);
  if (!what.empty()) log::Warn("{}: {} on the page are not read", name, what);
}

}  // namespace

bool IsXournal(std::string_view bytes) {
  constexpr size_t kHead = 1024;
  try {
    const std::string unpacked = IsGzip(bytes) ? Gunzip(bytes, kMostBytes) : std::string(bytes.substr(0, kHead));
    return unpacked.substr(0, kHead).find("<xournal") != std::string::npos;
  } catch (const Error&) {
    return false;
  }
}

Drawing ReadXournal(const std::filesystem::path& path) {
  const std::string name = path.string();
  try {
    const std::string text = Unpacked(ReadFile(path));
    pugi::xml_document document;
    const auto result = document.load_buffer(text.data(), text.size());
    DAUMIER_CHECK(result, "not XML, or truncated: {}", result.description());
    const pugi::xml_node root = document.document_element();
    DAUMIER_CHECK(std::string_view(root.name()) == "xournal", "the outermost element is <{}>, expected <xournal>",
                  root.name());
    int number = 0, num_with_ink = 0, taken = 0;
    XournalPage first;
    for (const pugi::xml_node& node : root.children("page")) {
      ++number;
      XournalPage page = PageOf(node);
      if (page.drawing.strokes.empty()) continue;
      if (++num_with_ink == 1) first = std::move(page), taken = number;
    }
    DAUMIER_CHECK(num_with_ink > 0,
                  "none of its {} pages has strokes of a pen (texts, pictures and a PDF behind a page are not read). "
                  "Export the page as PNG",
                  number);
    if (num_with_ink > 1)
      log::Warn("{}: {} of its {} pages have strokes; page {} is read", name, num_with_ink, number, taken);
    WarnOfWhatIsLeftOut(name, first);
    return std::move(first.drawing);
  } catch (const Error& error) {
    const std::string what = error.what();
    throw Error(what.starts_with(name) ? what : fmt::format("{}: {}", name, what));
  }
}

}  // namespace daumier::render

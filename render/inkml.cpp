#include "render/inkml.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/inkml_trace.h"
#include "render/svg_css.h"

#include <Eigen/Geometry>
#include <pugixml.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace daumier::render {
namespace {

/// Groups within groups; a deeper file is damaged or made to overflow the stack.
constexpr int kMostInkMlLevels = 200;
/// Elements that one trace refers to, and these in turn.
constexpr int kMostReferences = 1000;

std::string InkMlId(const pugi::xml_node& node) {
  return node.attribute(node.attribute("xml:id") ? "xml:id" : "id").value();
}

/// The id of "#id" or of "file#id".
std::string InkMlReference(const pugi::xml_node& node, const char* name) {
  const std::string_view value = node.attribute(name).value();
  return std::string(value.substr(value.find('#') == std::string_view::npos ? 0 : value.find('#') + 1));
}

enum class Brush { kPen, kHighlighter, kEraser };

/// What a trace inherits.
struct InkMlContext {
  InkMlChannels channels;
  Brush brush = Brush::kPen;
};

std::string SmallLetters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return text;
}

Brush BrushOf(const pugi::xml_node& brush) {
  constexpr double kHalfByte = 128.0;
  Brush found = SmallLetters(InkMlId(brush)).find("eraser") == std::string::npos ? Brush::kPen : Brush::kEraser;
  for (const pugi::xml_node& property : brush.children()) {
    const std::string name = SmallLetters(property.attribute("name").value()),
                      value = SmallLetters(property.attribute("value").value());
    if (LocalName(property) != "brushProperty") continue;
    if (name.find("eraser") != std::string::npos ? value != "false" && value != "0"
                                                 : value.find("eraser") != std::string::npos)
      return Brush::kEraser;
    if (name == "color" && (value == "#ffffff" || value == "#fff" || value == "white")) return Brush::kEraser;
    const bool masks = name == "rasterop" && value == "maskpen";
    const double transparency = name == "transparency" ? property.attribute("value").as_double() : 0.0;
    // A byte, or a share where a program writes one.
    const bool transparent = transparency > 1.0 ? transparency >= kHalfByte : transparency > 0.5;
    if (masks || transparent || value.find("highlighter") != std::string::npos) found = Brush::kHighlighter;
  }
  return found;
}

class InkMlReader {
 public:
  void Read(const pugi::xml_node& root) {
    Define(root, 0);
    Visit(root, {}, 0);
  }

  Drawing Result(const std::string& name) && {
    DAUMIER_CHECK(!drawing_.strokes.empty(), "the file holds no traces of a pen");
    for (Stroke& stroke : drawing_.strokes)
      for (auto& [x, y] : stroke.points) x -= float(box_.min().x()), y -= float(box_.min().y());
    drawing_.width = std::max(box_.sizes().x(), 1e-6), drawing_.height = std::max(box_.sizes().y(), 1e-6);
    if (num_marked_ > 0) log::Warn("{}: {} traces of a highlighter are not read", name, num_marked_);
    return std::move(drawing_);
  }

 private:
  /// Collects what has an id, wherever it is.
  void Define(const pugi::xml_node& node, int level) {
    DAUMIER_CHECK(level < kMostInkMlLevels, "elements lie within each other {} deep", level);
    for (const pugi::xml_node& child : node.children()) {
      if (const std::string id = InkMlId(child); !id.empty()) by_id_.emplace(id, child);
      Define(child, level + 1);
    }
  }

  InkMlChannels ChannelsOf(const pugi::xml_node& format) const {
    InkMlChannels channels{.x = -1, .y = -1};
    int index = 0;
    const auto take = [&](const pugi::xml_node& channel) {
      const std::string_view name = channel.attribute("name").value();
      const double sign = std::string_view(channel.attribute("orientation").value()) == "-ve" ? -1.0 : 1.0;
      if (name == "X") channels.x = index, channels.x_sign = sign;
      if (name == "Y") channels.y = index, channels.y_sign = sign;
      ++index;
    };
    for (const pugi::xml_node& child : format.children())
      if (LocalName(child) == "channel") take(child);
    for (const pugi::xml_node& child : format.children())
      if (LocalName(child) == "intermittentChannels")
        for (const pugi::xml_node& channel : child.children()) take(channel);
    DAUMIER_CHECK(channels.x >= 0 && channels.y >= 0, "a <traceFormat> has no channel X or no channel Y");
    return channels;
  }

  InkMlContext ContextOf(const pugi::xml_node& node, const InkMlContext& context) const {
    int num_steps = 0;
    return ContextOf(node, context, num_steps);
  }

  /// The context with what an element states or refers to; `num_steps` bounds references in a circle.
  InkMlContext ContextOf(const pugi::xml_node& node, InkMlContext context, int& num_steps) const {
    DAUMIER_CHECK(++num_steps < kMostReferences, "references to contexts lead in a circle");
    const auto follow = [&](const char* name) {
      const auto found = by_id_.find(InkMlReference(node, name));
      if (found != by_id_.end()) context = ContextOf(found->second, context, num_steps);
    };
    const std::string_view name = LocalName(node);
    if (name == "traceFormat") context.channels = ChannelsOf(node);
    if (name == "brush") context.brush = BrushOf(node);
    for (const char* reference : {"contextRef", "inkSourceRef", "traceFormatRef", "brushRef"}) follow(reference);
    if (name == "context" || name == "inkSource") {
      for (const pugi::xml_node& child : node.children()) context = ContextOf(child, context, num_steps);
    }
    return context;
  }

  void Visit(const pugi::xml_node& node, InkMlContext context, int level) {
    DAUMIER_CHECK(level < kMostInkMlLevels, "groups of traces lie within each other {} deep", level);
    for (const pugi::xml_node& child : node.children()) {
      const std::string_view name = LocalName(child);
      // Of a stream: from here on.
      if (name == "context" || name == "brush" || name == "traceFormat") context = ContextOf(child, context);
      if (name == "traceGroup") Visit(child, ContextOf(child, context), level + 1);
      if (name == "trace") AddTrace(child, ContextOf(child, context));
    }
  }

  void AddTrace(const pugi::xml_node& node, const InkMlContext& context) {
    if (std::string_view(node.attribute("type").value()) == "penUp" || context.brush == Brush::kEraser) return;
    if (context.brush == Brush::kHighlighter) {
      ++num_marked_;
      return;
    }
    Stroke stroke;
    for (const Eigen::Vector2d& point : ParseInkMlTrace(node.text().get(), context.channels)) {
      stroke.points.push_back({float(point.x()), float(point.y())});
      box_.extend(point);
    }
    if (!stroke.points.empty()) drawing_.strokes.push_back(std::move(stroke));
  }

  std::map<std::string, pugi::xml_node> by_id_;
  Drawing drawing_;
  Eigen::AlignedBox2d box_;
  int num_marked_ = 0;
};

}  // namespace

bool IsInkMl(std::string_view bytes) {
  constexpr size_t kHead = 2048;
  const std::string_view head = bytes.substr(0, kHead);
  const size_t begin = head.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (begin == std::string_view::npos || head[begin] != '<') return false;
  return head.find("<ink>") != std::string_view::npos || head.find("<ink ") != std::string_view::npos ||
         head.find(":ink ") != std::string_view::npos || head.find("/InkML") != std::string_view::npos;
}

Drawing ReadInkMl(const std::filesystem::path& path) {
  const std::string name = path.string(), bytes = ReadFile(path);
  try {
    pugi::xml_document document;
    const auto result = document.load_buffer(bytes.data(), bytes.size());
    DAUMIER_CHECK(result, "not XML, or truncated: {}", result.description());
    const pugi::xml_node root = document.document_element();
    DAUMIER_CHECK(LocalName(root) == "ink", "the outermost element is <{}>, expected <ink>", root.name());
    InkMlReader reader;
    reader.Read(root);
    return std::move(reader).Result(name);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace daumier::render

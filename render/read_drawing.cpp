#include "render/read_drawing.h"

#include "core/error.h"
#include "core/files.h"
#include "render/foreign_formats.h"
#include "render/gzip.h"
#include "render/inkml.h"
#include "render/line_drawing.h"
#include "render/quickdraw.h"
#include "render/svg.h"
#include "render/xournal.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace daumier::render {
namespace {

enum class DrawingFormat { kSvg, kQuickDraw, kXournal, kInkMl, kPicture };

std::string SuffixOf(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

/// By what the file holds, and by its suffix where that does not show it (a damaged file).
DrawingFormat FormatOf(std::string_view bytes, const std::string& suffix) {
  constexpr size_t kHead = 4096;
  const std::string_view head = bytes.substr(0, kHead);
  const size_t begin = head.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  const char first = begin == std::string_view::npos ? '\0' : head[begin];
  if (IsXournal(bytes)) return DrawingFormat::kXournal;
  if (IsGzip(bytes)) return DrawingFormat::kSvg;
  if (first == '<' && (head.find("<svg") != std::string_view::npos || head.find(":svg") != std::string_view::npos))
    return DrawingFormat::kSvg;
  if (IsInkMl(bytes)) return DrawingFormat::kInkMl;
  if (first == '{' && head.find("\"drawing\"") != std::string_view::npos) return DrawingFormat::kQuickDraw;

  if (suffix == ".svg" || suffix == ".svgz") return DrawingFormat::kSvg;
  if (suffix == ".ndjson") return DrawingFormat::kQuickDraw;
  if (suffix == ".xopp" || suffix == ".xoj") return DrawingFormat::kXournal;
  if (suffix == ".inkml") return DrawingFormat::kInkMl;
  return DrawingFormat::kPicture;
}

Drawing ReadPicture(const std::filesystem::path& path) {
  const Image picture = ReadImage(path);
  try {
    return TraceLineDrawing(picture).drawing;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace

std::vector<Drawing> ReadDrawings(const std::filesystem::path& path, const std::vector<std::string>& kind_names) {
  const std::string bytes = ReadFile(path);
  DAUMIER_CHECK(!bytes.empty(), "{}: the file is empty (expected a drawing)", path.string());
  RefuseForeignFormat(bytes, path.string());
  switch (FormatOf(bytes, SuffixOf(path))) {
    case DrawingFormat::kSvg:
      return {ReadSvg(path, kind_names)};
    case DrawingFormat::kQuickDraw:
      return ReadQuickDraw(path);
    case DrawingFormat::kXournal:
      return {ReadXournal(path)};
    case DrawingFormat::kInkMl:
      return {ReadInkMl(path)};
    case DrawingFormat::kPicture:
      break;
  }
  return {ReadPicture(path)};
}

}  // namespace daumier::render

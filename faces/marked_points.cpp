#include "faces/marked_points.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/marked_documents.h"
#include "faces/marked_forms.h"
#include "faces/marked_rows.h"

#include <algorithm>

namespace daumier::faces {
namespace {

constexpr uintmax_t kLargestFile = uintmax_t(64) << 20;

/// An object of JSON, rather than the brace of an iBUG file.
bool IsJsonObject(std::string_view text) {
  if (!text.starts_with('{')) return false;
  const size_t next = text.find_first_not_of(" \t\r\n", 1);
  return next != std::string_view::npos && (text[next] == '"' || text[next] == '}');
}

bool IsPly(std::string_view text) {
  return text.starts_with("ply\n") || text.starts_with("ply\r");
}

/// `content`: `text` from its first sign on.
MarkedPoints ParseContent(std::string_view content, std::string_view text, const std::filesystem::path& path) {
  if (IsPly(content)) return ParseMarkedPly(content, path);
  if (content.starts_with('<')) return ParseMarkedXml(content, path);
  if (const auto rows = RowsOfPrintedArray(content)) return ParseMarkedRows(*rows, path);
  if (content.starts_with('[') || IsJsonObject(content)) return ParseMarkedJson(content, path);
  if (const auto rows = RowsOfTps(text, path.string())) return ParseMarkedRows(*rows, path);
  return ParseMarkedRows(text, path);
}

}  // namespace

MarkedPoints ReadMarkedPoints(const std::filesystem::path& path, ZeroPoints zero) {
  std::error_code unreadable;
  const uintmax_t size = std::filesystem::file_size(path, unreadable);
  DAUMIER_CHECK(unreadable || size <= kLargestFile, "{}: {} MB, expected points in at most {} MB", path.string(),
                size >> 20, kLargestFile >> 20);
  const std::string bytes = ReadFile(path);
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string_view content = text;
  content.remove_prefix(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
  MarkedPoints marked = ParseContent(content, text, path);
  marked.file = path;
  for (auto& point : marked.points) {
    if (point && zero == ZeroPoints::kAbsent && point->isZero(0)) point.reset();
  }
  DAUMIER_CHECK(!marked.points.empty(), "{}: holds no point", path.string());
  DAUMIER_CHECK(std::any_of(marked.points.begin(), marked.points.end(), [](const auto& point) { return point; }),
                "{}: holds no point that is there: all {} are absent ({}). Expected points, as x y z or vertices",
                path.string(), marked.points.size(),
                zero == ZeroPoints::kAbsent ? "zeros, nan, null or empty cells" : "nan, null or empty cells");
  return marked;
}

}  // namespace daumier::faces

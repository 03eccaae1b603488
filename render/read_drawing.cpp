#include "render/read_drawing.h"

#include "core/error.h"
#include "core/files.h"
#include "render/draw.h"
#include "render/faces_on_sheet.h"
#include "render/foreign_formats.h"
#include "render/gzip.h"
#include "render/inkml.h"
#include "render/line_drawing.h"
#include "render/quickdraw.h"
#include "render/svg.h"
#include "render/xournal.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

namespace daumier::render {
namespace {

using namespace std::string_view_literals;

enum class DrawingFormat { kSvg, kQuickDraw, kXournal, kInkMl, kPicture };

std::string SuffixOf(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

bool IsPicture(std::string_view bytes) {
  for (const std::string_view signature : {"\x89PNG"sv, "\xFF\xD8\xFF"sv, "RIFF"sv, "BM"sv, "II*\0"sv, "MM\0*"sv})
    if (bytes.starts_with(signature)) return true;
  return false;
}

/// By what the file holds, and by its suffix where that does not show it (a damaged file).
DrawingFormat DrawingFormatOf(std::string_view bytes, const std::string& suffix) {
  constexpr size_t kHead = 4096;
  const std::string_view head = bytes.substr(0, kHead);
  const size_t begin = head.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  const char first = begin == std::string_view::npos ? '\0' : head[begin];
  if (IsPicture(bytes)) return DrawingFormat::kPicture;
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

/// Some pixels of a picture: [left, right) x [top, bottom).
struct PixelBox {
  int left, top, right, bottom;
};

/// The box of the strokes with a margin that is narrower than any gap between faces.
PixelBox BoxAround(const Drawing& face, const Image& picture) {
  constexpr double kMargin = 0.05;
  Eigen::AlignedBox2d box;
  for (const Stroke& stroke : face.strokes)
    for (const auto& [x, y] : stroke.points) box.extend(Eigen::Vector2d(x, y));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kMargin * box.sizes().maxCoeff());
  const Eigen::Vector2d size(picture.width, picture.height);
  const Eigen::Vector2d low = (box.min() - margin).cwiseMax(0.0), high = (box.max() + margin).cwiseMin(size);
  return {int(std::floor(low.x())), int(std::floor(low.y())), int(std::ceil(high.x())), int(std::ceil(high.y()))};
}

/// The strokes of a picture. Where it shows several faces each is traced by itself, as finely as one alone; of a sheet
/// that was photographed they are traced together, since their places are those on the rectified sheet.
Drawing TracePicture(const Image& picture) {
  Drawing traced = TraceLineDrawing(picture).drawing;
  const std::vector<Drawing> faces = FacesOnSheet(traced);
  if (faces.size() == 1 || traced.picture_from_sheet) return traced;
  traced.strokes.clear();
  for (const Drawing& face : faces) {
    const PixelBox box = BoxAround(face, picture);
    Image crop(box.bottom - box.top, box.right - box.left, picture.channels);
    Paste(crop, picture, -box.top, -box.left);
    for (Stroke& stroke : TraceLineDrawing(crop).drawing.strokes) {
      for (auto& [x, y] : stroke.points) x += float(box.left), y += float(box.top);
      traced.strokes.push_back(std::move(stroke));
    }
  }
  return traced;
}

Drawing ReadPicture(const std::filesystem::path& path) {
  const Image picture = ReadImage(path);
  try {
    return TracePicture(picture);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace

std::vector<Drawing> ReadDrawings(const std::filesystem::path& path, const std::vector<std::string>& kind_names) {
  const std::string bytes = ReadFile(path);
  DAUMIER_CHECK(!bytes.empty(), "{}: the file is empty (expected a drawing)", path.string());
  RefuseForeignFormat(bytes, path.string());
  switch (DrawingFormatOf(bytes, SuffixOf(path))) {
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

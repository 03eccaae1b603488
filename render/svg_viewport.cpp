#include "render/svg_viewport.h"

#include "core/error.h"
#include "render/svg_path.h"
#include "render/svg_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

double SideAlong(SvgAxis axis, const Vector2d& size) {
  switch (axis) {
    case SvgAxis::kX:
      return size.x();
    case SvgAxis::kY:
      return size.y();
    default:
      return size.norm() / std::sqrt(2.0);
  }
}

/// Share of the free space before the content for the words Min, Mid and Max; nothing for any other.
std::optional<double> AlignmentOf(std::string_view word) {
  if (word == "Min") return 0.0;
  if (word == "Mid") return 0.5;
  if (word == "Max") return 1.0;
  return std::nullopt;
}

}  // namespace

double ParseSvgLength(std::string_view text, SvgAxis axis, const SvgUnits& units) {
  text = Trimmed(text);
  SvgNumbers numbers(text);
  const double value = numbers.Number();
  const std::string unit = Lowered(Trimmed(text.substr(numbers.position())));
  for (const auto& [name, pixels] : {std::pair{"", 1.0},
                                     {"px", 1.0},
                                     {"pt", 96.0 / 72.0},
                                     {"pc", 16.0},
                                     {"mm", 96.0 / 25.4},
                                     {"cm", 96.0 / 2.54},
                                     {"q", 96.0 / 101.6},
                                     {"in", 96.0},
                                     {"em", units.font_size},
                                     {"rem", SvgUnits{}.font_size},
                                     {"ex", 0.5 * units.font_size},
                                     {"ch", 0.5 * units.font_size}}) {
    if (unit == name) return value * pixels;
  }
  if (unit == "%") {
    DAUMIER_CHECK(units.viewport,
                  "'{}' refers to a size that the file does not have. Add width and height, or a viewBox", text);
    return 0.01 * value * SideAlong(axis, *units.viewport);
  }
  if (unit == "vw" || unit == "vh" || unit == "vmin" || unit == "vmax") {
    DAUMIER_CHECK(units.sheet, "'{}' refers to a size that the file does not have. Add width and height, or a viewBox",
                  text);
    return 0.01 * value *
           (unit == "vw"     ? units.sheet->x()
            : unit == "vh"   ? units.sheet->y()
            : unit == "vmin" ? units.sheet->minCoeff()
                             : units.sheet->maxCoeff());
  }
  throw Error(fmt::format("'{}' is not a length in px, pt, pc, mm, cm, in, em, ex or %", text));
}

std::optional<AlignedBox2d> ParseSvgViewBox(std::string_view text) {
  if (Trimmed(text).empty() || Trimmed(text) == "none") return std::nullopt;
  SvgNumbers numbers(text);
  Eigen::Vector4d box;
  for (double& value : box) {
    numbers.SkipSeparators();
    value = numbers.Number();
  }
  DAUMIER_CHECK(box[2] > 0 && box[3] > 0, "viewBox is '{}', expected a positive size", text);
  return AlignedBox2d(box.head<2>(), box.head<2>() + box.tail<2>());
}

Eigen::Affine2d PlaceSvgViewBox(const AlignedBox2d& view_box, const AlignedBox2d& viewport,
                                std::string_view preserve_aspect_ratio) {
  std::vector<std::string_view> words;
  ForEachWord(preserve_aspect_ratio, [&](std::string_view word) {
    if (word != "defer") words.push_back(word);
  });
  Vector2d scale = viewport.sizes().cwiseQuotient(view_box.sizes()), alignment(0.5, 0.5);
  if (words.empty() || words[0] != "none") {
    const bool slice = words.size() > 1 && words[1] == "slice";
    scale.setConstant(slice ? scale.maxCoeff() : scale.minCoeff());
    if (!words.empty()) {
      const std::string_view word = words[0];
      const bool has_form = word.size() == 8 && word[0] == 'x' && word[4] == 'Y';
      const auto x = AlignmentOf(has_form ? word.substr(1, 3) : ""), y = AlignmentOf(has_form ? word.substr(5) : "");
      DAUMIER_CHECK(x && y, "preserveAspectRatio is '{}', expected for example 'xMidYMid meet' or 'none'",
                    preserve_aspect_ratio);
      alignment = Vector2d(*x, *y);
    }
  }
  const Vector2d margin = alignment.cwiseProduct(viewport.sizes() - scale.cwiseProduct(view_box.sizes()));
  Eigen::Affine2d viewport_from_user = Eigen::Affine2d::Identity();
  viewport_from_user.linear() = scale.asDiagonal();
  viewport_from_user.translation() = viewport.min() + margin - scale.cwiseProduct(view_box.min());
  return viewport_from_user;
}

}  // namespace daumier::render

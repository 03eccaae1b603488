#pragma once
#include "render/svg_scene.h"

#include <Eigen/Geometry>

#include <memory>
#include <vector>

namespace daumier::render {

/// A picture of a scene as it is painted, shape by shape: at each pixel the colour of the areas, and the last shape
/// that hides what lies below. Strokes leave no colour, so that lines that cross do not hide each other.
class SvgCanvas {
 public:
  /// `box` is what it shows, in pixels of the sheet; `paper` the colour before the first shape; `side` the pixels of
  /// its longer side.
  SvgCanvas(const Eigen::AlignedBox2d& box, const SvgColor& paper, double side);
  ~SvgCanvas();
  SvgCanvas(const SvgCanvas&) = delete;
  SvgCanvas& operator=(const SvgCanvas&) = delete;

  /// As many pixels a side as the areas of these shapes allow.
  static double SideFor(const Eigen::AlignedBox2d& box, const std::vector<SvgShape>& shapes);

  /// Length of a pixel's side in pixels of the sheet.
  double step() const { return step_; }

  /// The colour of the areas at a point of the sheet; that of the paper outside the box.
  Eigen::Vector3d ColorAt(const Eigen::Vector2d& point) const;
  /// Whether a shape after the one of this index hides a point.
  bool IsHidden(const Eigen::Vector2d& point, int shape) const;

  /// Paints the area of a shape; one that is more opaque than not hides what lies below.
  void PaintArea(const SvgShape& shape, int index);
  /// Marks the pixels of a shape's stroke whose colour differs by less than `contrast` from the area below as hiding
  /// what was drawn there: it erases.
  void Erase(const SvgShape& shape, int index, double contrast);

 private:
  struct Pixels;

  Eigen::Vector3d paper_;
  Eigen::Vector2d corner_;
  double step_ = 1.0;
  std::unique_ptr<Pixels> pixels_;
};

/// Difference of a channel from what lies below, in [0, 1], from which paint is ink: more than paper's tints have.
constexpr double kInkContrast = 0.12;

/// Largest difference of a channel, in [0, 1], that paint makes on what lies below it.
double PaintContrast(const SvgColor& paint, const Eigen::Vector3d& below);

}  // namespace daumier::render

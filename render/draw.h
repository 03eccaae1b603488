#pragma once
#include "render/image.h"

#include <string_view>

/// What sheets and reports are put together from: text, rectangles, pasting, scaling.
namespace daumier::render {

enum class TextAlign { kLeft, kCentre, kRight };

struct TextStyle {
  double height = 14.0;  ///< Pixels from one line of text to the next; capitals are about half as high.
  Rgb colour = {45, 45, 48};
  TextAlign align = TextAlign::kLeft;
  bool bold = false;
};

/// Width in pixels that DrawText needs for a line of text.
double TextWidth(std::string_view text, const TextStyle& style = {});

/// The style whose height is as much smaller as the text must be to fit into a width; unchanged where it fits.
TextStyle FittedTextStyle(std::string_view text, TextStyle style, double max_width);

/// One line of text, antialiased, vertically centred in [top, top + style.height); x is its left end, centre or right
/// end. What lies outside the image is cut off. The font has ASCII only: any other character is drawn as '?'.
void DrawText(Image& image, std::string_view text, double x, double top, const TextStyle& style = {});

/// Fills rows [top, top + height), columns [left, left + width), cut at the border.
void FillRectangle(Image& image, int top, int left, int height, int width, const Rgb& colour);

/// Copies `source` so that its pixel (0, 0) comes to (top, left), cut at the border. Grey is copied into RGB as R = G =
/// B.
/// @throws Error if an RGB image is pasted into a grey one.
void Paste(Image& image, const Image& source, int top, int left);

/// The same picture with three channels.
Image ToRgb(const Image& image);

/// Scaled to height x width: the mean over each pixel's area when made smaller, bilinear when made larger.
/// @throws Error if a size is not positive or the image is empty.
Image Resize(const Image& image, int height, int width);

}  // namespace daumier::render

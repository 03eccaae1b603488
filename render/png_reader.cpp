#include "render/png_reader.h"

#include "core/error.h"
#include "render/png.h"

#include <png.h>

#include <bit>
#include <cstring>
#include <vector>

namespace daumier::render {
namespace {

struct PngInput {
  std::string_view rest;
  std::string failure;
};

void TakePngBytes(png_structp png, png_bytep data, png_size_t count) {
  std::string_view& rest = static_cast<PngInput*>(png_get_io_ptr(png))->rest;
  if (count > rest.size()) png_error(png, "bytes are missing at its end");
  std::memcpy(data, rest.data(), count);
  rest.remove_prefix(count);
}

void IgnorePngWarning(png_structp, png_const_charp) {}

[[noreturn]] void LeavePngReader(png_structp png, png_const_charp message) {
  static_cast<PngInput*>(png_get_error_ptr(png))->failure = message;
  png_longjmp(png, 1);
}

/// False if libpng fails. Holds no object that a jump out of libpng would not destroy.
bool ReadPng(png_structp png, png_infop info, PngInput& input, cv::Mat& pixels, std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, &input, TakePngBytes);
  png_set_user_limits(png, kMaxPngSide, kMaxPngSide);
  png_read_info(png, info);
  png_set_expand(png);
  if (png_get_valid(png, info, PNG_INFO_tRNS) != 0 || png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY_ALPHA)
    png_set_gray_to_rgb(png);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const int depth = png_get_bit_depth(png, info) == 16 ? CV_16U : CV_8U;
  pixels.create(int(png_get_image_height(png, info)), int(png_get_image_width(png, info)),
                CV_MAKETYPE(depth, png_get_channels(png, info)));
  rows.resize(size_t(pixels.rows));
  for (int row = 0; row < pixels.rows; ++row) rows[size_t(row)] = pixels.ptr(row);
  png_read_image(png, rows.data());
  return true;
}

}  // namespace

cv::Mat DecodePng(std::string_view bytes, std::string_view name) {
  CheckPngHeader(bytes, name);
  const std::string chunks = PixelChunksOfPng(bytes, name);
  PngInput input{.rest = chunks, .failure = {}};
  cv::Mat pixels;
  std::vector<png_bytep> rows;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input, LeavePngReader, IgnorePngWarning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool is_read = info != nullptr && ReadPng(png, info, input, pixels, rows);
  png_destroy_read_struct(&png, &info, nullptr);
  DAUMIER_CHECK(is_read, "{}: a PNG that libpng cannot read: {}. Export it again", name, input.failure);
  return pixels;
}

}  // namespace daumier::render

#include "render/png_writer.h"

#include "core/error.h"

#include <png.h>
#include <zlib.h>

#include <vector>

namespace daumier::render {
namespace {

constexpr int kLevel = 1;

struct Output {
  std::string bytes;
  std::string failure;
};

void Append(png_structp png, png_bytep data, png_size_t count) {
  static_cast<Output*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), count);
}

void Ignore(png_structp, png_const_charp) {}

[[noreturn]] void Fail(png_structp png, png_const_charp message) {
  static_cast<Output*>(png_get_error_ptr(png))->failure = message;
  png_longjmp(png, 1);
}

/// False if libpng fails. Holds no object that a jump out of libpng would not destroy.
bool Write(png_structp png, png_infop info, const Image& image, png_bytepp rows, Output& output) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &output, Append, nullptr);
  png_set_compression_level(png, kLevel);
  png_set_compression_strategy(png, Z_RLE);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
  png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), 8,
               image.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string EncodePng(const Image& image) {
  Output output;
  std::vector<png_bytep> rows(size_t(image.height));
  for (int row = 0; row < image.height; ++row)
    rows[size_t(row)] = const_cast<png_bytep>(image.pixels.data() + size_t(row) * image.width * image.channels);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, Fail, Ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool written = info != nullptr && Write(png, info, image, rows.data(), output);
  png_destroy_write_struct(&png, &info);
  DAUMIER_CHECK(written, "libpng cannot encode a picture: {}", output.failure);
  return std::move(output.bytes);
}

}  // namespace daumier::render

#include "render/jpeg_codec.h"

#include "core/error.h"

#include <cstdio>  // jpeglib.h needs its types.

#include <jpeglib.h>

#include <jerror.h>

#include <csetjmp>
#include <cstdlib>
#include <vector>

namespace daumier::render {
namespace {

constexpr uint64_t kMaxJpegPixels = uint64_t{1} << 30;

/// libjpeg's errors and warnings. The first member is what libjpeg is given, so that a pointer to it is one to the whole.
struct JpegMessages {
  jpeg_error_mgr base{};
  std::jmp_buf back{};
  char first[JMSG_LENGTH_MAX] = "";
  bool lacks_data = false;

  void Keep(j_common_ptr codec) {
    if (first[0] == '\0') base.format_message(codec, first);
  }
};

JpegMessages& MessagesOf(j_common_ptr codec) {
  return *reinterpret_cast<JpegMessages*>(codec->err);
}

[[noreturn]] void LeaveJpegCodec(j_common_ptr codec) {
  JpegMessages& messages = MessagesOf(codec);
  messages.first[0] = '\0';
  messages.Keep(codec);
  std::longjmp(messages.back, 1);
}

void HearJpegMessage(j_common_ptr codec, int level) {
  if (level >= 0) return;  // A trace.
  JpegMessages& messages = MessagesOf(codec);
  if (codec->err->msg_code == JWRN_HIT_MARKER) messages.lacks_data = true;
  if (codec->err->msg_code != JWRN_JPEG_EOF) messages.Keep(codec);
}

jpeg_error_mgr* Listening(JpegMessages& messages) {
  jpeg_std_error(&messages.base);
  messages.base.error_exit = LeaveJpegCodec;
  messages.base.emit_message = HearJpegMessage;
  return &messages.base;
}

/// Whether every coefficient of a progressive picture came to its last bit. Known once it is decoded.
bool HasAllScans(const jpeg_decompress_struct& reader) {
  if (!reader.progressive_mode || reader.coef_bits == nullptr) return true;
  for (int component = 0; component < reader.num_components; ++component)
    for (int i = 0; i < DCTSIZE2; ++i)
      if (reader.coef_bits[component][i] != 0) return false;
  return true;
}

/// False if libjpeg fails. Holds no object that a jump out of libjpeg would not destroy.
bool ReadJpeg(jpeg_decompress_struct& reader, JpegMessages& messages, std::string_view bytes, cv::Mat& pixels,
              bool& has_all_scans) {
  if (setjmp(messages.back)) return false;
  jpeg_create_decompress(&reader);
  jpeg_mem_src(&reader, reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&reader, TRUE);
  if (uint64_t{reader.image_width} * reader.image_height > kMaxJpegPixels)
    ERREXIT1(&reader, JERR_IMAGE_TOO_BIG, JPEG_MAX_DIMENSION);
  if (reader.num_components == 4)
    reader.out_color_space = JCS_CMYK;
  else if (reader.out_color_space != JCS_GRAYSCALE)
    reader.out_color_space = JCS_RGB;
  jpeg_start_decompress(&reader);
  pixels.create(int(reader.output_height), int(reader.output_width), CV_8UC(reader.output_components));
  while (reader.output_scanline < reader.output_height) {
    JSAMPROW row = pixels.ptr(int(reader.output_scanline));
    jpeg_read_scanlines(&reader, &row, 1);
  }
  has_all_scans = HasAllScans(reader);
  jpeg_finish_decompress(&reader);
  return true;
}

/// Each channel is what a filter of its ink, and one of black, let through of 255.
cv::Mat RgbOfCmyk(const cv::Mat& cmyk, bool inverted) {
  cv::Mat rgb(cmyk.size(), CV_8UC3);
  for (int row = 0; row < cmyk.rows; ++row) {
    for (int column = 0; column < cmyk.cols; ++column) {
      const auto& from = cmyk.at<cv::Vec4b>(row, column);
      auto& to = rgb.at<cv::Vec3b>(row, column);
      const int black = inverted ? from[3] : 255 - from[3];
      for (int channel = 0; channel < 3; ++channel) {
        const int ink = inverted ? from[channel] : 255 - from[channel];
        to[channel] = uint8_t((ink * black + 127) / 255);
      }
    }
  }
  return rgb;
}

/// False if libjpeg fails. Holds no object that a jump out of libjpeg would not destroy.
bool WriteJpeg(jpeg_compress_struct& writer, JpegMessages& messages, const Image& image, int quality,
               unsigned char*& bytes, unsigned long& size) {
  if (setjmp(messages.back)) return false;
  jpeg_create_compress(&writer);
  jpeg_mem_dest(&writer, &bytes, &size);
  writer.image_width = JDIMENSION(image.width);
  writer.image_height = JDIMENSION(image.height);
  writer.input_components = image.channels;
  writer.in_color_space = image.channels == 3 ? JCS_RGB : JCS_GRAYSCALE;
  jpeg_set_defaults(&writer);
  jpeg_set_quality(&writer, quality, TRUE);
  jpeg_start_compress(&writer, TRUE);
  while (writer.next_scanline < writer.image_height) {
    auto* row = const_cast<JSAMPLE*>(image.pixels.data() + size_t(writer.next_scanline) * image.width * image.channels);
    jpeg_write_scanlines(&writer, &row, 1);
  }
  jpeg_finish_compress(&writer);
  return true;
}

}  // namespace

DecodedJpeg DecodeJpeg(std::string_view bytes) {
  DecodedJpeg decoded;
  JpegMessages messages;
  jpeg_decompress_struct reader{};
  reader.err = Listening(messages);
  bool has_all_scans = false;
  const bool is_read = ReadJpeg(reader, messages, bytes, decoded.pixels, has_all_scans);
  const bool inverted = reader.saw_Adobe_marker != FALSE;
  jpeg_destroy_decompress(&reader);
  decoded.complaint = messages.first;
  decoded.is_whole = is_read && has_all_scans && !messages.lacks_data;
  if (!is_read) decoded.pixels.release();
  if (decoded.pixels.channels() == 4) decoded.pixels = RgbOfCmyk(decoded.pixels, inverted);
  return decoded;
}

std::string EncodeJpeg(const Image& image, int quality) {
  JpegMessages messages;
  jpeg_compress_struct writer{};
  writer.err = Listening(messages);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool is_written = WriteJpeg(writer, messages, image, quality, bytes, size);
  jpeg_destroy_compress(&writer);
  std::string encoded(reinterpret_cast<const char*>(bytes), bytes == nullptr ? 0 : size);
  std::free(bytes);
  DAUMIER_CHECK(is_written, "libjpeg cannot encode a picture: {}", messages.first);
  return encoded;
}

}  // namespace daumier::render

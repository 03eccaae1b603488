#pragma once
#include <cstddef>
#include <string_view>

namespace daumier::render {

bool IsJpeg(std::string_view bytes);

/// The first picture of a JPEG file [ITU T.81, annex B]. Files of telephones hold more after it: a movie (motion
/// photos), further pictures (MPO), padding.
struct JpegExtent {
  std::string_view picture;  ///< From the start marker to the end marker, or as far as the file reaches.
  std::string_view exif;     ///< Content of the first Exif segment: a TIFF header and its directory; empty if none.
  bool has_scan = false;     ///< Compressed data begin.
  bool has_end = false;      ///< The end marker is there.
};

/// Walks the segments by their lengths and the compressed data by its markers. Any bytes are accepted.
JpegExtent FirstJpeg(std::string_view bytes);

}  // namespace daumier::render

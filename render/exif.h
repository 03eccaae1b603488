#pragma once
#include <string_view>

namespace daumier::render {

/// How the rows and columns of a picture are to be shown [Exif 2.32, tag 274], from 1 (as they are) to 8, of the Exif
/// data of a JPEG, a PNG (chunk eXIf) or a WebP (chunk EXIF). 1 where there are none, and where they are damaged.
int ExifOrientation(std::string_view bytes);

}  // namespace daumier::render

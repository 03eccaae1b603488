#include "render/gzip.h"

#include "core/error.h"

#include <zlib.h>
#include <algorithm>
#include <array>
#include <limits>

namespace daumier::render {
namespace {

/// zlib's state, released on every way out.
class InflateStream {
 public:
  InflateStream() {
    // 16: a gzip header is required.
    DAUMIER_CHECK(inflateInit2(&stream_, 16 + MAX_WBITS) == Z_OK, "zlib cannot be initialised");
  }
  ~InflateStream() { inflateEnd(&stream_); }
  InflateStream(const InflateStream&) = delete;
  InflateStream& operator=(const InflateStream&) = delete;
  z_stream& operator*() { return stream_; }

 private:
  z_stream stream_{};
};

}  // namespace

bool IsGzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

std::string Gunzip(std::string_view bytes, size_t max_bytes) {
  std::string content;
  while (IsGzip(bytes)) {
    InflateStream owner;
    z_stream& stream = *owner;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    const size_t given = std::min<size_t>(bytes.size(), std::numeric_limits<uInt>::max());
    stream.avail_in = static_cast<uInt>(given);
    std::array<char, 65536> block;
    int status = Z_OK;
    while (status != Z_STREAM_END) {
      stream.next_out = reinterpret_cast<Bytef*>(block.data());
      stream.avail_out = static_cast<uInt>(block.size());
      status = inflate(&stream, Z_NO_FLUSH);
      const size_t written = block.size() - stream.avail_out;
      DAUMIER_CHECK(status == Z_OK || status == Z_STREAM_END, "the gzip data are damaged or truncated");
      DAUMIER_CHECK(content.size() + written <= max_bytes, "the gzip data hold more than {} MB", max_bytes >> 20);
      content.append(block.data(), written);
    }
    bytes.remove_prefix(given - stream.avail_in);
  }
  return content;
}

}  // namespace daumier::render

#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace daumier::render {

/// Whether bytes begin as a gzip member: 1f 8b.
bool IsGzip(std::string_view bytes);

/// The content of all gzip members, one after the other; what follows them is ignored, as gzip does.
/// @throws Error if the data are damaged or truncated, or the content is larger than `max_bytes`.
std::string Gunzip(std::string_view bytes, size_t max_bytes);

}  // namespace daumier::render

#pragma once
#include "geometry/mesh.h"

#include <string>
#include <string_view>

namespace daumier::geometry {

/// A binary STL file: a header of 80 bytes that begins with `header` and is filled with zeros, the number of triangles as uint32, and 50
/// bytes a triangle: unit normal (0 without area), three corners as float32, and two zeros. Little-endian; no unit.
/// @throws Error if the header is longer than 80 bytes or begins with "solid", by which readers recognise text; if a
/// corner is no vertex, or not finite.
std::string EncodeStl(const TriangleMesh& mesh, std::string_view header);

/// The triangles of such a file, with one vertex for corners of the same coordinates. @throws Error unless the length fits the number
/// of triangles and all corners are finite.
TriangleMesh DecodeStl(std::string_view bytes);

}  // namespace daumier::geometry

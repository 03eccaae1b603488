#include "faces/morph_target.h"

#include "core/error.h"
#include "core/files.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <vector>

namespace daumier::faces {

geometry::Points ReadMorphTarget(const std::filesystem::path& file, int num_vertices) {
  const std::string text = ReadFile(file);
  geometry::Points displacement = geometry::Points::Zero(num_vertices, 3);
  std::vector<bool> seen(num_vertices, false);
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int line = 1; at < end; ++line) {
    const char* const line_end = std::find(at, end, '\n');
    const auto skip_space = [&] {
      at = std::find_if(at, line_end, [](char c) { return c != ' ' && c != '\t' && c != '\r'; });
    };
    const auto read = [&](auto& number) {
      skip_space();
      const auto result = std::from_chars(at, line_end, number);
      const bool ends = result.ptr == line_end || std::isspace(static_cast<unsigned char>(*result.ptr));
      DAUMIER_CHECK(result.ec == std::errc() && ends, "{}:{}: expected a vertex and three numbers", file.string(),
                    line);
      at = result.ptr;
    };
    skip_space();
    if (at != line_end && *at != '#') {
      int vertex = 0;
      geometry::Vector3 d;
      read(vertex);
      read(d.x());
      read(d.y());
      read(d.z());
      skip_space();
      DAUMIER_CHECK(at == line_end || *at == '#', "{}:{}: expected a vertex and three numbers, and nothing behind them",
                    file.string(), line);
      DAUMIER_CHECK(vertex >= 0 && vertex < num_vertices && d.allFinite(),
                    "{}:{}: vertex {} is out of range (0 to {}) or moves nowhere finite", file.string(), line, vertex,
                    num_vertices - 1);
      DAUMIER_CHECK(!seen[vertex], "{}:{}: vertex {} has two lines", file.string(), line, vertex);
      seen[vertex] = true;
      displacement.row(vertex) = d.transpose();
    }
    at = line_end == end ? end : line_end + 1;
  }
  return displacement;
}

}  // namespace daumier::faces

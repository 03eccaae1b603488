#include "geometry/ply.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/corner_uv.h"
#include "geometry/ply_rows.h"
#include "geometry/polygon_collector.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <unordered_map>

namespace daumier::geometry {
namespace {

/// Numbers the different UV at each vertex 0, 1, ... in order of their first use.
class UvTable {
 public:
  int Row(int vertex, double u, double v) {
    const Key key{vertex, u + 0.0, v + 0.0};  // -0 and 0 are one UV.
    const auto [found, is_new] = rows_.try_emplace(key, static_cast<int>(rows_.size()));
    if (is_new) values_.insert(values_.end(), {key.u, key.v});
    return found->second;
  }

  TextureCoordinates Table() const {
    return Eigen::Map<const TextureCoordinates>(values_.data(), static_cast<Eigen::Index>(values_.size() / 2), 2);
  }

 private:
  struct Key {
    int vertex;
    double u, v;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& key) const {
      uint64_t hash = static_cast<uint64_t>(key.vertex);
      for (const double part : {key.u, key.v}) hash = (hash ^ std::bit_cast<uint64_t>(part)) * 0x9E3779B97F4A7C15ull;
      return hash ^ (hash >> 32);
    }
  };

  std::unordered_map<Key, int, Hash> rows_;
  std::vector<double> values_;
};

/// Where to put a property of a vertex: x, y, z in 0 to 2, UV in 3 and 4.
struct VertexSlots {
  static constexpr size_t kSkipped = 5;
  std::vector<size_t> slot_of_property;
  bool has_uv = false;
};

VertexSlots FindSlots(const PlyElement& element, std::string_view name) {
  VertexSlots slots{std::vector<size_t>(element.properties.size(), VertexSlots::kSkipped)};
  const auto find = [&](const char* property) -> std::optional<size_t> {
    const auto found = element.Find(property);
    return found && !element.properties[*found].count_type ? found : std::nullopt;
  };
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (size_t k = 0; k < 3; ++k) {
    const auto found = find(kAxes[k]);
    DAUMIER_CHECK(found, "{}: its vertices have no number {} (expected the properties x, y and z)", name, kAxes[k]);
    slots.slot_of_property[*found] = k;
  }
  constexpr std::array<std::array<const char*, 2>, 4> kUvNames = {
      {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};
  for (const auto& [u_name, v_name] : kUvNames) {
    const auto u = find(u_name), v = find(v_name);
    if (slots.has_uv || !u || !v) continue;
    slots.slot_of_property[*u] = 3;
    slots.slot_of_property[*v] = 4;
    slots.has_uv = true;
  }
  return slots;
}

class PlyParser {
 public:
  PlyParser(std::string_view bytes, std::string_view name)
      : name_(name),
        header_(ParsePlyHeader(bytes, name)),
        rows_(bytes.substr(header_.num_bytes), header_.format, name) {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") num_vertices_ = element.count;
      if (element.name == "face" || element.name == "tristrips") num_rows_of_polygons_ += element.count;
    }
    DAUMIER_CHECK(num_vertices_ > 0 && num_vertices_ < uint64_t(std::numeric_limits<int>::max()),
                  "{}: no mesh (found {} vertices, expected 1 to {})", name, num_vertices_,
                  std::numeric_limits<int>::max() - 1);
    if (num_rows_of_polygons_ == 0) RefuseCloud(name, static_cast<int64_t>(num_vertices_));
  }

  PolygonMesh Parse() && {
    for (const PlyElement& element : header_.elements) {
      rows_.Begin(element);
      if (element.name == "vertex") {
        ReadVertices(element);
      } else if (element.name == "face") {
        ForEachPolygon(element, [this](const auto& indices, const auto& uv) { AddFace(indices, uv); });
      } else if (element.name == "tristrips") {
        ForEachPolygon(element, [this](const auto& indices, const auto&) { AddStrips(indices); });
      } else if (!element.properties.empty()) {
        for (uint64_t row = 0; row < element.count; ++row) SkipRow(element);
      }
    }
    return std::move(collector_).Finish(std::move(vertices_), TakeUv(), name_);
  }

 private:
  void SkipRow(const PlyElement& element) {
    rows_.NextRow();
    for (const PlyProperty& property : element.properties) rows_.Skip(property);
  }

  void ReadVertices(const PlyElement& element) {
    const VertexSlots slots = FindSlots(element, name_);
    const auto count = static_cast<Eigen::Index>(element.count);
    vertices_.resize(count, 3);
    if (slots.has_uv) vertex_uv_.resize(count, 2);
    std::array<double, 5> values{};
    for (Eigen::Index v = 0; v < count; ++v) {
      rows_.NextRow();
      for (size_t i = 0; i < element.properties.size(); ++i) {
        if (slots.slot_of_property[i] == VertexSlots::kSkipped) {
          rows_.Skip(element.properties[i]);
        } else {
          values[slots.slot_of_property[i]] = rows_.Read(element.properties[i]);
        }
      }
      vertices_.row(v) << values[0], values[1], values[2];
      if (slots.has_uv) vertex_uv_.row(v) << values[3], values[4];
    }
  }

  /// The list of a face or of strips that holds vertices.
  size_t IndexList(const PlyElement& element) const {
    for (const char* property : {"vertex_indices", "vertex_index"}) {
      const auto found = element.Find(property);
      if (found && element.properties[*found].count_type) return *found;
    }
    throw Error(fmt::format("{}: its element {} has no list vertex_indices or vertex_index", name_, element.name));
  }

  /// Calls use(indices, uv) with the lists of each row; `uv` is empty where the row has none.
  template <class Use>
  void ForEachPolygon(const PlyElement& element, const Use& use) {
    const size_t index_list = IndexList(element);
    const auto uv_property = element.Find("texcoord");
    const bool has_uv = uv_property && element.properties[*uv_property].count_type;
    std::vector<double> indices, uv;
    for (uint64_t row = 0; row < element.count; ++row) {
      rows_.NextRow();
      for (size_t i = 0; i < element.properties.size(); ++i) {
        if (i == index_list) {
          rows_.ReadList(element.properties[i], indices);
        } else if (has_uv && i == *uv_property) {
          rows_.ReadList(element.properties[i], uv);
        } else {
          rows_.Skip(element.properties[i]);
        }
      }
      use(indices, uv);
    }
  }

  void AddFace(const std::vector<double>& indices, const std::vector<double>& uv) {
    if (!uv.empty() && uv.size() != 2 * indices.size()) {
      rows_.Refuse(fmt::format("texcoord does not fit its corners (found {} numbers, expected {})", uv.size(),
                               2 * indices.size()));
    }
    corners_.clear();
    uv_corners_.assign(indices.size(), PolygonCollector::kNoUv);
    for (size_t k = 0; k < indices.size(); ++k) {
      corners_.push_back(ToIndex(indices[k], 0, int64_t(num_vertices_), "a corner", rows_));
      if (!uv.empty()) uv_corners_[k] = face_uv_.Row(corners_[k], uv[2 * k], uv[2 * k + 1]);
    }
    collector_.Add(corners_, uv_corners_);
  }

  /// Strips of triangles: each corner behind the second makes a triangle with the two before it; winding alternates.
  void AddStrips(const std::vector<double>& indices) {
    constexpr std::array<int, 3> kNoUvs = {PolygonCollector::kNoUv, PolygonCollector::kNoUv, PolygonCollector::kNoUv};
    std::vector<int> strip;
    for (const double index : indices) {
      const int vertex = ToIndex(index, -1, int64_t(num_vertices_), "a corner of a strip", rows_);
      if (vertex == -1) {
        strip.clear();
        continue;
      }
      strip.push_back(vertex);
      const size_t n = strip.size();
      if (n < 3) continue;
      std::array<int, 3> triangle = {strip[n - 3], strip[n - 2], vertex};
      if (n % 2 == 0) std::swap(triangle[0], triangle[1]);
      // A repeated vertex turns the strip: it is no damage, so that no warning counts it.
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2]) continue;
      collector_.Add(triangle, kNoUvs);
    }
  }

  /// UV of the faces if there is any, else that of the vertices.
  TextureCoordinates TakeUv() {
    TextureCoordinates uv = face_uv_.Table();
    if (uv.rows() > 0 || vertex_uv_.rows() == 0) return uv;
    collector_.UseVertexUv();
    return std::move(vertex_uv_);
  }

  std::string_view name_;
  PlyHeader header_;
  PlyRows rows_;
  uint64_t num_vertices_ = 0, num_rows_of_polygons_ = 0;
  Points vertices_;
  TextureCoordinates vertex_uv_;
  UvTable face_uv_;
  PolygonCollector collector_;
  std::vector<int> corners_, uv_corners_;  ///< Of the polygon at hand.
};

template <class T>
void Append(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little, "the file is little-endian");
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace

PolygonMesh ParsePly(std::string_view bytes, std::string_view name) {
  return PlyParser(bytes, name).Parse();
}

PolygonMesh ReadPly(const std::filesystem::path& path) {
  return ParsePly(ReadFile(path), path.string());
}

void WritePly(const std::filesystem::path& path, const PolygonMesh& mesh) {
  CheckUv(mesh);
  const std::string name = path.string();
  DAUMIER_CHECK(mesh.vertices.cast<float>().allFinite(), "{}: a position is not finite as a 32-bit float", name);
  int most_corners = 0;
  for (int p = 0; p < mesh.num_polygons(); ++p)
    most_corners = std::max(most_corners, mesh.offsets[p + 1] - mesh.offsets[p]);
  const bool has_long_lists = 2 * most_corners > std::numeric_limits<uint8_t>::max();
  const char* const count_type = has_long_lists ? "int" : "uchar";
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list {} int vertex_indices\n",
      mesh.vertices.rows(), mesh.num_polygons(), count_type);
  if (mesh.has_uv()) bytes += fmt::format("property list {} float texcoord\n", count_type);
  bytes += "end_header\n";
  for (Eigen::Index i = 0; i < mesh.vertices.size(); ++i) Append(bytes, static_cast<float>(mesh.vertices.data()[i]));
  const auto append_count = [&](int count) {
    has_long_lists ? Append(bytes, count) : Append(bytes, static_cast<uint8_t>(count));
  };
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const int begin = mesh.offsets[p], end = mesh.offsets[p + 1];
    append_count(end - begin);
    for (int k = begin; k < end; ++k) {
      const int vertex = mesh.corners[k];
      DAUMIER_CHECK(vertex >= 0 && vertex < mesh.vertices.rows(), "{}: polygon {} has the corner {} of {} vertices",
                    name, p, vertex, mesh.vertices.rows());
      Append(bytes, vertex);
    }
    if (!mesh.has_uv()) continue;
    append_count(2 * (end - begin));
    for (int k = begin; k < end; ++k) {
      for (const double value : mesh.uv.row(mesh.uv_corners[k])) Append(bytes, static_cast<float>(value));
    }
  }
  WriteFileAtomically(path, bytes);
}

void WritePly(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const auto flat = [](const Triangles& triangles) {
    return std::vector<int>(triangles.data(), triangles.data() + triangles.size());
  };
  PolygonMesh polygons{
      .vertices = mesh.vertices, .corners = flat(mesh.triangles), .uv = mesh.uv, .uv_corners = flat(mesh.uv_triangles)};
  for (int end = 3; end <= mesh.triangles.size(); end += 3) polygons.offsets.push_back(end);
  WritePly(path, polygons);
}

}  // namespace daumier::geometry

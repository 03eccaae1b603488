#pragma once
#include "core/error.h"
#include "core/json.h"

#include <Eigen/Core>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::testing {

/// A .glb as far as tests of its writer read it: uncompressed accessors of floats and indices in its one buffer.
class GlbReader {
 public:
  /// @throws Error unless lengths, magic numbers and chunks are those of binary glTF 2.0.
  explicit GlbReader(std::string bytes) : bytes_(std::move(bytes)) {
    DAUMIER_CHECK(Number(0) == 0x46546C67 && Number(4) == 2 && Number(8) == bytes_.size() && bytes_.size() % 4 == 0,
                  "no binary glTF 2.0");
    const size_t json_length = Number(12);
    DAUMIER_CHECK(Number(16) == 0x4E4F534A && json_length % 4 == 0, "the first chunk is no JSON");
    json_ = ParseJson(std::string_view(bytes_).substr(20, json_length), "glb");
    const size_t chunk = 20 + json_length;
    DAUMIER_CHECK(Number(chunk + 4) == 0x004E4942 && chunk + 8 + Number(chunk) == bytes_.size(),
                  "the second chunk is not the rest of the file");
    binary_ = std::string_view(bytes_).substr(chunk + 8);
  }
  GlbReader(const GlbReader&) = delete;
  GlbReader& operator=(const GlbReader&) = delete;

  const Json& json() const { return json_; }
  std::string_view binary() const { return binary_; }
  const Json& accessor(int index) const { return json_["accessors"].at(size_t(index)); }
  const Json& view_of(int accessor_index) const {
    return json_["bufferViews"].at(accessor(accessor_index)["bufferView"].get<size_t>());
  }

  /// count x components of a float32 accessor.
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> Floats(int index) const {
    DAUMIER_CHECK(accessor(index)["componentType"] == 5126, "accessor {} has no floats", index);
    const std::string type = accessor(index)["type"];
    const int columns = type == "SCALAR" ? 1 : type.back() - '0';
    Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(accessor(index)["count"].get<int>(),
                                                                                 columns);
    const std::string_view bytes = Bytes(index);
    DAUMIER_CHECK(bytes.size() == size_t(values.size()) * sizeof(float), "accessor {} is not its whole view", index);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  /// Indices of 2 or 4 bytes.
  std::vector<uint32_t> Indices(int index) const {
    const std::string_view bytes = Bytes(index);
    const size_t size = accessor(index)["componentType"] == 5123 ? 2 : 4;
    std::vector<uint32_t> indices(accessor(index)["count"].get<size_t>());
    DAUMIER_CHECK(bytes.size() == indices.size() * size, "accessor {} is not its whole view", index);
    for (size_t i = 0; i < indices.size(); ++i) std::memcpy(&indices[i], bytes.data() + i * size, size);
    return indices;
  }

  /// The node with a name. @throws Error unless there is exactly one.
  int Node(const std::string& name) const {
    int found = -1;
    for (size_t n = 0; n < json_["nodes"].size(); ++n) {
      if (json_["nodes"][n].value("name", "") != name) continue;
      DAUMIER_CHECK(found < 0, "two nodes are called {}", name);
      found = static_cast<int>(n);
    }
    DAUMIER_CHECK(found >= 0, "no node is called {}", name);
    return found;
  }
  const Json& node(const std::string& name) const { return json_["nodes"][size_t(Node(name))]; }
  /// The one primitive of the mesh of a node. @throws Error unless there is exactly one.
  const Json& primitive(const std::string& node_name) const {
    const Json& primitives = json_["meshes"].at(node(node_name)["mesh"].get<size_t>())["primitives"];
    DAUMIER_CHECK(primitives.size() == 1, "{} primitives of {}", primitives.size(), node_name);
    return primitives[0];
  }

 private:
  uint32_t Number(size_t at) const {
    DAUMIER_CHECK(at + 4 <= bytes_.size(), "the file ends at byte {}", bytes_.size());
    uint32_t number = 0;
    std::memcpy(&number, bytes_.data() + at, sizeof number);
    return number;
  }
  std::string_view Bytes(int index) const {
    const Json& view = view_of(index);
    DAUMIER_CHECK(view["buffer"] == 0 && !view.contains("byteStride") && !accessor(index).contains("byteOffset"),
                  "accessor {} does not lie tightly in the one buffer", index);
    return binary_.substr(view["byteOffset"], view["byteLength"]);
  }

  std::string bytes_;
  Json json_;
  std::string_view binary_;
};

}  // namespace daumier::testing

#include "gltf/head_reader.h"

#include "core/error.h"
#include "core/json.h"
#include "core/random.h"
#include "gltf/head_file.h"
#include "tests/support/ball_head.h"
#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>

namespace daumier::gltf {
namespace {

using testing::GlbReader;

/// A small head with an atlas, all 52 targets and eyes, or with materials of its own.
std::string SmallHead(bool has_own_materials) {
  rig::RiggedHead head = testing::BallHead(6, 8);
  if (!has_own_materials) {
    const render::Image texture(2, 2, 3, 90);
    return HeadToGlb(head, &texture, rig::WeightsClip());
  }
  head.own_materials = {{.name = "skin"}, {.name = "hat", .colour = {0.5f, 0.25f, 0}}};
  for (Eigen::Index f = 0; f < head.mesh.triangles.rows(); ++f) head.own.push_back(f % 5 == 0 ? 1 : 0);
  for (rig::RiggedEye& eye : head.eyes) eye.own.assign(size_t(eye.mesh.triangles.rows()), 0);
  return HeadToGlb(head, nullptr, rig::WeightsClip());
}

std::string Joined(const Json& json, std::string_view binary) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  const auto put = [&](size_t number) {
    const auto word = uint32_t(number);
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
  };
  put(2);
  put(28 + text.size() + binary.size());
  put(text.size());
  put(0x4E4F534A);
  bytes += text;
  put(binary.size());
  put(0x004E4942);
  return bytes.append(binary);
}

/// A value of the document somewhere: it becomes another one, or is gone.
void ChangeSomewhere(Json& json, Rng& rng) {
  Json* at = &json;
  Json* parent = nullptr;
  while (!at->empty() && at->is_structured()) {
    parent = at;
    auto child = at->begin();
    std::advance(child, int64_t(rng.Below(at->size())));
    at = &*child;
    if (rng.Below(8) == 0) break;
  }
  const std::vector<Json> values = {-1, 0, 1, 7, 100000, 1e300, 0.5, "Head", nullptr, Json::array(), Json::object()};
  if (parent->is_array() && rng.Below(4) == 0) {
    parent->erase(size_t(at - &parent->front()));
  } else {
    *at = values[rng.Below(values.size())];
  }
}

/// A copy of a file that is cut off, has other bytes, other numbers of its vertices, or another document.
std::string Mutated(const std::string& bytes, int kind, Rng& rng) {
  const GlbReader file(bytes);
  std::string changed = bytes;
  switch (kind) {
    case 0:
      return bytes.substr(0, rng.Below(bytes.size()));
    case 1:
      for (int i = 0; i < 3; ++i) changed[rng.Below(bytes.size() - file.binary().size())] ^= char(1 << rng.Below(7));
      return changed;
    case 2: {
      const std::array<float, 4> numbers = {std::numeric_limits<float>::quiet_NaN(), 1e30f, 0, 0.5f};
      std::memcpy(changed.data() + bytes.size() - 4 * (1 + rng.Below(file.binary().size() / 4)), &numbers[rng.Below(4)],
                  sizeof(float));
      return changed;
    }
    default: {
      Json json = file.json();
      ChangeSomewhere(json, rng);
      return Joined(json, file.binary());
    }
  }
}

/// The vectors of an accessor, by the format's own rules: views and accessors may be longer than they are as written.
Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> VectorsOf(const GlbReader& file, const Json& index) {
  const Json& accessor = file.json()["accessors"].at(index.get<size_t>());
  const Json& view = file.json()["bufferViews"].at(accessor["bufferView"].get<size_t>());
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> vectors(accessor["count"].get<int>(), 3);
  const size_t first = view.value("byteOffset", size_t(0)) + accessor.value("byteOffset", size_t(0));
  const std::string_view bytes = file.binary().substr(first, sizeof(float) * size_t(vectors.size()));
  std::memcpy(vectors.data(), bytes.data(), bytes.size());
  return vectors;
}

/// That arrays agree, and that vertices and targets are those that another reader finds in the file.
void ExpectRight(const std::string& bytes, const HeadInFile& read) {
  const rig::RiggedHead& head = read.head;
  const auto expect_mesh = [](const geometry::TriangleMesh& mesh, const std::vector<faces::HeadMaterial>& materials) {
    ASSERT_TRUE(mesh.vertices.allFinite());
    ASSERT_LT(mesh.triangles.maxCoeff(), mesh.vertices.rows());
    ASSERT_GE(mesh.triangles.minCoeff(), 0);
    ASSERT_EQ(std::ssize(materials), mesh.triangles.rows());
    if (!mesh.has_uv()) return;
    ASSERT_EQ(mesh.uv_triangles.rows(), mesh.triangles.rows());
    ASSERT_LT(mesh.uv_triangles.maxCoeff(), mesh.uv.rows());
  };
  expect_mesh(head.mesh, head.materials);
  for (const rig::RiggedEye& eye : head.eyes) expect_mesh(eye.mesh, eye.materials);
  ASSERT_EQ(head.targets.offsets.rows(), 3 * head.mesh.vertices.rows());
  ASSERT_EQ(head.targets.offsets.cols(), head.targets.num_targets());
  ASSERT_TRUE(head.targets.offsets.allFinite());
  ASSERT_TRUE(head.jaw_pivot.allFinite());
  const GlbReader file(bytes);
  const Json& root = file.json()["nodes"].at(file.json()["scenes"].at(0)["nodes"].at(0).get<size_t>());
  const Json& primitive = file.json()["meshes"].at(root["mesh"].get<size_t>())["primitives"].at(0);
  const auto positions = VectorsOf(file, primitive["attributes"]["POSITION"]);
  ASSERT_LE(positions.rows(), std::ssize(read.of_file_vertices));
  for (Eigen::Index n = 0; n < positions.rows(); ++n) {
    const int v = read.of_file_vertices[size_t(n)];
    ASSERT_LT((head.mesh.vertices.row(v) - 100 * positions.row(n).cast<double>()).norm(), 1e-9);
  }
  for (Eigen::Index t = 0; t < head.targets.offsets.cols(); ++t) {
    const auto moves = VectorsOf(file, primitive["targets"].at(size_t(t))["POSITION"]);
    for (Eigen::Index n = 0; n < positions.rows(); ++n) {
      const int v = read.of_file_vertices[size_t(n)];
      ASSERT_LT((head.targets.offsets.col(t).segment<3>(3 * v).transpose() - 100 * moves.row(n)).norm(), 1e-4f);
    }
  }
}

TEST(ReadHead, OfTwoHundredMutatedHeadsRefusesOrReadsEachRight) {
  Rng rng(29);
  int num_refused = 0, num_read = 0;
  for (const bool has_own_materials : {false, true}) {
    const std::string bytes = SmallHead(has_own_materials);
    ExpectRight(bytes, ParseHead(bytes, "head.glb"));
    for (int i = 0; i < 100; ++i) {
      const std::string changed = Mutated(bytes, i % 5, rng);
      try {
        const HeadInFile read = ParseHead(changed, "head.glb");
        ExpectRight(changed, read);
        ++num_read;
      } catch (const Error& error) {
        EXPECT_TRUE(std::string_view(error.what()).starts_with("head.glb: ")) << error.what();
        ++num_refused;
      }
      ASSERT_FALSE(HasFatalFailure()) << "copy " << i << ", " << has_own_materials;
    }
  }
  EXPECT_EQ(num_refused + num_read, 200);
  EXPECT_GT(num_refused, 60);
  EXPECT_GT(num_read, 20) << "a name or a weight of the animation, which is not read, may be another one";
}

TEST(ReadHead, RefusesNumbersThatNoHeadHas) {
  const std::string bytes = SmallHead(true);
  const auto refused = [&](const std::function<void(Json&)>& change) -> std::string {
    const GlbReader file(bytes);
    Json json = file.json();
    change(json);
    try {
      ParseHead(Joined(json, file.binary()), "head.glb");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused([](Json&) {}), "");
  EXPECT_NE(refused([](Json& j) { j["nodes"][0]["mesh"] = 1e300; }).find("is no whole number"), std::string::npos);
  EXPECT_NE(refused([](Json& j) { j["bufferViews"][0]["byteOffset"] = 0.5; }).find("is no whole number"),
            std::string::npos);
  const auto far = [](Json& j) {
    for (Json& node : j["nodes"])
      if (node["name"] == "Jaw") node["translation"][1] = 1e300;
  };
  EXPECT_NE(refused(far).find("a node is 1e+300 m away"), std::string::npos);
  const auto colour = [](Json& j) { j["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][0] = 1e300; };
  EXPECT_NE(refused(colour).find("a colour has the share 1e+300"), std::string::npos);
  const auto repeated = [](Json& j) {
    for (Json& node : j["nodes"])
      if (node["name"] == "Head")
        for (int i = 0; i < 2000; ++i) node["children"].push_back(node["children"][0]);
  };
  EXPECT_NE(refused(repeated).find("its nodes share vertices"), std::string::npos) << refused(repeated);
  const auto many = [](Json& j) {
    Json& primitive = j["meshes"][0]["primitives"][0];
    for (int i = 0; i < 300; ++i) {
      primitive["targets"].push_back(primitive["targets"][0]);
      j["meshes"][0]["extras"]["targetNames"].push_back("t");
    }
  };
  EXPECT_NE(refused(many).find("352 targets, expected at most 256"), std::string::npos);
}

}  // namespace
}  // namespace daumier::gltf

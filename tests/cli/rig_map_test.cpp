// `daumier rig --map` and `--meshes` as their users run them.
#include "core/files.h"
#include "core/json.h"
#include "faces/face_model_file.h"
#include "geometry/obj.h"
#include "rig/arkit_names.h"
#include "rig/clip_files.h"
#include "rig/expression_targets.h"
#include "tests/cli/pipeline.h"
#include "tests/faces/import/foreign_files.h"
#include "tests/geometry/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace daumier::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

using MeshBytes = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Files of other face models that have the shipped model's topology, so that nothing has to be registered; their expressions are
/// known mixtures of its targets.
class RigMapCommand : public ::testing::Test {
 protected:
  static const faces::FaceModel& Model() {
    static const faces::FaceModel model = faces::ReadFaceModelWeights(SourceRoot() / "weights/face-ict");
    return model;
  }
  static const faces::FaceTemplate& Face() { return Model().face_template; }
  static geometry::Points Shown(const std::vector<std::pair<const char*, float>>& weights) {
    static const rig::MorphTargets targets = rig::ExpressionTargets(Model()).On(Face().neutral);
    Eigen::VectorXf offset = Eigen::VectorXf::Zero(Face().neutral.size());
    for (const auto& [name, weight] : weights) offset += weight * targets.offsets.col(*rig::FindArkitName(name));
    const Eigen::VectorXd exact = offset.cast<double>();
    return Face().neutral + Eigen::Map<const geometry::Points>(exact.data(), exact.size() / 3, 3);
  }
  static float& At(Eigen::MatrixXf& weights, int frame, const char* name) {
    return weights(frame, *rig::FindArkitName(name));
  }

  RigMapCommand() {
    const Json annotation = {
        {"format", 1}, {"landmarks", Face().annotation.landmarks}, {"hairline", Face().annotation.hairline_vertex}};
    WriteFileAtomically(folder_ / "annotation.json", annotation.dump());
  }

  void WriteMesh(const std::string& name, const geometry::Points& vertices) const {
    geometry::WriteObj(folder_ / name, {vertices, Face().triangles});
  }
  enum class Order { kSame, kReversed };
  /// A person of FaceWarehouse, in its unit of 10 cm. In reversed order the vertices are of another topology.
  void WriteFaceWarehouse(Order order = Order::kSame) const {
    const bool is_reversed = order == Order::kReversed;
    const auto in_file = [&](const geometry::Points& points) -> geometry::Points {
      return 0.1 * (is_reversed ? geometry::Points(points.colwise().reverse()) : points);
    };
    MakeDirectory(folder_ / "fw/Tester_1/Blendshape");
    geometry::Triangles triangles = Face().triangles;
    if (is_reversed) triangles = (Face().num_vertices() - 1 - triangles.array()).matrix();
    geometry::WriteObj(folder_ / "fw/Tester_1/Blendshape/shape_0.obj", {in_file(Face().neutral), triangles});
    std::string bytes = BytesOf(std::vector<int32_t>{2, Face().num_vertices(), 0});
    for (const geometry::Points& shape :
         {Face().neutral, Shown({{"jawOpen", 0.5f}, {"mouthSmileLeft", 0.25f}}), Shown({{"browInnerUp", 0.75f}})}) {
      const MeshBytes floats = in_file(shape).cast<float>();
      bytes.append(reinterpret_cast<const char*>(floats.data()), sizeof(float) * size_t(floats.size()));
    }
    WriteFileAtomically(folder_ / "fw/Tester_1/Blendshape/shape.bs", bytes);
  }
  /// The Basel Face Model of 2017, in mm: a mean expression and two modes.
  void WriteBfm() const {
    const auto num = hsize_t(Face().neutral.size());
    const auto flat = [](const geometry::Points& points) {
      const MeshBytes floats = (10 * points).cast<float>();
      return std::vector<float>(floats.data(), floats.data() + floats.size());
    };
    const std::vector<float> mean = flat(Shown({{"jawOpen", 0.125f}}) - Face().neutral),
                             first = flat(Shown({{"mouthPucker", 0.5f}}) - Face().neutral),
                             second = flat(Face().neutral - Shown({{"browDownLeft", 0.25f}}));
    std::vector<float> basis;
    for (size_t i = 0; i < first.size(); ++i) basis.insert(basis.end(), {first[i], second[i] / 2});
    Hdf5Writer file(folder_ / "model2017.h5");
    file.Add("shape/model/mean", {num}, flat(Face().neutral));
    file.Add("shape/model/pcaBasis", {num, 1}, std::vector<float>(num, 0.01f));
    file.Add("shape/model/pcaVariance", {1}, std::vector<float>{1});
    file.Add("expression/model/mean", {num}, mean);
    file.Add("expression/model/pcaBasis", {num, 2}, basis);
    file.Add("expression/model/pcaVariance", {2}, std::vector<float>{1, 4});
    std::vector<int> cells(size_t(Face().triangles.size()));
    for (Eigen::Index f = 0; f < Face().triangles.rows(); ++f)
      for (int k = 0; k < 3; ++k) cells[size_t(k * Face().triangles.rows() + f)] = Face().triangles(f, k);
    file.Add("shape/representer/cells", {3, hsize_t(Face().triangles.rows())}, cells);
  }

  std::string In(const std::string& name) const { return (folder_ / name).string(); }
  ProcessResult Map(const std::string& model, const std::string& out, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"rig", "--map", model, "--out", In(out)});
    return Daumier(options);
  }
  std::string Annotation() const { return "source.annotation=" + In("annotation.json"); }

  const TempDir folder_;
};

TEST_F(RigMapCommand, MapsBlendshapesOfFaceWarehouseAndAppliesTheMap) {
  WriteFaceWarehouse();
  const ProcessResult result = Map(In("fw"), "map.json", {Annotation(), "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(Json::parse(result.out)["model"].get<std::string>(), HasSubstr("FaceWarehouse's terms"));
  const Json map = ReadJson(folder_ / "map.json");
  EXPECT_EQ(map["kind"], "expression_map");
  EXPECT_EQ(map["coefficients"], "blend");
  EXPECT_EQ(map["expressions"], (Json{"shape_1", "shape_2"}));
  EXPECT_THAT(map["model"]["licence"].get<std::string>(), HasSubstr("research only"));
  EXPECT_THAT(map["targets"]["licence"].get<std::string>(), HasSubstr("MIT"));
  const auto weight = [&](int row, const char* name) {
    return map["positive"][row][*rig::FindArkitName(name)].get<double>();
  };
  EXPECT_NEAR(weight(0, "jawOpen"), 0.5, 1e-3);
  EXPECT_NEAR(weight(0, "mouthSmileLeft"), 0.25, 1e-3);
  EXPECT_NEAR(weight(1, "browInnerUp"), 0.75, 1e-3);
  EXPECT_LT(map["errors"][0]["max_mm"], 0.01);
  EXPECT_GT(map["errors"][0]["no_motion_rms_mm"], 1);
  EXPECT_GT(map["errors"][0]["explained"], 0.9999);

  WriteFileAtomically(folder_ / "take.csv", "time,shape_2\n0,0\n0.5,1\n");
  const ProcessResult applied = Map(In("map.json"), "take_weights.csv", {"--apply", In("take.csv"), "--keep-strength"});
  ASSERT_EQ(applied.exit_code, 0) << applied.err;
  EXPECT_THAT(applied.err, HasSubstr("1 of 2 expressions have no column and are 0"));
  EXPECT_THAT(ReadFile(folder_ / "take_weights.csv"), HasSubstr("# model: FaceWarehouse, Blendshape; FaceWarehouse's"));
  rig::Recording clip = rig::ReadClip(folder_ / "take_weights.csv");
  ASSERT_EQ(clip.num_frames(), 2);
  EXPECT_EQ(clip.seconds[1], 0.5);
  EXPECT_NEAR(At(clip.weights, 1, "browInnerUp"), 0.75, 1e-3);
  EXPECT_EQ(At(clip.weights, 0, "browInnerUp"), 0);
}

TEST_F(RigMapCommand, RegistersModelsOfOtherTopologies) {
  WriteFaceWarehouse(Order::kReversed);
  const int last = Face().num_vertices() - 1;
  Json annotation = ReadJson(folder_ / "annotation.json");
  for (Json& landmark : annotation["landmarks"]) landmark = last - landmark.get<int>();
  annotation["hairline"] = last - annotation["hairline"].get<int>();
  WriteFileAtomically(folder_ / "annotation.json", annotation.dump());
  const ProcessResult result = Map(In("fw"), "map.json", {Annotation()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json map = ReadJson(folder_ / "map.json");
  EXPECT_LT(map["registration"]["template_to_target_mm"]["mean"], 0.05);
  const auto weight = [&](int row, const char* name) {
    return map["positive"][row][*rig::FindArkitName(name)].get<double>();
  };
  EXPECT_NEAR(weight(0, "jawOpen"), 0.5, 0.05);
  EXPECT_NEAR(weight(0, "mouthSmileLeft"), 0.25, 0.05);
  EXPECT_NEAR(weight(1, "browInnerUp"), 0.75, 0.05);
  EXPECT_GT(map["errors"][0]["explained"], 0.98);
}

TEST_F(RigMapCommand, MapsBothEndsOfTheModesOfBfm) {
  WriteBfm();
  WriteFileAtomically(folder_ / "take.json", "[[0, 0], [1, 2], [0, -2]]");
  const ProcessResult result =
      Map(In("model2017.h5"), "weights.csv", {Annotation(), "--apply", In("take.json"), "--fps", "25"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  rig::Recording clip = rig::ReadClip(folder_ / "weights.csv");
  ASSERT_EQ(clip.num_frames(), 3);
  EXPECT_NEAR(clip.seconds[2], 0.08, 1e-9);
  EXPECT_NEAR(At(clip.weights, 0, "jawOpen"), 0.125, 1e-3) << "the mean expression";
  EXPECT_NEAR(At(clip.weights, 1, "mouthPucker"), 0.5, 1e-2);
  EXPECT_NEAR(At(clip.weights, 2, "browDownLeft"), 0.5, 1e-2) << "-2 standard deviations";
  EXPECT_NEAR(At(clip.weights, 1, "browDownLeft"), 0, 1e-2);
}

TEST_F(RigMapCommand, WeighsMeshesWhereverTheHeadIs) {
  WriteMesh("neutral.obj", Face().neutral);
  WriteMesh("a.obj", Shown({{"jawOpen", 0.5f}, {"eyeBlinkLeft", 0.75f}}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, geometry::Vector3::UnitY()).toRotationMatrix();
  WriteMesh("b.obj", (Shown({{"mouthSmileRight", 1}}) * turn.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3));
  const ProcessResult result = Daumier({"rig", In("neutral.obj"), "--out", In("weights.csv"), "--fps", "30", "--json",
                                        "--meshes", In("a.obj"), In("b.obj")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json summary = Json::parse(result.out);
  EXPECT_LT(summary["meshes"][0]["max_mm"], 0.01);
  EXPECT_GT(summary["meshes"][0]["no_motion_rms_mm"], 1);
  rig::Recording clip = rig::ReadClip(folder_ / "weights.csv");
  ASSERT_EQ(clip.num_frames(), 2);
  EXPECT_NEAR(At(clip.weights, 0, "jawOpen"), 0.5, 1e-3);
  EXPECT_NEAR(At(clip.weights, 0, "eyeBlinkLeft"), 0.75, 1e-3);
  EXPECT_NEAR(At(clip.weights, 1, "mouthSmileRight"), 1, 1e-3);
  EXPECT_NEAR(At(clip.weights, 1, "jawOpen"), 0, 1e-3);
}

TEST_F(RigMapCommand, NamesWhatIsWrongWithAFile) {
  WriteFaceWarehouse();
  MakeDirectory(folder_ / "meshes");
  WriteMesh("meshes/a.obj", Face().neutral);
  WriteMesh("neutral.obj", Face().neutral);
  geometry::WriteObj(folder_ / "ball.obj", Sphere(1, 2));
  WriteFileAtomically(folder_ / "three.csv", "1,2,3\n");
  WriteFileAtomically(folder_ / "nan.csv", "shape_1\nnan\n");
  WriteFileAtomically(folder_ / "other.json", "{}");
  const auto apply = [&](const char* file) {
    return Map(In("fw"), "weights.csv", {Annotation(), "--apply", In(file)});
  };
  const std::vector<std::pair<ProcessResult, std::string>> failures = {
      {Map(In("meshes"), "map.json", {Annotation(), "source.name=meshes"}), "has no expressions, only neutral faces"},
      {Map(In("fw"), "map.json", {Annotation(), "source.name=ict"}), "is it ICT-FaceKit?"},
      {apply("three.csv"), "three.csv: frame 0 has 3 coefficients, the model 2 (shape_1 .. shape_2)"},
      {apply("nan.csv"), "nan.csv: line 2: column 1: 'nan' is no finite number"},
      {Map(In("other.json"), "weights.csv", {"--apply", In("three.csv")}), "other.json: is no map of expressions"},
      {Daumier({"rig", In("neutral.obj"), "--out", In("weights.csv"), "--meshes", In("ball.obj")}), "ball.obj has "}};
  for (const auto& [result, part] : failures) {
    EXPECT_EQ(result.exit_code, 1) << part << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(part));
  }
  EXPECT_FALSE(fs::exists(folder_ / "map.json"));
  EXPECT_FALSE(fs::exists(folder_ / "weights.csv"));
}

TEST_F(RigMapCommand, RefusesMisuse) {
  WriteMesh("head.obj", Face().neutral);
  WriteFileAtomically(folder_ / "mine.json", "{\"kind\": \"mine\"}");
  WriteFileAtomically(folder_ / "mine.csv", "my,table\n");
  WriteFileAtomically(folder_ / "c.csv", "1\n");
  MakeDirectory(folder_ / "fw/Tester_1");
  const std::vector<std::pair<ProcessResult, std::string>> misuses = {
      {Map(In("fw"), "map.csv"), "ends in .json"},
      {Map(In("fw"), "map.json", {"--apply", In("c.csv")}), "ends in .csv"},
      {Map(In("fw"), "mine.json"), "mine.json exists"},
      {Map(In("fw"), "mine.csv", {"--apply", In("c.csv")}), "mine.csv exists"},
      {Map(In("fw"), "map.json"), "needs source.annotation"},
      {Map(In("head.obj"), "map.json"), "is not recognised. Name it with source.name="},
      {Map(In("nobody"), "map.json"), "there is no "},
      {Map(In("mine.json"), "map.json"), "is a map already"},
      {Map(In("fw"), "map.json", {In("head.obj")}), "takes no FACE"},
      {Map(In("fw"), "map.json", {"--vrm"}), "--vrm: --map makes weights and no head"},
      {Map(In("fw"), "map.json", {"--hair", "short"}), "--hair: --map makes weights and no head"},
      {Map(In("fw"), "map.json", {"--fps", "25"}), "a map has no frames. Add --apply FILE"},
      {Map(In("mine.json"), "w.csv", {"source.name=ict", "--apply", In("c.csv")}), "source.name=ict: has no effect"},
      {Map(In("fw"), "map.json", {"--landmarks", In("c.csv")}), "takes the landmarks of source.annotation"},
      {Daumier({"rig", In("head.obj"), "--out", In("h.glb"), "--fps", "30"}), "--fps is an option of"},
      {Map(In("fw"), "map.json", {"--meshes", In("head.obj")}), "--meshes"},
      {Daumier({"rig", "--out", In("head.glb")}), "FACE is required"},
      {Daumier({"rig", In("head.obj"), "--out", In("w.csv"), "--apply", In("c.csv")}), "--map"},
      {Daumier({"rig", In("head.obj"), "--out", In("w.glb"), "--meshes", In("head.obj")}), "ends in .csv"}};
  for (const auto& [result, part] : misuses) {
    EXPECT_EQ(result.exit_code, 2) << part << ": " << result.err;
    EXPECT_THAT(result.err, HasSubstr(part));
  }
  EXPECT_EQ(ReadFile(folder_ / "mine.csv"), "my,table\n");
}

}  // namespace
}  // namespace daumier::testing

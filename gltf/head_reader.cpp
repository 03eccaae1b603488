#include "gltf/head_reader.h"

#include "core/error.h"
#include "core/files.h"
#include "gltf/glb_file.h"
#include "gltf/triangle_runs.h"
#include "render/draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace daumier::gltf {
namespace {

constexpr double kCmPerM = 100;
constexpr float kMostMetres = 1e4F;   // Beyond it float32 has no millimetres.
constexpr size_t kMostTargets = 256;  // Names of all presets, visemes and extras are fewer.

/// A mesh of the file.
struct FilePart {
  FloatRows positions;              ///< N x 3, m.
  geometry::TextureCoordinates uv;  ///< N x 2, v up; no rows: none.
  std::vector<uint32_t> corners;
  Eigen::MatrixXf offsets;  ///< 3N x T, cm; without columns where it has no targets.
  std::vector<std::string> names;
  std::vector<std::array<uint8_t, 4>> colours;
  int64_t material = 0;
  bool has_normals = false;

  int num_vertices() const { return int(positions.rows()); }
};

float SrgbFromLinear(uint8_t value) {
  const double linear = value / 255.0;
  return float(linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

class HeadReading {
 public:
  HeadReading(std::string bytes, const std::string& name) : file_(std::move(bytes), name) {}

  HeadInFile Read() {
    CheckOrigin();
    const Json& root = RootNode();
    result_.pivot_height_cm = TranslationOf(root).y();
    ReadAsset();
    std::vector<FilePart> head = {PartOf(root)};
    std::map<std::string, const Json*> eyes;
    has_own_ = IsOwn(head[0].material);
    bool has_jaw = false;
    for (const Json& child : root.at("children")) {
      const Json& node = file_.Item("nodes", child);
      const std::string name = node.at("name");
      if (name.starts_with("Head_")) {
        head.push_back(PartOf(node));
      } else if (name == "LeftEye" || name == "RightEye") {
        eyes[name] = &node;
      } else if (name == "Jaw") {
        result_.head.jaw_pivot = TranslationOf(node);
        has_jaw = true;
      } else {
        AddAttachment(node, name);
      }
    }
    if (!has_jaw || eyes.size() == 1) file_.FailDamaged("a node Jaw, LeftEye or RightEye is missing");
    AddHead(head, root);
    for (const char* name : {"RightEye", "LeftEye"})
      if (eyes.contains(name)) AddEye(*eyes[name]);
    ReadTexture(head[0].material);
    return std::move(result_);
  }

 private:
  void CheckOrigin() const {
    const Json& asset = file_.json().at("asset");
    const std::string generator = asset.value("generator", std::string("an unknown program"));
    DAUMIER_CHECK(generator.starts_with("Daumier "),
                  "{}: was written by {}. Give a head that `daumier rig` or `daumier avatar` wrote; a mesh of another "
                  "program is rigged without --from",
                  file_.name(), generator);
  }

  const Json& RootNode() const {
    const Json& roots = file_.Item("scenes", 0).at("nodes");
    const Json& root = file_.Item("nodes", roots.at(0));
    DAUMIER_CHECK(root.value("name", std::string()) == "Head" && root.contains("mesh"),
                  "{}: has the nodes of Ready Player Me or VRM. Give the .glb that was written without --names rpm, or "
                  "write it with --names arkit",
                  file_.name());
    return root;
  }

  void ReadAsset() {
    const Json& extras = file_.json().at("asset").at("extras");
    result_.head.source = extras.at("name").get<std::string>();
    result_.head.licence = extras.at("licence").get<std::string>();
    result_.head.head_pivot.setZero();
  }

  FilePart PartOf(const Json& node) {
    const Json& mesh = file_.Item("meshes", node.at("mesh"));
    const Json& primitives = mesh.at("primitives");
    if (primitives.size() != 1)
      file_.FailDamaged(fmt::format("a mesh has {} primitives, expected 1", primitives.size()));
    const Json& primitive = primitives.at(0);
    const Json& attributes = primitive.at("attributes");
    FilePart part;
    part.positions = file_.Floats(attributes.at("POSITION"), 3);
    CheckLengths(part.positions);
    num_vertices_ += size_t(part.positions.rows());  // Many nodes on few bytes would need any memory.
    if (num_vertices_ > file_.num_binary_bytes() / (3 * sizeof(float))) file_.FailDamaged("its nodes share vertices");
    part.corners = file_.Indices(primitive.at("indices"), part.positions.rows());
    part.material = file_.Integer(primitive.at("material"));
    if (attributes.contains("TEXCOORD_0")) {
      const FloatRows uv = file_.Floats(attributes.at("TEXCOORD_0"), 2);
      CheckRows(uv.rows(), part);
      part.uv.resize(uv.rows(), 2);
      part.uv.col(0) = uv.col(0).cast<double>();
      part.uv.col(1) = 1 - uv.col(1).cast<double>().array();
    }
    if (attributes.contains("COLOR_0")) {
      part.colours = file_.Colours(attributes.at("COLOR_0"));
      CheckRows(std::ssize(part.colours), part);
    }
    if (primitive.contains("targets")) ReadTargets(mesh, primitive.at("targets"), part);
    return part;
  }

  void CheckRows(int64_t rows, const FilePart& part) const {
    if (rows != part.num_vertices())
      file_.FailDamaged(fmt::format("an attribute of {} vertices has {}", part.num_vertices(), rows));
  }

  void CheckLengths(const FloatRows& metres) const {
    if (metres.rows() > 0 && metres.cwiseAbs().maxCoeff() > kMostMetres)
      file_.FailDamaged(fmt::format("a vertex is {:.3g} m away", metres.cwiseAbs().maxCoeff()));
  }

  /// Of a node, cm.
  geometry::Vector3 TranslationOf(const Json& node) const {
    geometry::Vector3 cm = geometry::Vector3::Zero();
    if (!node.contains("translation")) return cm;
    for (int c = 0; c < 3; ++c) cm[c] = kCmPerM * node.at("translation").at(size_t(c)).get<double>();
    if (!(cm.cwiseAbs().maxCoeff() <= kCmPerM * kMostMetres))
      file_.FailDamaged(fmt::format("a node is {:.3g} m away", cm.cwiseAbs().maxCoeff() / kCmPerM));
    return cm;
  }

  float ShareOf(const Json& value) const {
    const auto share = value.get<double>();
    if (!(share >= 0 && share <= 1)) file_.FailDamaged(fmt::format("a colour has the share {:.3g}", share));
    return float(share);
  }

  void ReadTargets(const Json& mesh, const Json& targets, FilePart& part) const {
    part.names = mesh.at("extras").at("targetNames").get<std::vector<std::string>>();
    if (targets.size() > kMostTargets)
      file_.FailDamaged(fmt::format("{} targets, expected at most {}", targets.size(), kMostTargets));
    if (part.names.size() != targets.size())
      file_.FailDamaged(fmt::format("{} targets have {} names", targets.size(), part.names.size()));
    part.offsets.resize(3 * part.num_vertices(), std::ssize(targets));
    for (size_t t = 0; t < targets.size(); ++t) {
      const FloatRows metres = file_.Floats(targets.at(t).at("POSITION"), 3);
      CheckRows(metres.rows(), part);
      CheckLengths(metres);
      part.offsets.col(Eigen::Index(t)) =
          float(kCmPerM) * Eigen::Map<const Eigen::VectorXf>(metres.data(), metres.size());
      part.has_normals = part.has_normals || targets.at(t).contains("NORMAL");
    }
  }

  bool IsOwn(int64_t material) const { return file_.Item("materials", material).value("doubleSided", false); }

  /// The row of a material of the head's own.
  int OwnRow(int64_t material) {
    const auto [row, is_new] = own_rows_.emplace(material, int(result_.head.own_materials.size()));
    if (!is_new) return row->second;
    const Json& item = file_.Item("materials", material);
    const Json& surface = item.at("pbrMetallicRoughness");
    rig::OwnMaterial own{.name = item.at("name").get<std::string>()};
    for (size_t c = 0; c < 3; ++c) own.colour[c] = ShareOf(surface.at("baseColorFactor").at(c));
    own.opacity = ShareOf(surface.at("baseColorFactor").at(3));
    if (const auto image = ImageOf(surface))
      own.picture = std::make_shared<const std::string>(file_.ImageBytes(*image));
    result_.head.own_materials.push_back(std::move(own));
    return row->second;
  }

  std::optional<int64_t> ImageOf(const Json& surface) const {
    if (!surface.contains("baseColorTexture")) return std::nullopt;
    const Json& texture = file_.Item("textures", surface.at("baseColorTexture").at("index"));
    return file_.Integer(texture.at("source"));
  }

  void ReadTexture(int64_t material) {
    if (has_own_) return;
    const auto image = ImageOf(file_.Item("materials", material).at("pbrMetallicRoughness"));
    if (!image) return;
    result_.texture = std::make_shared<const render::Image>(
        render::ToRgb(render::DecodeImage(file_.ImageBytes(*image), file_.name() + ": its texture")));
  }

  /// Parts as one mesh. `welded`: the vertex of each vertex of the parts.
  static geometry::TriangleMesh JoinedParts(const std::vector<FilePart>& parts, const std::vector<int>& welded) {
    int64_t num_corners = 0, num_uv = 0;
    bool has_uv = true;
    for (const FilePart& part : parts) {
      num_corners += std::ssize(part.corners);
      num_uv += part.uv.rows();
      has_uv = has_uv && part.uv.rows() > 0;
    }
    geometry::TriangleMesh mesh;
    mesh.vertices.resize(welded.empty() ? 0 : *std::ranges::max_element(welded) + 1, 3);
    mesh.triangles.resize(num_corners / 3, 3);
    mesh.uv.resize(has_uv ? num_uv : 0, 2);
    mesh.uv_triangles.resize(has_uv ? num_corners / 3 : 0, 3);
    Eigen::Index corner = 0, first = 0;
    for (const FilePart& part : parts) {
      for (int n = 0; n < part.num_vertices(); ++n)
        mesh.vertices.row(welded[size_t(first + n)]) = kCmPerM * part.positions.row(n).cast<double>();
      if (has_uv) mesh.uv.middleRows(first, part.uv.rows()) = part.uv;
      for (const uint32_t n : part.corners) {
        mesh.triangles.data()[corner] = welded[size_t(first) + n];
        if (has_uv) mesh.uv_triangles.data()[corner] = int(first) + int(n);
        ++corner;
      }
      first += part.num_vertices();
    }
    return mesh;
  }

  /// Whether two vertices are at one place and move alike; parts without targets do not move.
  static bool IsSame(const FilePart& a, Eigen::Index i, const FilePart& b, Eigen::Index j) {
    if (a.positions.row(i) != b.positions.row(j)) return false;
    if (a.offsets.cols() == 0 && b.offsets.cols() == 0) return true;
    if (a.offsets.cols() == 0) return b.offsets.middleRows<3>(3 * j).isZero(0);
    if (b.offsets.cols() == 0) return a.offsets.middleRows<3>(3 * i).isZero(0);
    return a.offsets.middleRows<3>(3 * i) == b.offsets.middleRows<3>(3 * j);
  }

  /// The vertex of the welded mesh of each vertex of the parts, in order.
  static std::vector<int> Weld(const std::vector<FilePart>& parts) {
    struct Place {
      size_t part;
      Eigen::Index vertex;
      int welded;
    };
    std::map<std::array<float, 3>, std::vector<Place>> places;
    std::vector<int> welded;
    int count = 0;
    for (size_t p = 0; p < parts.size(); ++p) {
      const FilePart& part = parts[p];
      for (Eigen::Index n = 0; n < part.num_vertices(); ++n) {
        if (n > 0 && IsSame(part, n - 1, part, n)) {
          welded.push_back(welded.back());
          continue;
        }
        std::vector<Place>& here = places[{part.positions(n, 0), part.positions(n, 1), part.positions(n, 2)}];
        const auto found = std::ranges::find_if(here, [&](const Place& other) {
          return other.part != p && IsSame(parts[other.part], other.vertex, part, n);
        });
        welded.push_back(found == here.end() ? count++ : found->welded);
        here.push_back({p, n, welded.back()});
      }
    }
    return welded;
  }

  std::optional<ReadTriangleRuns> StatedTriangles(const Json& node, int64_t num_triangles) const {
    const Json::json_pointer runs("/extras/triangles");
    return node.contains(runs) ? ParseTriangleRuns(node.at(runs), num_triangles) : std::nullopt;
  }

  void AddOwnRows(const std::vector<FilePart>& parts, std::vector<int>& own) {
    if (!has_own_) return;
    for (const FilePart& part : parts) own.insert(own.end(), part.corners.size() / 3, OwnRow(part.material));
  }

  void AddHead(const std::vector<FilePart>& parts, const Json& node) {
    rig::RiggedHead& head = result_.head;
    result_.of_file_vertices = Weld(parts);
    head.mesh = JoinedParts(parts, result_.of_file_vertices);
    const auto num_triangles = size_t(head.mesh.triangles.rows());
    if (auto stated = StatedTriangles(node, int64_t(num_triangles))) {
      head.materials = std::move(stated->materials);
      head.neck_cap = std::move(stated->neck_cap);
    } else {
      head.materials.assign(num_triangles, faces::HeadMaterial::kSkin);
    }
    AddOwnRows(parts, head.own);
    head.targets.names = parts[0].names;
    const auto num_targets = std::ssize(head.targets.names);
    head.targets.offsets = Eigen::MatrixXf::Zero(3 * head.mesh.vertices.rows(), num_targets);
    size_t first = 0;
    for (const FilePart& part : parts) {
      if (!part.names.empty() && part.names != head.targets.names)
        file_.FailDamaged("its meshes have different targets");
      if (!part.names.empty()) {
        for (int n = 0; n < part.num_vertices(); ++n)
          head.targets.offsets.middleRows<3>(3 * result_.of_file_vertices[first + size_t(n)]) =
              part.offsets.middleRows<3>(3 * n);
      }
      result_.has_normals = result_.has_normals || part.has_normals;
      first += size_t(part.num_vertices());
    }
  }

  void AddEye(const Json& node) {
    std::vector<FilePart> parts = {PartOf(node)};
    if (node.contains("children"))
      for (const Json& child : node.at("children")) parts.push_back(PartOf(file_.Item("nodes", child)));
    rig::RiggedEye eye;
    eye.centre = TranslationOf(node);
    result_.of_eye_vertices.push_back(Weld(parts));
    eye.mesh = JoinedParts(parts, result_.of_eye_vertices.back());
    const auto num_triangles = size_t(eye.mesh.triangles.rows());
    auto stated = StatedTriangles(node, int64_t(num_triangles));
    eye.materials = stated ? std::move(stated->materials)
                           : std::vector<faces::HeadMaterial>(num_triangles, faces::HeadMaterial::kSclera);
    AddOwnRows(parts, eye.own);
    result_.head.eyes.push_back(std::move(eye));
  }

  void AddAttachment(const Json& node, const std::string& name) {
    const FilePart part = PartOf(node);
    if (part.colours.empty()) file_.FailDamaged(fmt::format("the part {} has no colours", name));
    std::vector<int> vertices(size_t(part.num_vertices()));
    std::iota(vertices.begin(), vertices.end(), 0);
    rig::HeadAttachment attachment{name, JoinedParts({part}, vertices), Eigen::MatrixXf(part.num_vertices(), 3)};
    for (size_t n = 0; n < part.colours.size(); ++n)
      for (size_t c = 0; c < 3; ++c)
        attachment.colours(Eigen::Index(n), Eigen::Index(c)) = SrgbFromLinear(part.colours[n][c]);
    result_.head.attachments.push_back(std::move(attachment));
  }

  GlbFile file_;
  HeadInFile result_;
  bool has_own_ = false;
  size_t num_vertices_ = 0;  ///< Of all parts.
  std::map<int64_t, int> own_rows_;
};

}  // namespace

HeadInFile ParseHead(std::string bytes, const std::string& name) {
  try {
    return HeadReading(std::move(bytes), name).Read();
  } catch (const Json::exception& error) {
    throw Error(
        fmt::format("{}: is damaged: {}. Write it again with `daumier rig` or `daumier avatar`", name, TextOf(error)));
  }
}

HeadInFile ReadHead(const std::filesystem::path& path) {
  return ParseHead(ReadFile(path), path.string());
}

}  // namespace daumier::gltf

#include "cli/rig_foreign.h"

#include "cli/head_cut.h"
#include "cli/own_look.h"
#include "cli/shipped_landmarks.h"
#include "core/error.h"
#include "core/log.h"
#include "core/process_task.h"
#include "datasets/build/registered_faces.h"
#include "geometry/submesh.h"
#include "geometry/triangulate.h"
#include "rig/foreign_head.h"
#include "rig/head_surface.h"
#include "systems/portrait/mesh_landmarks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestTurn = 25;        // Degrees: of a head that lies along axes.
constexpr double kLargestUnitRatio = 1.8;  // Between a head's size in a unit and the template's.
struct LengthUnit {
  const char* name;
  double cm;
};
constexpr std::array<LengthUnit, 3> kUnits = {{{"millimetres", 0.1}, {"centimetres", 1}, {"metres", 100}}};

/// The landmarks of a mesh with what the result says of them.
struct HeadLandmarks {
  datasets::MeshLandmarks places;
  datasets::ShiftedNumbers shifted;
  fs::path file;  ///< In messages.
  Json facts;
  std::vector<render::SheetCell> stages;
};

HeadLandmarks ReadHeadLandmarks(const fs::path& file, const geometry::Points& vertices) {
  const datasets::LandmarkFile landmarks(file);
  return {landmarks.On(vertices), landmarks.ShiftedOn(vertices), file, {{"source", file.string()}}, {}};
}

/// What `make` returns; its errors name the file.
template <class Make>
auto NamingFile(const fs::path& file, Make make) {
  try {
    return make();
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

HeadLandmarks FindHeadLandmarks(const fs::path& mesh_file, const geometry::TriangleMesh& mesh,
                                const faces::FaceTemplate& face_template) {
  const ShippedLandmarks shipped;
  portrait::MeshLandmarkSearch search = NamingFile(
      mesh_file, [&] { return portrait::FindMeshLandmarks({.surface = mesh}, face_template, shipped.detector()); });
  HeadLandmarks result;
  result.file = mesh_file;
  for (size_t l = 0; l < search.points.size(); ++l) result.places[l] = search.points[l].position;
  result.facts = {{"source", "pictures"},
                  {"confidence", search.confidence},
                  {"views", search.num_views},
                  {"seen_with", search.orientation.name}};
  result.stages.push_back({std::move(search.front), "landmarks"});
  return result;
}

/// Balls behind the eyes' landmarks are no surface that lids should lie on.
geometry::TriangleMesh WithoutEyeballs(const rig::HeadSurface& surface, const datasets::MeshLandmarks& landmarks) {
  constexpr std::array<int, 2> kFirstOfEyes = {36, 42};
  constexpr double kFarthest = 0.9, kLeastRadius = 0.3, kLargestRadius = 1.2;  // In widths of the eye.
  std::vector<std::vector<int>> places(size_t(surface.num_components()));
  for (int p = 0; p < surface.num_places(); ++p) places[size_t(surface.components[size_t(p)])].push_back(p);
  std::vector<int> kept;
  for (const std::vector<int>& part : places) {
    const auto is_eye = [&](int first) {
      const auto &right = landmarks[size_t(first)], &left = landmarks[size_t(first) + 3];
      if (!right || !left) return false;
      const double width = (*left - *right).norm();
      const geometry::Points points = surface.mesh.vertices(part, Eigen::all);
      if ((points.colwise().mean().transpose() - 0.5 * (*right + *left)).norm() > 2 * width) return false;
      const auto ball = rig::FitBall(points);
      return ball && (ball->centre - 0.5 * (*right + *left)).norm() < kFarthest * width &&
             ball->radius > kLeastRadius * width && ball->radius < kLargestRadius * width;
    };
    if (!std::ranges::any_of(kFirstOfEyes, is_eye)) kept.insert(kept.end(), part.begin(), part.end());
  }
  return geometry::Submesh(surface.mesh, geometry::MapKept(kept, surface.num_places()));
}

/// How a head's own axes and unit become cm, y up and the face to +z.
struct OwnFrame {
  Eigen::Matrix3d upright_from_mesh;
  double cm_per_unit;
  std::string axes, unit;
};

OwnFrame FrameOfHead(const geometry::Similarity& template_from_mesh) {
  OwnFrame frame;
  double least = std::numeric_limits<double>::infinity();
  for (const portrait::HeadOrientation& orientation : portrait::HeadOrientations()) {
    const double degrees =
        Eigen::AngleAxisd(template_from_mesh.rotation * orientation.upright_from_mesh.transpose()).angle() * 180 /
        std::numbers::pi;
    if (degrees >= least) continue;
    least = degrees;
    frame.upright_from_mesh = orientation.upright_from_mesh;
    frame.axes = orientation.name;
  }
  if (least > kLargestTurn) {
    frame.upright_from_mesh = template_from_mesh.rotation;
    frame.axes =
        fmt::format("the head lies across the axes, {:.0f} degrees from the nearest ones: turned upright", least);
  }
  const auto ratio = [&](const LengthUnit& unit) { return std::abs(std::log(template_from_mesh.scale / unit.cm)); };
  const LengthUnit& unit = *std::ranges::min_element(kUnits, {}, ratio);
  const bool is_known = ratio(unit) <= std::log(kLargestUnitRatio);
  frame.cm_per_unit = is_known ? unit.cm : template_from_mesh.scale;
  frame.unit = is_known ? unit.name
                        : fmt::format("unknown: scaled to the size of an adult's head, {:.4g} cm each",
                                      template_from_mesh.scale);
  return frame;
}

void TakeOwnLook(const OwnLook& look, rig::ForeignHead& head) {
  if (look.materials.empty()) return;
  head.head.own_materials = look.materials;
  auto row = head.triangles.begin();
  const auto take = [&](Eigen::Index count, std::vector<int>& own) {
    for (; count > 0; --count, ++row) own.push_back(look.of_triangles[size_t(*row)]);
  };
  take(head.head.mesh.triangles.rows(), head.head.own);
  for (rig::RiggedEye& eye : head.head.eyes) take(eye.mesh.triangles.rows(), eye.own);
}

Json AtRestJson(const rig::RestExpression& at_rest) {
  const auto rounded = [](double value) { return std::round(1000 * value) / 1000; };
  return {{"lip_gap", rounded(at_rest.lip_gap)},
          {"corner_rise", rounded(at_rest.corner_rise)},
          {"mouth_width", rounded(at_rest.mouth_width)}};
}

Json SlitsJson(const rig::HeadSlits& slits) {
  constexpr std::array<const char*, rig::kNumFaceSlits> kNames = {"mouth", "right_eye", "left_eye"};
  Json json = Json::object();
  for (size_t s = 0; s < slits.slits.size(); ++s) {
    const rig::HeadSlit& slit = slits.slits[s];
    json[kNames[s]] = !slit.is_found ? "not found" : slit.is_sealed ? "sealed" : "open";
  }
  return json;
}

}  // namespace

RiggedForeignHead RigForeignHead(const GivenFace& given, const fs::path& landmark_file, const faces::FaceModel& model,
                                 TakenLook look, SealedSlits sealed) {
  const std::string file = given.file.string();
  geometry::TriangleMesh mesh = geometry::TriangulateMesh(given.mesh);
  DAUMIER_CHECK(mesh.triangles.rows() > 0, "{} has no triangles: export its polygons, not its points alone", file);
  for (auto vertex : mesh.vertices.rowwise())  // Those that are not finite are in no triangle, and keep their numbers.
    if (!vertex.allFinite()) vertex = mesh.vertices.row(mesh.triangles(0, 0));
  const rig::HeadSurface surface = NamingFile(given.file, [&] { return rig::MakeHeadSurface(mesh); });
  OwnLook own_look = look == TakenLook::kOwn ? ReadOwnLook(given) : OwnLook();
  const auto check_stop = [&] { TaskOfProcess().ThrowIfCancelled("{}: stopped; nothing was written", file); };
  HeadLandmarks landmarks = landmark_file.empty() ? FindHeadLandmarks(given.file, mesh, model.face_template)
                                                  : ReadHeadLandmarks(landmark_file, given.mesh.vertices);
  check_stop();
  const datasets::RegisteredMesh registered =
      datasets::RegisterMesh(model.face_template, {.name = given.file.stem().string(),
                                                   .landmark_file = landmarks.file,
                                                   .mesh = WithoutEyeballs(surface, landmarks.places),
                                                   .landmarks = landmarks.places,
                                                   .shifted = landmarks.shifted});
  check_stop();
  if (registered.row.value("turned_inside_out", false)) {
    log::Warn("{}: the mesh is inside out; its triangles are turned", file);
    mesh.triangles.col(1).swap(mesh.triangles.col(2));
    if (mesh.has_uv()) mesh.uv_triangles.col(1).swap(mesh.uv_triangles.col(2));
  }
  const geometry::Similarity& to_template = registered.template_from_target;
  const OwnFrame frame = FrameOfHead(to_template);
  log::Info("{}: axes: {}; unit: {}", file, frame.axes, frame.unit);
  mesh.vertices = (frame.cm_per_unit * mesh.vertices * frame.upright_from_mesh.transpose()).eval();
  geometry::Similarity template_from_head = to_template;
  template_from_head.scale /= frame.cm_per_unit;
  template_from_head.rotation *= frame.upright_from_mesh.transpose();

  const rig::ForeignRig foreign_rig(model);
  for (const std::string& warning : foreign_rig.warnings()) log::Warn("{}", warning);
  const rig::RegisteredTemplate on_head{registered.vertices, template_from_head};
  std::optional<CutHead> cut;
  if (sealed == SealedSlits::kCut) {
    cut = CutOpen(foreign_rig, on_head, file, mesh, own_look);
    mesh = cut->mesh;
  }
  rig::ForeignHead head = foreign_rig.On(mesh, on_head);
  for (const std::string& warning : head.warnings) log::Warn("{}: {}", file, warning);
  check_stop();
  TakeOwnLook(own_look, head);
  if (cut) ColourPocket(cut->pocket, head);
  landmarks.facts["mm"] = registered.row.at("landmarks_mm");
  Json facts = {{"axes", frame.axes},
                {"unit", frame.unit},
                {"landmarks", std::move(landmarks.facts)},
                {"registration", registered.row},
                {"slits", SlitsJson(head.slits)},
                {"at_rest", AtRestJson(head.at_rest)}};
  facts["registration"].erase("name");
  if (cut) facts["cut"] = std::move(cut->facts);
  return {std::move(head.head), geometry::Inverse(template_from_head).Apply(registered.vertices),
          std::move(landmarks.stages), std::move(facts)};
}

CarriedTargets CarryTargetsTo(const faces::FaceTemplate& face, const faces::FaceModel& model) {
  const geometry::TriangleMesh mesh{face.neutral, face.triangles};
  const rig::HeadSurface surface = rig::MakeHeadSurface(mesh);
  datasets::MeshLandmarks landmarks;
  for (size_t l = 0; l < landmarks.size(); ++l)
    landmarks[l] = face.neutral.row(face.annotation.landmarks[l]).transpose();
  const datasets::RegisteredMesh registered =
      datasets::RegisterMesh(model.face_template, {.name = face.source,
                                                   .landmark_file = face.source,
                                                   .mesh = WithoutEyeballs(surface, landmarks),
                                                   .landmarks = landmarks,
                                                   .shifted = {}});
  TaskOfProcess().ThrowIfCancelled("{}: stopped; nothing was written", face.source);
  const rig::ForeignRig foreign_rig(model);
  rig::ForeignHead head = foreign_rig.On(mesh, {registered.vertices, registered.template_from_target});
  for (const rig::HeadSlit& slit : head.slits.slits)
    if (!slit.is_found || slit.is_sealed)
      log::Warn("{}: lips or lids of the model are sealed, or were not found: expressions of them are mapped roughly",
                face.source);
  CarriedTargets carried{std::move(head.head.targets), registered.row};
  carried.registration.erase("name");
  return carried;
}

}  // namespace daumier::cli

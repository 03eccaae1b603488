#include "rig/foreign_head.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/corner_uv.h"
#include "geometry/submesh.h"
#include "rig/arkit_names.h"
#include "rig/ball_clearance.h"
#include "rig/carry_targets.h"
#include "rig/jaw_clearance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace daumier::rig {
namespace {

constexpr double kPupilDegrees = 11, kIrisDegrees = 25;  // From the axis of gaze.

std::array<Ball, 2> BallsOf(const HeadRig& head_rig, const geometry::Points& registered) {
  std::array<Ball, 2> balls;
  const std::vector<faces::Eyeball> eyeballs = head_rig.Eyeballs(registered);
  for (size_t i = 0; i < balls.size() && i < eyeballs.size(); ++i)
    balls[i] = {eyeballs[i].centre, eyeballs[i].radii.x()};
  return balls;
}

bool MovesJaw(const std::string& target) {
  return target == "jawOpen" || target == "jawForward" || target == "jawLeft" || target == "jawRight" ||
         target == "tongueOut";
}

const char* NameOf(FaceSlit slit) {
  constexpr std::array<const char*, kNumFaceSlits> kNames = {"mouth", "right eye", "left eye"};
  return kNames[size_t(slit)];
}

void WarnOfSlits(const HeadSlits& slits, std::vector<std::string>& warnings) {
  for (int s = 0; s < kNumFaceSlits; ++s) {
    const HeadSlit& slit = slits.slits[size_t(s)];
    const char* name = NameOf(FaceSlit(s));
    if (!slit.is_found) {
      warnings.push_back(fmt::format(
          "no two sides of the {} were found: it cannot open or close. Compare the landmarks with the mesh", name));
    } else if (slit.is_sealed && s == int(FaceSlit::kMouth)) {
      warnings.push_back(fmt::format(
          "the lips are sealed (the surface continues from lip to lip in {:.1f} mm): expressions that open "
          "the mouth stretch the skin between them. Open them with --cut, or cut the mesh along the line of the lips",
          10 * slit.way));
    } else if (slit.is_sealed) {
      warnings.push_back(
          fmt::format("the {} is sealed (the surface continues from lid to lid in {:.1f} mm): a blink squashes what is "
                      "between the lids, and the eye cannot turn. Model the eye as a ball of its own behind open lids; "
                      "--cut opens lids that are closed",
                      name, 10 * slit.way));
    }
  }
}

faces::HeadMaterial MaterialOf(HeadPart part) {
  switch (part) {
    case HeadPart::kUpperMouth:
    case HeadPart::kLowerMouth:
    case HeadPart::kWholeMouth:
      return faces::HeadMaterial::kTooth;
    case HeadPart::kFlatEye:
    case HeadPart::kRightEye:
    case HeadPart::kLeftEye:
      return faces::HeadMaterial::kSclera;
    default:
      return faces::HeadMaterial::kSkin;
  }
}

/// By the direction from the ball's centre in which a triangle lies.
faces::HeadMaterial MaterialOfBall(const geometry::Vector3& direction) {
  const double degrees = std::acos(std::clamp(direction.normalized().z(), -1.0, 1.0)) * 180 / std::numbers::pi;
  if (degrees < kPupilDegrees) return faces::HeadMaterial::kPupil;
  return degrees < kIrisDegrees ? faces::HeadMaterial::kIris : faces::HeadMaterial::kSclera;
}

/// Some triangles of a mesh, with all of its vertices.
geometry::TriangleMesh WithTriangles(const geometry::TriangleMesh& mesh, const std::vector<int>& rows) {
  geometry::TriangleMesh part{mesh.vertices, mesh.triangles(rows, Eigen::all), mesh.uv, {}};
  part.uv_triangles.resize(0, 3);
  if (mesh.has_uv()) part.uv_triangles = mesh.uv_triangles(rows, Eigen::all);
  geometry::RemoveUnusedUv(part);
  return part;
}

RiggedEye EyeOfTriangles(const geometry::TriangleMesh& head, const std::vector<int>& rows,
                         const geometry::Vector3& centre) {
  RiggedEye eye;
  eye.centre = centre;
  eye.mesh = WithTriangles(head, rows);
  const std::vector<int> used(eye.mesh.triangles.data(), eye.mesh.triangles.data() + eye.mesh.triangles.size());
  eye.mesh = geometry::Submesh(eye.mesh, geometry::MapKept(used, int(head.vertices.rows())));
  eye.mesh.vertices.rowwise() -= centre.transpose();
  for (const auto& t : eye.mesh.triangles.rowwise())
    eye.materials.push_back(MaterialOfBall(
        (eye.mesh.vertices.row(t[0]) + eye.mesh.vertices.row(t[1]) + eye.mesh.vertices.row(t[2])).transpose()));
  return eye;
}

/// The mesh and eyes of a head whose parts are known.
void Assemble(const geometry::TriangleMesh& mesh, const HeadSurface& surface, const HeadParts& parts,
              const geometry::Similarity& head_from_template, ForeignHead& result) {
  std::vector<int> kept;
  std::array<std::vector<int>, 2> of_eyes;
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const int place = surface.places[size_t(mesh.triangles(f, 0))];
    const HeadPart part = place < 0 ? HeadPart::kSkin : parts.of_place(surface, place);
    if (part == HeadPart::kRightEye) {
      of_eyes[0].push_back(f);
    } else if (part == HeadPart::kLeftEye) {
      of_eyes[1].push_back(f);
    } else {
      kept.push_back(f);
      result.head.materials.push_back(MaterialOf(part));
    }
  }
  result.head.mesh = WithTriangles(mesh, kept);
  result.triangles = kept;
  if (!parts.eyes[0] || !parts.eyes[1]) return;
  for (size_t i = 0; i < 2; ++i) {
    const geometry::Points centre = parts.eyes[i]->centre.transpose();
    result.head.eyes.push_back(EyeOfTriangles(mesh, of_eyes[i], head_from_template.Apply(centre).row(0).transpose()));
    result.triangles.insert(result.triangles.end(), of_eyes[i].begin(), of_eyes[i].end());
  }
}

geometry::Vector3 Moved(const geometry::Similarity& similarity, const geometry::Vector3& point) {
  return similarity.scale * (similarity.rotation * point) + similarity.translation;
}

}  // namespace

ForeignRig::ForeignRig(const faces::FaceModel& model)
    : triangles_(model.face_template.triangles),
      targets_(model),
      head_rig_(model.face_template),
      interior_(model.face_template),
      landmarks_(model.face_template.annotation.landmarks),
      slits_(SlitsOf(targets_.contact())),
      sides_(SidesOfTemplate({model.face_template.neutral, model.face_template.triangles}, slits_)) {}

Eigen::MatrixXf ForeignRig::OffsetsOfPlaces(const HeadSurface& surface, const HeadParts& parts,
                                            const TemplateMatch& match, const HeadSlits& slits,
                                            const geometry::Points& registered, const MorphTargets& targets) const {
  Eigen::MatrixXf offsets = CarryTargets(match, surface, parts, slits.sides, targets.offsets);
  using Flat = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  const JawClearance clearance(surface, parts, match);
  for (Eigen::Index t = 0; t < targets.num_targets(); ++t) {
    if (!MovesJaw(targets.names[size_t(t)])) continue;
    const geometry::Points pose = registered + Flat(targets.offsets.col(t).data(), registered.rows(), 3).cast<double>();
    const Eigen::Isometry3d jaw = interior_.JawMotion(registered, pose);
    const geometry::Vector3 back(0, 0, -clearance.PushOf(jaw, offsets.col(t)));
    for (int p = 0; p < surface.num_places(); ++p) {
      const float share = parts.jaw_shares[size_t(p)];
      if (share == 0) continue;
      const geometry::Vector3 place = surface.mesh.vertices.row(p);
      offsets.col(t).segment<3>(3 * Eigen::Index(p)) = share * (jaw * (place + back) - place).cast<float>();
    }
  }
  for (size_t i = 0; i < parts.eyes.size(); ++i)
    if (parts.eyes[i])
      KeepOutsideBall(*parts.eyes[i], i == 0 ? FaceSlit::kRightEye : FaceSlit::kLeftEye, surface, slits.sides, offsets);
  return offsets;
}

OpenedHead ForeignRig::Open(const geometry::TriangleMesh& head, const RegisteredTemplate& registered) const {
  geometry::TriangleMesh in_template = head;
  in_template.vertices = registered.template_from_head.Apply(head.vertices);
  const HeadSurface surface = MakeHeadSurface(in_template);
  const TemplateMatch match({registered.vertices, triangles_}, slits_, sides_);
  const HeadParts parts = FindHeadParts(match, surface, BallsOf(head_rig_, registered.vertices));
  OpenedHead opened = OpenSealedSlits(match, surface, parts, FindHeadSlits(match, surface), in_template);
  const geometry::Similarity back = geometry::Inverse(registered.template_from_head);
  opened.mesh.vertices = back.Apply(opened.mesh.vertices);
  opened.mesh.vertices.topRows(head.vertices.rows()) = head.vertices;
  for (double& length : opened.lengths) length *= back.scale;
  return opened;
}

ForeignHead ForeignRig::On(const geometry::TriangleMesh& head, const RegisteredTemplate& registered) const {
  geometry::TriangleMesh in_template = head;
  in_template.vertices = registered.template_from_head.Apply(head.vertices);
  const HeadSurface surface = MakeHeadSurface(in_template);
  const TemplateMatch match({registered.vertices, triangles_}, slits_, sides_);
  const HeadParts parts = FindHeadParts(match, surface, BallsOf(head_rig_, registered.vertices));
  ForeignHead result;
  result.slits = FindHeadSlits(match, surface);
  const MorphTargets targets = targets_.On(registered.vertices);
  const Eigen::MatrixXf of_places = OffsetsOfPlaces(surface, parts, match, result.slits, registered.vertices, targets);

  const geometry::Similarity back = geometry::Inverse(registered.template_from_head);
  const Eigen::Matrix3f linear = (back.scale * back.rotation).cast<float>();
  result.head.targets = {targets.names, OffsetsOfVertices(surface, of_places)};
  Eigen::MatrixXf& offsets = result.head.targets.offsets;
  OnAllCores(offsets.cols(), [&](int64_t t) {
    Eigen::Map<Eigen::Matrix3Xf> columns(offsets.col(t).data(), 3, offsets.rows() / 3);
    columns = (linear * columns).eval();
  });
  Assemble(head, surface, parts, back, result);
  for (const int place : surface.places)
    result.sides.push_back(place < 0 ? FaceSide::kNone : result.slits.sides[size_t(place)]);

  const RiggedHead own = head_rig_.On(registered.vertices, targets);
  result.head.head_pivot = Moved(back, own.head_pivot);
  result.head.jaw_pivot = Moved(back, own.jaw_pivot);
  result.head.source = own.source;
  result.head.licence = own.licence;
  WarnOfSlits(result.slits, result.warnings);
  result.at_rest = MeasureRest(registered.vertices, landmarks_);
  for (std::string& warning : WarningsOf(result.at_rest)) result.warnings.push_back(std::move(warning));
  if (result.head.eyes.empty())
    result.warnings.push_back(
        "no eyeballs were found (expected two balls behind the lids, each a part of its own): eyes do not turn");
  if (std::ranges::all_of(parts.jaw_shares, [](float share) { return share == 0; }))
    result.warnings.push_back("no lower teeth or tongue were found: nothing behind the lips follows the jaw");
  return result;
}

}  // namespace daumier::rig

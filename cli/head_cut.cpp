#include "cli/head_cut.h"

#include "core/log.h"

#include <algorithm>
#include <array>

namespace daumier::cli {
namespace {

constexpr std::array<float, 3> kPocketColour = {0.15f, 0.022f, 0.022f};  // Linear light.
constexpr double kMostWidths = 1.5;
struct SlitName {
  const char *key, *words;
};
constexpr std::array<SlitName, rig::kNumFaceSlits> kSlitNames = {
    {{"mouth", "lips"}, {"right_eye", "lids of the right eye"}, {"left_eye", "lids of the left eye"}}};

/// What the result says of a slit; logs it.
Json SlitFacts(const rig::OpenedHead& opened, size_t s, const std::string& file) {
  switch (opened.slits[s]) {
    case rig::SlitCut::kNotSealed:
      return "not sealed";
    case rig::SlitCut::kOpenEye:
      log::Warn("{}: the {} are open, the eye is part of the skin: it was not cut", file, kSlitNames[s].words);
      return "an open eye in the skin";
    case rig::SlitCut::kNoLine:
      log::Warn("{}: the line of the {} does not cross the mesh: it was not cut", file, kSlitNames[s].words);
      return "no line";
    case rig::SlitCut::kCut:
      break;
  }
  const double length_mm = 10 * opened.lengths[s];
  log::Info("{}: the {} were sealed and are cut open, {:.1f} mm", file, kSlitNames[s].words, length_mm);
  if (opened.lengths[s] > kMostWidths * opened.widths[s])
    log::Warn(
        "{}: the cut of the {} is {:.1f} times as long as they are wide: it meanders, and rags may remain. Clean the "
        "mesh "
        "there in a modelling program, or cut it by hand",
        file, kSlitNames[s].words, opened.lengths[s] / opened.widths[s]);
  return {{"length_mm", length_mm}};
}

/// Materials of pieces are those of their triangles.
void TakeMaterials(const std::vector<int>& sources, OwnLook& look) {
  if (look.materials.empty()) return;
  std::vector<int> of_triangles;
  for (const int source : sources)
    of_triangles.push_back(source < 0 ? int(look.materials.size()) : look.of_triangles[size_t(source)]);
  look.of_triangles = std::move(of_triangles);
  if (std::ranges::find(sources, -1) != sources.end()) look.materials.push_back({"mouth", kPocketColour, 1, nullptr});
}

}  // namespace

CutHead CutOpen(const rig::ForeignRig& rig, const rig::RegisteredTemplate& registered, const std::string& file,
                const geometry::TriangleMesh& mesh, OwnLook& look) {
  rig::OpenedHead opened = rig.Open(mesh, registered);
  CutHead cut;
  const auto pocket = std::ranges::find(opened.sources, -1);
  cut.pocket = pocket - opened.sources.begin();
  cut.facts = {{"vertices", opened.num_cut_vertices},
               {"pocket_vertices", opened.mesh.vertices.rows() - mesh.vertices.rows() - opened.num_cut_vertices}};
  for (size_t s = 0; s < opened.slits.size(); ++s) cut.facts[kSlitNames[s].key] = SlitFacts(opened, s, file);
  if (std::ranges::find(opened.slits, rig::SlitCut::kCut) == opened.slits.end())
    log::Warn("{}: --cut: nothing was cut", file);
  TakeMaterials(opened.sources, look);
  cut.mesh = std::move(opened.mesh);
  return cut;
}

void ColourPocket(Eigen::Index pocket, rig::ForeignHead& head) {
  for (size_t t = 0; t < head.head.materials.size(); ++t)
    if (head.triangles[t] >= pocket) head.head.materials[t] = faces::HeadMaterial::kMouth;
}

}  // namespace daumier::cli

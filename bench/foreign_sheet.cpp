// Heads of any topology at five expressions, a row a head:
//   foreign_sheet OUT.png PIXELS HEAD.glb...
// HEAD.glb: of `daumier rig` with the names of arkit. Each picture shows what blinks and the opening jaw move, slightly from the
// side. Pictures of heads whose licence forbids it are not to be passed on.
#include "core/error.h"
#include "gltf/head_reader.h"
#include "render/camera.h"
#include "render/sheet.h"
#include "reports/rigged_head.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace daumier {
namespace {

using Weights = std::initializer_list<std::pair<std::string_view, float>>;

/// Of what a target moves by more than a tenth of its peak: least and greatest coordinates.
void AddMoved(const rig::RiggedHead& head, std::string_view target, Eigen::AlignedBox3d& box) {
  const auto& names = head.targets.names;
  const auto found = std::ranges::find(names, target);
  if (found == names.end()) throw Error(fmt::format("a head has no target {}", target));
  const auto offsets = head.targets.offsets.col(found - names.begin());
  const Eigen::Map<const Eigen::Matrix3Xf> moves(offsets.data(), 3, offsets.size() / 3);
  const Eigen::VectorXf lengths = moves.colwise().norm();
  for (Eigen::Index v = 0; v < lengths.size(); ++v)
    if (lengths[v] > 0.1f * lengths.maxCoeff()) box.extend(head.mesh.vertices.row(v).transpose());
}

int Run(const std::vector<std::string>& words) {
  if (words.size() < 3) throw UsageError("foreign_sheet OUT.png PIXELS HEAD.glb...");
  const int size = std::stoi(words[1]);
  std::vector<render::SheetCell> cells;
  std::vector<std::string> titles;
  for (size_t i = 2; i < words.size(); ++i) {
    const gltf::HeadInFile file = gltf::ReadHead(words[i]);
    const reports::RiggedHeadPictures pictures(file.head, file.texture);
    Eigen::AlignedBox3d box;
    for (const char* target : {"eyeBlinkLeft", "eyeBlinkRight", "jawOpen", "browInnerUp"})
      AddMoved(file.head, target, box);
    const geometry::Vector3 centre = box.center();
    const render::Camera camera = render::TurnedCamera(centre, 0.55 * box.sizes().head<2>().maxCoeff(), size, 15);
    const auto add = [&](const char* caption, Weights weights) {
      cells.push_back({pictures.Draw(rig::PoseNamed(file.head.targets.names, weights), camera), caption});
    };
    add("neutral", {});
    add("jawOpen", {{"jawOpen", 1.0F}});
    add("mouthSmile", {{"mouthSmileLeft", 1.0F}, {"mouthSmileRight", 1.0F}});
    add("eyeBlink", {{"eyeBlinkLeft", 1.0F}, {"eyeBlinkRight", 1.0F}});
    add("mouthPucker", {{"mouthPucker", 1.0F}});
    titles.push_back(std::filesystem::path(words[i]).stem().string());
  }
  render::WriteImage(words[0], render::MakeSheet(cells, 5, {.row_titles = titles}));
  return 0;
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  try {
    return daumier::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

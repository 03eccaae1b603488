#include "cli/head_extras.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "geometry/stl.h"
#include "rig/arkit_names.h"
#include "rig/decimated_head.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrintHeader = "Daumier head, millimetres, z up, base at z = 0";

double Rounded(double value) {
  return std::round(10 * value) / 10;
}

}  // namespace

void AddHeadExtras(CLI::App& command, HeadExtras& extras) {
  command
      .add_option("--triangles", extras.triangles,
                  "Fewer triangles, for games and AR: at most this number in the .glb and .vrm, eyes and teeth among "
                  "them. Chosen over all expressions, so that their peaks are kept; the remaining vertices, UV and "
                  "materials are those of the full head")
      ->check(CLI::Range(kLeastTriangles, std::numeric_limits<int>::max()));
  command.add_flag("--print", extras.print,
                   "Write NAME.stl as well, for 3D printers: closed surfaces with all triangles, in millimetres, z up, "
                   "a flat base at z = 0");
  command.add_option("--print-pose", extras.print_pose,
                     "TARGET=WEIGHT: the expression of the print, for example mouthSmileLeft=1; may be repeated. "
                     "Writes NAME.stl as --print does");
}

std::optional<fs::path> PrintFileOf(const HeadExtras& extras, const fs::path& head) {
  if (!extras.print && extras.print_pose.empty()) return std::nullopt;
  return head.parent_path() / (head.stem().string() + ".stl");
}

bool IsOwnPrint(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  const MappedFile mapped(file);
  return mapped.bytes().starts_with(kPrintHeader);
}

rig::PrintPose PrintPoseOf(const HeadExtras& extras) {
  rig::PrintPose pose;
  for (const std::string& word : extras.print_pose) {
    const size_t equals = word.find('=');
    const auto target = rig::FindArkitName(word.substr(0, equals));
    float weight = -1;
    if (equals != std::string::npos) {
      const char *const begin = word.data() + equals + 1, *const end = word.data() + word.size();
      const auto parsed = std::from_chars(begin, end, weight);
      if (parsed.ec != std::errc() || parsed.ptr != end) weight = -1;
    }
    if (!target || !(weight >= 0 && weight <= 1))
      throw UsageError(
          fmt::format("--print-pose {}: expected TARGET=WEIGHT with one of the 52 names (jawOpen, "
                      "mouthSmileLeft, ...) and a weight from 0 to 1",
                      word));
    pose.emplace_back(rig::ArkitNames()[size_t(*target)], weight);
  }
  return pose;
}

Json WritePrint(const fs::path& file, const rig::RiggedHead& head, const rig::PrintPose& pose) {
  const rig::PrintedHead print = rig::MakePrintedHead(head, pose);
  for (const std::string& warning : print.warnings) log::Warn("{}: {}", file.string(), warning);
  WriteFileAtomically(file, geometry::EncodeStl(print.mesh, kPrintHeader));
  const geometry::Vector3 size = print.SizeMm();
  return {{"file", file.string()},
          {"size_mm", {Rounded(size.x()), Rounded(size.y()), Rounded(size.z())}},
          {"triangles", print.mesh.triangles.rows()},
          {"closed_surfaces", print.num_shells},
          {"holes_closed", print.num_holes},
          {"thin_parts_left_out", print.num_thin},
          {"volume_cm3", Rounded(print.volume_cm3)},
          {"lies_on", print.faces_up ? "its back" : "its neck"}};
}

Json ReduceTriangles(const HeadExtras& extras, rig::RiggedHead& head) {
  rig::DecimatedHead fewer = rig::Decimated(head, *extras.triangles);
  if (!fewer.is_reached)
    log::Warn(
        "--triangles {}: {} triangles are left. No more vertices can be removed without tearing borders of materials, "
        "seams of UV or open edges, or folding the surface over in an expression",
        *extras.triangles, fewer.num_triangles);
  head = std::move(fewer.head);
  Json result = {{"before", fewer.num_triangles_before},
                 {"after", fewer.num_triangles},
                 {"greatest_peak_loss_percent", Rounded(100 * fewer.greatest_peak_loss)}};
  if (fewer.num_triangles_before <= *extras.triangles)
    result["remark"] =
        fmt::format("the head has no more triangles than --triangles {} and is kept as it is", *extras.triangles);
  if (!fewer.worst_target.empty()) result["worst_target"] = fewer.worst_target;
  return result;
}

}  // namespace daumier::cli

#include "fuzz/targets.h"

#include "core/error.h"
#include "core/files.h"
#include "core/safetensors.h"
#include "faces/annotation_file.h"
#include "faces/import/mat_file.h"
#include "faces/import/mesh_folder.h"
#include "faces/import/npy.h"
#include "faces/import/torch_file.h"
#include "faces/marked_points.h"
#include "gltf/head_reader.h"
#include "render/read_drawing.h"
#include "rig/clip_files.h"
#include "rig/coefficient_file.h"
#include "rig/expression_map_file.h"
#include "rig/live_link_packet.h"
#include "runtime/graph_runner.h"
#include "runtime/onnx_file.h"

#include <fmt/ranges.h>

#include <cstdlib>
#include <fstream>
#include <vector>

namespace daumier::fuzz {
namespace {

void ReadDrawing(const std::filesystem::path& path) {
  render::ReadDrawings(path);
}
void ReadMeshFile(const std::filesystem::path& path) {
  faces::ReadMesh(path);
}

void ReadClipFile(const std::filesystem::path& path) {
  rig::Resample(rig::ReadClip(path), 60);
}

void ReadCoefficientFile(const std::filesystem::path& path) {
  rig::ExpressionMap map;
  map.expressions = {"mode_00", "mode_01", "mode_02"};
  map.constant = 2;
  rig::ReadCoefficients(path, map);
}

/// Runs the graph on zeros, if it is a small one.
void RunGraph(const std::filesystem::path& path) {
  constexpr int64_t kMostNumbers = 4096, kMostBytes = 1 << 24;
  const runtime::Graph graph = runtime::ReadOnnx(path);
  NamedArrays inputs;
  for (const runtime::GraphInput& input : graph.inputs) {
    std::vector<int64_t> shape = input.shape;
    for (int64_t& size : shape) size = size == -1 ? 1 : size;
    if (runtime::CheckedSize(shape, input.name) > kMostNumbers) return;
    inputs[input.name] = FloatArray(shape);
  }
  const runtime::GraphRunner runner(graph);
  if (runner.BytesFor(inputs) <= kMostBytes) runner.Run(inputs);
}

constexpr Target kTargets[] = {
    {"svg", "a.svg", ReadDrawing},
    {"quickdraw", "a.ndjson", ReadDrawing},
    {"xournal", "a.xopp", ReadDrawing},
    {"inkml", "a.inkml", ReadDrawing},
    {"picture", "a.png", ReadDrawing},
    {"jpeg", "a.jpg", ReadDrawing},
    {"obj", "a.obj", ReadMeshFile},
    {"ply", "a.ply", ReadMeshFile},
    {"landmarks", "a.txt", [](const std::filesystem::path& path) { faces::ReadMarkedPoints(path); }},
    {"npz", "a.npz", [](const std::filesystem::path& path) { faces::ReadNpz(path, {"a"}); }},
    {"mat", "a.mat", [](const std::filesystem::path& path) { faces::ReadMatFile(path, {"a"}); }},
    {"torch", "a.pth", [](const std::filesystem::path& path) { faces::ReadTorchState(path); }},
    {"safetensors", "a.safetensors", [](const std::filesystem::path& path) { SafetensorsFile{path}; }},
    {"onnx", "a.onnx", RunGraph},
    {"annotation", "a.json",
     [](const std::filesystem::path& path) { faces::ParseAnnotationFile(ReadFile(path), "annotation"); }},
    {"clip_csv", "a.csv", ReadClipFile},
    {"clip_json", "a.json", ReadClipFile},
    {"live_link", "a.bin", [](const std::filesystem::path& path) { rig::ParseLiveLinkPacket(ReadFile(path)); }},
    {"coefficients", "a.csv", ReadCoefficientFile},
    {"expression_map", "a.json",
     [](const std::filesystem::path& path) { rig::ParseExpressionMap(ReadJson(path), "map"); }},
    {"head", "a.glb", [](const std::filesystem::path& path) { gltf::ReadHead(path); }},
};

}  // namespace

std::span<const Target> Targets() {
  return kTargets;
}

const Target& FindTarget(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Target& target : kTargets) {
    if (target.name == name) return target;
    names.push_back(target.name);
  }
  throw UsageError(fmt::format("there is no fuzz target '{}' (expected one of {})", name, fmt::join(names, ", ")));
}

void ReadBytes(const Target& target, std::string_view bytes, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / target.file;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  try {
    target.read(path);
  } catch (const Error&) {
  }
}

}  // namespace daumier::fuzz

/// The entry of libFuzzer [llvm.org/docs/LibFuzzer.html]: the environment names the target and a folder for the file.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const char* const name = std::getenv("DAUMIER_FUZZ_TARGET");
  static const char* const folder = std::getenv("DAUMIER_FUZZ_FOLDER");
  if (name == nullptr || folder == nullptr) throw daumier::UsageError("start this program by ./dev fuzz NAME");
  static const daumier::fuzz::Target& target = daumier::fuzz::FindTarget(name);
  daumier::fuzz::ReadBytes(target, {reinterpret_cast<const char*>(data), size}, folder);
  return 0;
}

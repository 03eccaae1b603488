// Faces edited by codes, side by side in one run: the face model, a linear run, a hypernetwork, and as-rigid-as-possible
// deformation as the rival for handles.
//   edit_bench [MODEL...] [--benchmark_...]     MODEL: runs of the task `deform`, folders of faces
// Without models the linear run is 128 rows of the face model, and the hypernetwork one of the printed sizes with random
// parameters: the times are those of trained ones as far as these take as many steps.
#include "core/error.h"
#include "core/random.h"
#include "core/safetensors.h"
#include "faces/face_model_file.h"
#include "fitting/code_handles.h"
#include "fitting/code_landmarks.h"
#include "fitting/mesh_code.h"
#include "geometry/arap.h"
#include "systems/deform/edit_points.h"
#include "systems/deform/linear_code_model.h"
#include "systems/deform/network_code_model.h"
#include "systems/deform/open_code_model.h"

#include <benchmark/benchmark.h>
#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;
using fitting::CodeModel;

struct Subject {
  std::string name;
  std::unique_ptr<const CodeModel> model;
  std::vector<int> expression = {};
};

/// A face of the model, its expression left out.
Eigen::VectorXd SomeCode(const Subject& subject, uint64_t seed) {
  Rng rng(seed);
  Eigen::VectorXd code(subject.model->num_numbers());
  for (double& number : code) number = 0.5 * rng.Normal();
  for (const int number : subject.expression) code[number] = 0;
  return code;
}

/// Arrays of a hypernetwork of the printed sizes on this template: a usual code moves vertices by millimetres, and
/// biases decide which neurons act more than codes do, as where it begins to train.
void WriteRandomHypernetwork(const faces::FaceTemplate& face_template, const DeformOptions& options,
                             const fs::path& file) {
  Rng rng(1);
  SafetensorsWriter writer;
  const auto add = [&](const std::string& name, const std::vector<int64_t>& shape, double deviation) {
    std::vector<float> numbers(size_t(shape[0] * (shape.size() > 1 ? shape[1] : 1)));
    for (float& number : numbers) number = float(deviation * rng.Normal());
    writer.Add<float>(name, shape, numbers);
  };
  const int64_t num_vertices = face_template.num_vertices();
  std::vector<float> vertices;
  for (const double x : face_template.neutral.reshaped<Eigen::RowMajor>()) vertices.push_back(float(0.1 * x));
  writer.Add<float>("network.template_vertices", {num_vertices, 3}, vertices);
  writer.Add<double>("network.model_from_cm", {4}, std::vector<double>{0.1, 0, 0, 0});
  add("codes", {400, options.latent}, 1);
  const runtime::SirenLayout siren = options.siren();
  const int hidden = options.hyper_width;
  for (int layer = 0; layer < siren.num_layers(); ++layer) {
    const bool is_last = layer + 1 == siren.num_layers();
    for (const bool is_bias : {false, true}) {
      const std::string name = fmt::format("network.{}_{}", is_bias ? "biases" : "weights", layer);
      const int64_t outputs = siren.outputs(layer) * (is_bias ? 1 : siren.inputs(layer));
      // The SIREN's own numbers, and how much a code of usual length changes them: its last layer most.
      const double size = is_last ? 1e-2 : layer == 0 ? 0.1 : std::sqrt(2.0 / siren.width) / siren.omega;
      const double change = is_last ? 5e-4 : 0.015 * size / std::sqrt(hidden);
      add(name + ".first.weight", {hidden, options.latent}, std::sqrt(2.0 / options.latent));
      add(name + ".first.bias", {hidden}, 1.5);
      add(name + ".second.weight", {hidden, hidden}, std::sqrt(2.0 / hidden));
      add(name + ".second.bias", {hidden}, 1);
      add(name + ".last.weight", {outputs, hidden}, is_bias ? 0.1 * change : change);
      add(name + ".last.bias", {outputs}, is_bias ? 0.1 * size : size);
    }
  }
  writer.Write(file);
}

Subject RandomHypernetwork(const faces::FaceTemplate& face_template) {
  const DeformOptions options;
  const fs::path file = fs::temp_directory_path() / fmt::format("edit_bench_{}.safetensors", getpid());
  WriteRandomHypernetwork(face_template, options, file);
  Subject subject{"random hypernetwork", std::make_unique<NetworkCodeModel>(face_template, options, file)};
  fs::remove(file);
  return subject;
}

Subject Opened(const fs::path& folder) {
  OpenedModel opened = OpenCodeModel(folder);
  return {opened.kind, std::move(opened.model), std::move(opened.expression)};
}

void Decode(benchmark::State& state, const Subject& subject) {
  const Eigen::VectorXd codes[2] = {SomeCode(subject, 1), SomeCode(subject, 2)};
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(subject.model->Vertices(codes[++i % 2]));
}

void Derivative(benchmark::State& state, const Subject& subject) {
  const Eigen::VectorXd code = SomeCode(subject, 1);
  std::vector<int> vertices(500);
  std::iota(vertices.begin(), vertices.end(), 0);
  for (auto _ : state) benchmark::DoNotOptimize(subject.model->Derivative(code, vertices));
}

void MeshToCode(benchmark::State& state, const Subject& subject) {
  const geometry::Points target = subject.model->Vertices(SomeCode(subject, 3));
  fitting::MeshCode found;
  for (auto _ : state) found = fitting::CodeOfMesh(*subject.model, target);
  state.counters["mm"] = 10 * found.mean_error_cm;
  state.counters["steps"] = double(found.energies.size() - 1);
}

/// 68 landmarks of another face of the model, turned by 20 degrees, each off by about a pixel.
void Landmarks(benchmark::State& state, const Subject& subject) {
  const fitting::ContourPaths contour(subject.model->face_template());
  const fitting::ScaledView view{.scale = 12,
                                 .rotation = Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitY()).toRotationMatrix(),
                                 .shift = {200, 200}};
  fitting::PicturePoints pixels = fitting::ShownLandmarks(*subject.model, contour, SomeCode(subject, 4), view);
  Rng rng(5);
  for (double& x : pixels.reshaped()) x += rng.Normal();
  const auto points = fitting::PicturedLandmarks(subject.model->face_template(), pixels);
  fitting::CodeLandmarkFit fit;
  for (auto _ : state) fit = fitting::FitCodeToLandmarks(*subject.model, contour, points);
  state.counters["rounds"] = fit.rounds;
  state.counters["%"] = 100 * fit.distances_px.mean() / fit.eye_distance_px;
}

struct HandleCase {
  std::string preset;
  bool is_local;
};

fitting::HandleEditor EditorOf(const Subject& subject, const HandleCase& edit, const EditHandles& handles) {
  fitting::HandleOptions options{.fixed = subject.expression};
  if (edit.is_local) options.outside = OutsideOfPart(subject.model->face_template(), handles);
  return {*subject.model, Eigen::VectorXd::Zero(subject.model->num_numbers()), handles.points, options};
}

void HandleSetUp(benchmark::State& state, const Subject& subject, const HandleCase& edit) {
  const EditHandles handles = PresetHandles(subject.model->face_template(), edit.preset, 1);
  for (auto _ : state) benchmark::DoNotOptimize(EditorOf(subject, edit, handles));
}

/// To and fro between 0.5 and 1.5 cm by a millimetre a step, all vertices decoded.
void Drag(benchmark::State& state, const Subject& subject, const HandleCase& edit) {
  const EditHandles handles = PresetHandles(subject.model->face_template(), edit.preset, 1);
  fitting::HandleEditor editor = EditorOf(subject, edit, handles);
  const auto move = [&](int step) {
    const int phase = step % 20;
    return editor.MoveBy((0.5 + 0.1 * (phase < 10 ? phase : 20 - phase)) * handles.displacements);
  };
  move(0);
  double residual = 0, outside = 0;
  int step = 0;
  for (auto _ : state) {
    const fitting::HandleEdit moved = move(++step);
    benchmark::DoNotOptimize(subject.model->Vertices(moved.code));
    residual = std::max(residual, moved.residual_share);
    outside = std::max(outside, moved.outside_share);
  }
  state.counters["residual %"] = 100 * residual;
  state.counters["outside %"] = 100 * outside;
}

/// The mean face with what a local edit holds, as `daumier edit --local --arap` fixes it.
struct ArapCase {
  ArapCase(const faces::FaceTemplate& face_template, const std::string& preset)
      : mesh{face_template.neutral, face_template.triangles}, handles(PresetHandles(face_template, preset, 1)) {
    ids = handles.points;
    const std::vector<int> outside = OutsideOfPart(face_template, handles);
    ids.insert(ids.end(), outside.begin(), outside.end());
  }
  geometry::Points Targets(double share) const {
    geometry::Points targets = mesh.vertices(ids, Eigen::all);
    targets.topRows(std::ssize(handles.points)) += share * handles.displacements;
    return targets;
  }
  geometry::TriangleMesh mesh;
  EditHandles handles;
  std::vector<int> ids;
};

void ArapSetUp(benchmark::State& state, const Subject& subject, const std::string& preset) {
  const ArapCase edit(subject.model->face_template(), preset);
  for (auto _ : state) benchmark::DoNotOptimize(geometry::ArapDeformer(edit.mesh, edit.ids));
}

void ArapDrag(benchmark::State& state, const Subject& subject, const std::string& preset) {
  const ArapCase edit(subject.model->face_template(), preset);
  const geometry::ArapDeformer deformer(edit.mesh, edit.ids);
  geometry::Points last = deformer.Solve(edit.Targets(0.5)).vertices;
  int step = 0;
  for (auto _ : state) {
    const int phase = ++step % 20;
    last = deformer.Solve(edit.Targets(0.5 + 0.1 * (phase < 10 ? phase : 20 - phase)), 20, last).vertices;
  }
}

template <class... Arguments>
void Register(const std::string& name, Arguments&&... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), std::forward<Arguments>(arguments)...)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void RegisterAll(const std::vector<Subject>& subjects) {
  for (const Subject& subject : subjects) {
    const auto add = [&](const std::string& what, auto work) {
      Register(what + "/" + subject.name, [work, &subject](benchmark::State& state) { work(state, subject); });
    };
    add("decode", Decode);
    add("derivative of 500 points", Derivative);
    add("mesh to code", MeshToCode);
    add("68 landmarks", Landmarks);
    for (const HandleCase& edit : std::vector<HandleCase>{{"nose", false}, {"cheeks", false}, {"nose", true}}) {
      const std::string name = edit.preset + (edit.is_local ? ", local" : "");
      add("set-up, " + name, [edit](benchmark::State& state, const Subject& of) { HandleSetUp(state, of, edit); });
      add("drag, " + name, [edit](benchmark::State& state, const Subject& of) { Drag(state, of, edit); });
    }
  }
  Register("set-up, nose, local/ARAP", [&](benchmark::State& state) { ArapSetUp(state, subjects.front(), "nose"); });
  Register("drag, nose, local/ARAP", [&](benchmark::State& state) { ArapDrag(state, subjects.front(), "nose"); });
}

void Run(const std::vector<fs::path>& folders) {
  std::vector<Subject> subjects;
  subjects.push_back(Opened(ShippedModel()));
  for (const fs::path& folder : folders) subjects.push_back(Opened(folder));
  if (folders.empty()) {
    const faces::FaceModel face_model = faces::ReadFaceModelWeights(ShippedModel());
    LinearFaces rows = LinearCaricatures(face_model);
    rows.rows = rows.rows.topRows(128).eval();
    subjects.push_back({"linear run", std::make_unique<LinearCodeModel>(std::move(rows))});
    subjects.push_back(RandomHypernetwork(face_model.face_template));
  }
  RegisterAll(subjects);
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace
}  // namespace daumier::deform

int main(int argc, char** argv) {
  try {
    benchmark::Initialize(&argc, argv);
    daumier::deform::Run({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "edit_bench: {}\n", error.what());
    return 1;
  }
}

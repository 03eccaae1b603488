#include "systems/deform/authors_model.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "faces/import/torch_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

using TensorShape = std::vector<int64_t>;

constexpr const char* kCodes = "latent_codes.weight";

std::string BranchName(int branch, int layer, const char* part) {
  return fmt::format("hyper_net.nets.{}.net.{}.0.{}", branch, layer, part);
}

std::string ShapeText(const TensorShape& shape) {
  return fmt::format("({})", fmt::join(shape, ", "));
}

/// Takes tensors by name, and keeps account of them.
class TensorTaker {
 public:
  TensorTaker(const NamedArrays& tensors, const std::string& file) : tensors_(tensors), file_(file) {}

  bool Has(const std::string& name) const { return tensors_.contains(name); }

  /// A tensor of `dimensions` sizes, from which other shapes follow. expected: how its shape is written.
  const TensorShape& ShapeOf(const std::string& name, size_t dimensions, const char* expected) const {
    const auto found = tensors_.find(name);
    DAUMIER_CHECK(found != tensors_.end(),
                  "{}: there is no tensor '{}' (expected one of shape {}): this is no checkpoint of the deformable "
                  "model of Jung et al. Its tensors: {}",
                  file_, name, expected, fmt::join(FirstNames(), ", "));
    const TensorShape& shape = found->second.shape;
    DAUMIER_CHECK(shape.size() == dimensions, "{}: the tensor '{}' has the shape {}, expected {}", file_, name,
                  ShapeText(shape), expected);
    return shape;
  }

  const FloatArray& Take(const std::string& name, const TensorShape& shape) {
    const auto found = tensors_.find(name);
    DAUMIER_CHECK(found != tensors_.end(), "{}: there is no tensor '{}' (expected one of shape {})", file_, name,
                  ShapeText(shape));
    DAUMIER_CHECK(found->second.shape == shape, "{}: the tensor '{}' has the shape {}, expected {}", file_, name,
                  ShapeText(found->second.shape), ShapeText(shape));
    DAUMIER_CHECK(std::ranges::all_of(found->second.values, [](float x) { return std::isfinite(x); }),
                  "{}: the tensor '{}' has a number that is not finite", file_, name);
    taken_.insert(name);
    return found->second;
  }

  void CheckAllTaken() const {
    std::vector<std::string> others;
    for (const auto& item : tensors_)
      if (!taken_.contains(item.first))
        others.push_back(fmt::format("{} {}", item.first, ShapeText(item.second.shape)));
    DAUMIER_CHECK(others.empty(),
                  "{}: the network has no tensors {} (expected {}, and 3 of each weight's and bias' own "
                  "network)",
                  file_, fmt::join(others, ", "), kCodes);
  }

 private:
  std::vector<std::string> FirstNames() const {
    constexpr size_t kShown = 6;
    std::vector<std::string> names;
    for (const auto& item : tensors_)
      if (names.size() < kShown) names.push_back(item.first);
    if (tensors_.size() > kShown) names.emplace_back("...");
    return names;
  }

  const NamedArrays& tensors_;
  const std::string& file_;
  std::set<std::string> taken_;
};

DeformOptions OptionsOf(const TensorTaker& tensors, const std::string& file) {
  const int64_t latent = tensors.ShapeOf(kCodes, 2, "(faces, length of a code)")[1];
  int num_branches = 0;
  while (tensors.Has(BranchName(num_branches, 0, "weight"))) ++num_branches;
  constexpr int kFewestLayers = 3;
  DAUMIER_CHECK(num_branches % 2 == 0 && num_branches >= 2 * kFewestLayers,
                "{}: the weights of {} networks hyper_net.nets.N (expected 10: of the weights and biases of 5 layers)",
                file, num_branches);
  const int64_t hyper_width = tensors.ShapeOf(BranchName(0, 0, "weight"), 2, "(neurons, length of a code)")[0],
                width = tensors.ShapeOf(BranchName(1, 2, "bias"), 1, "(features of a layer)")[0];
  const Json sizes = {{"kind", "hypernetwork"}, {"latent", latent},
                      {"width", width},         {"hidden_layers", num_branches / 2 - 2},
                      {"omega", 30.0},          {"hyper_width", hyper_width}};
  const auto options = ParseOptions<DeformOptions>(sizes, file);
  constexpr int kColumns = 16;
  DAUMIER_CHECK(options.width % kColumns == 0, "{}: layers of {} features, expected a multiple of {}", file,
                options.width, kColumns);
  return options;
}

}  // namespace

AuthorsModel AuthorsModelOf(const NamedArrays& tensors, const std::string& file) {
  TensorTaker taker(tensors, file);
  AuthorsModel model{.options = OptionsOf(taker, file), .arrays = {}, .unused = {}};
  const int64_t latent = model.options.latent, hidden = model.options.hyper_width;
  const int64_t num_codes = taker.ShapeOf(kCodes, 2, "(faces, length of a code)")[0];
  DAUMIER_CHECK(num_codes >= 2, "{}: the codes of {} training faces, expected two or more", file, num_codes);
  model.arrays["codes"] = taker.Take(kCodes, {num_codes, latent});

  const runtime::SirenLayout siren = model.options.siren();
  for (int layer = 0; layer < siren.num_layers(); ++layer) {
    for (const bool is_bias : {false, true}) {
      const int64_t outputs = siren.outputs(layer) * (is_bias ? 1 : siren.inputs(layer));
      const TensorShape weights[] = {{hidden, latent}, {hidden, hidden}, {outputs, hidden}};
      const char* const parts[] = {"first", "second", "last"};
      for (int i = 0; i < 3; ++i) {
        const std::string ours = fmt::format("network.{}_{}.{}.", is_bias ? "biases" : "weights", layer, parts[i]);
        const int branch = 2 * layer + (is_bias ? 1 : 0);
        model.arrays[ours + "weight"] = taker.Take(BranchName(branch, i, "weight"), weights[i]);
        model.arrays[ours + "bias"] = taker.Take(BranchName(branch, i, "bias"), {weights[i][0]});
      }
    }
    for (const bool is_bias : {false, true}) {
      const std::string own = fmt::format("deform_net.net.net.{}.0.{}", layer, is_bias ? "bias" : "weight");
      if (!taker.Has(own)) continue;
      taker.Take(own,
                 is_bias ? TensorShape{siren.outputs(layer)} : TensorShape{siren.outputs(layer), siren.inputs(layer)});
      model.unused.push_back(own);
    }
  }
  taker.CheckAllTaken();
  return model;
}

NamedArrays ReadStateFile(const fs::path& path) {
  DAUMIER_CHECK(fs::is_regular_file(path), "{}: there is no such file", path.string());
  if (faces::IsTorchFile(path) || path.extension() != ".safetensors") return faces::ReadTorchState(path);
  const SafetensorsFile file(path);
  NamedArrays state;
  for (const auto& [name, array] : file.arrays()) {
    FloatArray& values = state[name] = FloatArray(array.shape);
    if (array.dtype == Dtype::kF32) {
      const auto floats = array.As<float>();
      values.values.assign(floats.begin(), floats.end());
    } else {
      DAUMIER_CHECK(array.dtype == Dtype::kF16, "{}: the elements of '{}' are neither float32 nor float16",
                    path.string(), name);
      std::ranges::transform(array.As<Half>(), values.values.begin(), FloatFromHalf);
    }
  }
  return state;
}

}  // namespace daumier::deform

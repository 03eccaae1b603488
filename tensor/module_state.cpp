#include "tensor/module_state.h"

#include "core/error.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

namespace daumier::tensor {
namespace {

std::string Difference(const NamedTensors& own, const NamedTensors& state) {
  std::string text;
  for (const auto& [name, tensor] : own) {
    const auto found = state.find(name);
    if (found == state.end()) {
      text += fmt::format("\n  {} is missing", name);
    } else if (found->second.sizes() != tensor.sizes() || found->second.scalar_type() != tensor.scalar_type()) {
      text +=
          fmt::format("\n  {} is {} {}, expected {} {}", name, c10::toString(found->second.scalar_type()),
                      ShapeText(found->second.sizes()), c10::toString(tensor.scalar_type()), ShapeText(tensor.sizes()));
    }
  }
  for (const auto& [name, tensor] : state) {
    if (own.count(name) == 0) text += fmt::format("\n  {} is not part of this network", name);
  }
  return text;
}

}  // namespace

NamedTensors StateOf(const torch::nn::Module& module) {
  NamedTensors state;
  for (const auto& item : module.named_parameters()) state[item.key()] = item.value();
  for (const auto& item : module.named_buffers()) state[item.key()] = item.value();
  return state;
}

void LoadState(torch::nn::Module& module, const NamedTensors& state, const std::string& where) {
  NamedTensors own = StateOf(module);
  const std::string difference = Difference(own, state);
  DAUMIER_CHECK(difference.empty(), "{} does not fit this network; was it trained with other options?{}", where,
                difference);
  at::NoGradGuard no_grad;
  for (auto& [name, tensor] : own) tensor.copy_(state.at(name));
}

std::string SaveModule(const std::filesystem::path& file, const torch::nn::Module& module) {
  return SaveTensors(file, StateOf(module));
}

void LoadModule(const std::filesystem::path& file, torch::nn::Module& module) {
  LoadState(module, LoadTensors(file), file.string());
}

}  // namespace daumier::tensor

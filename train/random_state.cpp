#include "train/random_state.h"

#include "core/error.h"
#include "core/log.h"

#include <ATen/Context.h>

#include <algorithm>
#include <mutex>

namespace daumier::train {
namespace {

std::vector<torch::Device> RandomDevices(const torch::Device& device) {
  std::vector<torch::Device> devices{torch::Device(torch::kCPU)};
  if (!device.is_cpu()) devices.push_back(device);
  return devices;
}

/// "cuda" of "cuda:1".
std::string Kind(const std::string& device) {
  return device.substr(0, device.find(':'));
}

}  // namespace

tensor::NamedTensors RandomState(const torch::Device& device) {
  tensor::NamedTensors state;
  for (const torch::Device& source : RandomDevices(device)) {
    at::Generator generator = at::globalContext().defaultGenerator(source);
    const std::lock_guard lock(generator.mutex());
    state[source.str()] = generator.get_state();
  }
  return state;
}

void LoadRandomState(const tensor::NamedTensors& state, const torch::Device& device, const std::string& where) {
  const auto devices = RandomDevices(device);
  for (const torch::Device& target : devices) {
    const auto found = std::find_if(state.begin(), state.end(),
                                    [&](const auto& item) { return Kind(item.first) == Kind(target.str()); });
    if (found == state.end()) {
      log::Info("{} has no random state of {}: draws there begin with the seed again", where, target.str());
      continue;
    }
    at::Generator generator = at::globalContext().defaultGenerator(target);
    const std::lock_guard lock(generator.mutex());
    try {
      generator.set_state(found->second);
    } catch (const c10::Error& error) {
      throw Error(fmt::format("{}: the random state of {} does not fit this LibTorch: {}", where, found->first,
                              error.what_without_backtrace()));
    }
  }
  for (const auto& item : state) {
    const bool is_used = std::any_of(devices.begin(), devices.end(), [&](const torch::Device& target) {
      return Kind(target.str()) == Kind(item.first);
    });
    if (!is_used)
      log::Info("{}: the random state of {} is skipped, since this training runs on {}", where, item.first,
                device.str());
  }
}

}  // namespace daumier::train

#pragma once
#include "export/exported_function.h"
#include "runtime/network_runner.h"

namespace daumier::exporting {

/// A function, run by LibTorch on a device. Holds the network, on the CPU or moved to the device.
class TorchRunner : public runtime::NetworkRunner {
 public:
  TorchRunner(NetworkFunction network, const torch::Device& device);
  NamedArrays Run(const NamedArrays& inputs) const override;

 private:
  NetworkFunction network_;
  torch::Device device_;
};

}  // namespace daumier::exporting

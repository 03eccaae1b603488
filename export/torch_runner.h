#pragma once
#include "export/run_export.h"
#include "runtime/network_runner.h"

namespace daumier::exporting {

/// The function of an export, run by LibTorch on a device. Holds the network, on the CPU or moved to the device.
class TorchRunner : public runtime::NetworkRunner {
 public:
  TorchRunner(const RunExport& run, const torch::Device& device);
  NamedArrays Run(const NamedArrays& inputs) const override;

 private:
  std::shared_ptr<torch::nn::Module> module_;
  ExportedFunction function_;
  torch::Device device_;
};

}  // namespace daumier::exporting

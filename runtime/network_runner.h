#pragma once
#include "core/array.h"

namespace daumier::runtime {

/// A trained network: named inputs to named outputs, each B x ..., as its exported graph names them.
class NetworkRunner {
 public:
  virtual ~NetworkRunner() = default;
  /// May be called from several threads. @throws Error naming the input if one is missing or has another shape.
  virtual NamedArrays Run(const NamedArrays& inputs) const = 0;
};

}  // namespace daumier::runtime

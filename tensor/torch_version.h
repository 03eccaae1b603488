#pragma once
// What differs between the LibTorch releases that Daumier builds against (1.13 of Debian 12, 2.6 of Debian 13), in one
// place.
//   at::NoGradGuard    2.x no longer includes it in torch/types.h         -> included here
//   default threads    1.13 starts with half of the cores                 -> tensor/runtime.h sets them
//   optimiser archive  1.13 loses the learning rate on loading            -> checkpoints are safetensors and JSON
//   at::item<T>()      needs `.template` in dependent contexts on 2.x     -> written so everywhere
#include <ATen/core/grad_mode.h>
#include <torch/version.h>

#define DAUMIER_TORCH_AT_LEAST(major, minor) \
  (TORCH_VERSION_MAJOR > (major) || (TORCH_VERSION_MAJOR == (major) && TORCH_VERSION_MINOR >= (minor)))

static_assert(DAUMIER_TORCH_AT_LEAST(1, 13), "Daumier needs LibTorch 1.13 or newer");

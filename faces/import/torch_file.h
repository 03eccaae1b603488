#pragma once
#include "core/array.h"

#include <filesystem>

namespace daumier::faces {

/// Whether a file begins as torch.save writes it: a zip archive, or the format before PyTorch 1.6.
bool IsTorchFile(const std::filesystem::path& path);

/// The tensors of a network's state that PyTorch wrote (torch.save, in both formats; LibTorch's pickle_save), by name,
/// in row-major order. Nothing of the file is executed (ReadPickle).
/// - The state is the dictionary of tensors in the file, or the only one in a dictionary ({"model": ...,
///   "optimizer": ...}); of several that named model, state_dict, model_state_dict, network or net. What is no tensor is
///   left out. Where all names begin with "module." (DataParallel), that is removed.
/// - Elements float16, bfloat16, float32, float64, whole numbers of 8 to 64 bits and booleans, as float32: rounded.
/// - Tensors may be views of one storage, with any strides and offsets.
/// The memory is at most a few times the size of the file. @throws Error naming file, cause and repair: no such file,
/// truncated, damaged, big-endian, TorchScript, a whole network instead of its state (with the name of its class).
NamedArrays ReadTorchState(const std::filesystem::path& path);

}  // namespace daumier::faces

#pragma once
#include "core/array.h"
#include "runtime/graph_runner.h"

#include <filesystem>
#include <optional>
#include <string>

namespace daumier::runtime {

enum class ImageLayout { kChannelsFirst, kChannelsLast };  ///< (1, 3, H, W), (1, H, W, 3)

/// The image that a network reads.
struct ImageInput {
  std::string name;
  ImageLayout layout = ImageLayout::kChannelsFirst;
  std::optional<int64_t> height, width;  ///< Where the file fixes them.
  bool is_bytes = false;                 ///< The file says uint8: values from 0 to 255.
};

/// The only input of the graph as an image of three channels, by where its shape has a 3; where it has none, by the
/// convolution or transposition that reads it. @throws Error if there are several inputs, or no such image.
ImageInput ImageInputOf(const Graph& graph);

/// A network from one picture to one picture, read from an ONNX file: stylisation, for the most part. What the file does not
/// say, the caller decides: how values are scaled (0 to 1, -1 to 1, 0 to 255), whether channels are RGB or BGR, and of
/// what number sizes must be a multiple. Networks that halve an image k times want multiples of 2^k; 32 suits most.
class ImageNetwork {
 public:
  /// @throws Error naming the file as ReadOnnx and ImageInputOf, or if the network has operators that are not run here.
  explicit ImageNetwork(const std::filesystem::path& file);

  const ImageInput& input() const { return input_; }

  /// picture: (H, W, 3). Returns the first output, (H', W', 3), a single channel repeated. May be called from several
  /// threads. @throws Error naming the file if the picture has another size than the file fixes, the network cannot be
  /// computed for that size, or its output is no image or not finite.
  FloatArray Run(const FloatArray& picture) const;

 private:
  std::filesystem::path file_;
  ImageInput input_;
  std::string output_;
  std::unique_ptr<GraphRunner> runner_;
};

}  // namespace daumier::runtime

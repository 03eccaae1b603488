#pragma once
#include "core/options.h"
#include "render/image.h"
#include "runtime/image_network.h"

#include <filesystem>
#include <string>

namespace daumier::portrait {

struct StyleNetworkOptions {
  std::string range = "auto";
  int side = 512;

  template <class V>
  void Visit(V&& visit) {
    visit("range", range, Choices{{"auto", "zero_one", "signed", "bytes"}},
          "What the network reads and returns: 0 to 1, -1 to 1 (signed) or 0 to 255 (bytes), which its file does not "
          "say. auto: that with which a small copy of the picture comes out most like itself.");
    visit("side", side, Range{64, 4096},
          "Longer side of the picture that it reads, pixels, where its file does not fix a size.");
  }
};

/// An image-to-image network of anybody's as the stylisation of [Pan et al. 2024, section 3.1.3].
class StyleNetwork {
 public:
  /// @throws Error as runtime::ImageNetwork.
  explicit StyleNetwork(const std::filesystem::path& file, const StyleNetworkOptions& options = {});

  /// The picture as the network makes it, RGB of the picture's size. It is scaled into the size of the network (fixed
  /// by the file, else options.side, multiples of 32), its border repeated where it is of another shape.
  /// @throws Error as runtime::ImageNetwork::Run, or if the picture is empty.
  render::Image Apply(const render::Image& picture) const;

  /// The range of values for a picture: options.range, or found as "auto" says: of the three, that of the greatest
  /// correlation of lightness between the picture and what the network returns, both as 16 x 16 means, times the share of
  /// returned values within the range (a tenth beyond it allowed); of equal ones signed before zero_one before bytes.
  std::string RangeFor(const render::Image& picture) const;

 private:
  render::Image Run(const render::Image& picture, const std::string& range, int side, double* within) const;

  runtime::ImageNetwork network_;
  StyleNetworkOptions options_;
};

}  // namespace daumier::portrait

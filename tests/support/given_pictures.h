#pragma once
#include "core/files.h"
#include "systems/portrait/given_portraits.h"
#include "systems/portrait/landmark_files.h"
#include "tests/support/ideal_landmark_network.h"

#include <filesystem>
#include <memory>

namespace daumier::testing {

/// The ideal network of PictureOfPlaces, but for pictures with some blue: from kDoubtful on it takes no face for sure, from
/// kEmpty on it finds none.
class MarkedPictureNetwork : public runtime::NetworkRunner {
 public:
  static constexpr uint8_t kDoubtful = 100, kEmpty = 200;
  std::vector<std::vector<float>> faces;
  double deviation = 1;  ///< Of heat maps: the larger, the less confident it is of landmarks.

  NamedArrays Run(const NamedArrays& inputs) const override {
    const FloatArray& pictures = inputs.at("pictures");
    const float blue = 255 * pictures.row(0)[size_t(pictures.row_size()) * 5 / 6];  // In the middle of the third plane.
    IdealLandmarkNetwork network;
    network.faces = faces;
    network.deviation = deviation;
    if (blue > kDoubtful - 10) network.is_face = 0.3;
    if (blue > kEmpty - 10) network.faces.clear();
    return network.Run(inputs);
  }
};

inline render::Image MarkedPicture(int height, int width, uint8_t blue) {
  render::Image picture = PictureOfPlaces(height, width);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) picture.at(row, column, 2) = blue;
  return picture;
}

inline const std::vector<float>& GivenFace() {
  static const std::vector<float> face = PlausibleLandmarks(60, 50, 80);
  return face;
}

inline portrait::LandmarkDetector GivenDetector() {
  auto network = std::make_shared<MarkedPictureNetwork>();
  network->faces = {GivenFace()};
  return {{}, network, portrait::GivenPortraitsOptions().detector};
}

/// One picture with GivenFace alone, one of a person of two, and one of the same person.
inline void WriteGivenPictures(const std::filesystem::path& folder) {
  MakeDirectory(folder / "bob");
  for (const char* name : {"alone.png", "bob/1.png", "bob/2.png"})
    render::WriteImage(folder / name, PictureOfPlaces(200, 200));
}

}  // namespace daumier::testing

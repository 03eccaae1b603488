#pragma once
#include "fitting/texture_picture.h"

#include <Eigen/Core>

#include <array>
#include <optional>

namespace daumier::fitting {

/// The dark disc of an eye in a picture.
struct IrisDisc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< Pixels.
  double radius = 0;                                 ///< Pixels.
  double score = 0;                                  ///< Of FindIris.
};

/// Radii of an iris as shares of that of its eyeball.
struct IrisSizes {
  double least = 0.22, most = 0.62, usual = 0.4;
};

/// The disc that parts the pixels of an eye best into dark ones within and light ones without: of the greatest score
///   n_in n_out / n^2 (mean_out - mean_in)^2 exp(-(log(radius / usual) / 0.35)^2 / 2)
/// of their lightness [Otsu 1979], over centres within the eye and the given sizes: of pale eyes, the pupil alone would be the
/// better disc without the last factor. The eye: the layer's known pixels within 1.1 radii of the eyeball, which is a disc
/// of `ball_radius` pixels about `middle`. Absent if there are fewer than 20 of them or the means differ by less than 0.06.
std::optional<IrisDisc> FindIris(const PictureLayer& eyes, const Eigen::Vector2d& middle, double ball_radius,
                                 const IrisSizes& sizes = {});

/// Colours of an iris by the distance from its centre, in shares of its radius: medians over rings of what the picture
/// shows, smoothed, between them linear. A ring of which nothing is seen has those of the nearest one.
class IrisProfile {
 public:
  IrisProfile(const PictureLayer& eyes, const IrisDisc& iris);
  Eigen::Vector3f At(float share) const;

 private:
  void Smooth();

  static constexpr size_t kNumRings = 8;
  std::array<Eigen::Vector3f, kNumRings> colours_;
};

/// The median colour of an eye's known pixels, a channel (the eye as of FindIris); absent if there are fewer than 20.
std::optional<Eigen::Vector3f> MedianOfEye(const PictureLayer& eyes, const Eigen::Vector2d& middle, double ball_radius);

/// The lightness (0.299 R + 0.587 G + 0.114 B) below which nine tenths of the known pixels within `reach` of `middle` lie that
/// are not of the iris; absent if there are fewer than 10.
std::optional<float> WhiteLightness(const PictureLayer& eyes, const Eigen::Vector2d& middle, double reach,
                                    const std::optional<IrisDisc>& iris);

}  // namespace daumier::fitting

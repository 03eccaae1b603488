#pragma once
#include "runtime/network_runner.h"
#include "systems/portrait/landmark_crop.h"
#include "systems/portrait/landmark_sample.h"
#include "systems/portrait/landmark_views.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace daumier::testing {

/// Each pixel's red is its column and its green its row: a crop of it shows where it lies. At most 256 x 256.
inline render::Image PictureOfPlaces(int height, int width) {
  render::Image picture(height, width, 3, 0);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      picture.at(row, column, 0) = uint8_t(column);
      picture.at(row, column, 1) = uint8_t(row);
    }
  return picture;
}

/// Returns what a perfect network returns for crops of PictureOfPlaces that shows faces with given landmarks. Eyes are the
/// polygons' bounding ellipses.
class IdealLandmarkNetwork : public runtime::NetworkRunner {
 public:
  std::vector<std::vector<float>> faces;  ///< 68 x 2 each.
  double deviation = 1.0;
  double is_face = 6;  ///< Score.
  bool mouth_open = false, right_eye_closed = false;

  NamedArrays Run(const NamedArrays& inputs) const override;

 private:
  struct Place {
    Eigen::Matrix2d picture_from_crop;
    Eigen::Vector2d origin;
    Eigen::Vector2d ToCrop(const Eigen::Vector2d& p) const { return picture_from_crop.inverse() * (p - origin); }
  };
  static Place PlaceOf(const float* crop, int size);
};

/// A plausible face in a box: 68 x 2.
inline std::vector<float> PlausibleLandmarks(double left, double top, double width) {
  std::vector<float> points;
  const auto add = [&](double u, double v) {
    points.push_back(float(left + width * u));
    points.push_back(float(top + width * v));
  };
  for (int i = 0; i < 17; ++i) add(0.5 - 0.5 * std::cos(i * M_PI / 16), 0.3 + 0.7 * std::sin(i * M_PI / 16));
  for (int i = 0; i < 10; ++i) add(0.12 + 0.075 * i + (i > 4 ? 0.08 : 0), 0.1);
  for (int i = 0; i < 4; ++i) add(0.5, 0.25 + 0.08 * i);
  for (int i = 0; i < 5; ++i) add(0.42 + 0.04 * i, 0.55);
  const double eye[6][2] = {{-0.08, 0}, {-0.03, -0.03}, {0.03, -0.03}, {0.08, 0}, {0.03, 0.03}, {-0.03, 0.03}};
  for (const double x : {0.3, 0.7})
    for (const auto& corner : eye) add(x + corner[0], 0.25 + corner[1]);
  for (int i = 0; i < 20; ++i) add(0.5 - 0.15 * std::cos(i * M_PI / 6), 0.75 - 0.04 * std::sin(i * M_PI / 6));
  return points;
}

inline IdealLandmarkNetwork::Place IdealLandmarkNetwork::PlaceOf(const float* crop, int size) {
  // Least squares over pixels inside the picture: (column + 0.5, row + 0.5, 1) -> (red, green) + 0.5.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  const size_t count = size_t(size) * size_t(size);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const size_t at = size_t(row) * size_t(size) + size_t(column);
      const Eigen::Vector2d p(255.0 * crop[at] + 0.5, 255.0 * crop[count + at] + 0.5);
      if (p.minCoeff() < 1.5 || p.maxCoeff() > 198) continue;
      const Eigen::Vector3d x(column + 0.5, row + 0.5, 1);
      normal += x * x.transpose();
      right += x * p.transpose();
    }
  const Eigen::Matrix<double, 3, 2> fit = normal.ldlt().solve(right);
  return {fit.topRows<2>().transpose(), fit.row(2).transpose()};
}

inline NamedArrays IdealLandmarkNetwork::Run(const NamedArrays& inputs) const {
  const FloatArray& pictures = inputs.at("pictures");
  const int64_t batch = pictures.shape[0];
  const int size = int(pictures.shape[2]), side = portrait::HeatMapSide(size), label_side = portrait::LabelSide(size),
            search_side = portrait::SearchSide(size);
  FloatArray maps({batch, 68, side, side}), labels({batch, 8, label_side, label_side}), states({batch, 8}),
      boxes({batch, 5, search_side, search_side});
  for (int64_t b = 0; b < batch; ++b) {
    const Place place = PlaceOf(pictures.row(b), size);
    const bool is_mirrored = place.picture_from_crop.determinant() < 0;
    std::vector<portrait::Box> shown;
    const std::vector<float>* nearest = nullptr;
    double least = 1e9;
    for (const auto& face : faces) {
      std::vector<float> in_crop;
      for (size_t i = 0; i < 68; ++i) {
        const Eigen::Vector2d at = place.ToCrop({face[2 * i], face[2 * i + 1]});
        in_crop.push_back(float(at.x()));
        in_crop.push_back(float(at.y()));
      }
      shown.push_back(portrait::BoxOf(in_crop));
      const double distance = (shown.back().centre() - Eigen::Vector2d::Constant(0.5 * size)).norm();
      if (distance < least) least = distance, nearest = &face;
    }
    const portrait::SearchTargets search = portrait::MakeSearchTargets(shown, size);
    const size_t cells = search.score.size();
    for (size_t i = 0; i < cells; ++i) {
      boxes.row(b)[i] = 12 * search.score[i] - 7;
      for (size_t k = 0; k < 4; ++k) boxes.row(b)[(k + 1) * cells + i] = search.box[k * cells + i];
    }
    const float scores[8] = {float(-is_face),
                             float(is_face),
                             0,
                             right_eye_closed && !is_mirrored ? 4.f : -4.f,
                             0,
                             right_eye_closed && is_mirrored ? 4.f : -4.f,
                             0,
                             mouth_open ? 4.f : -4.f};
    std::copy(scores, scores + 8, states.row(b));
    if (nearest == nullptr) continue;
    for (int i = 0; i < 68; ++i) {
      const auto from = size_t(is_mirrored ? portrait::MirroredLandmarks()[size_t(i)] : i);
      const Eigen::Vector2d at = place.ToCrop({(*nearest)[2 * from], (*nearest)[2 * from + 1]}) * side / size;
      for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
          maps.row(b)[(size_t(i) * size_t(side) + size_t(row)) * size_t(side) + size_t(column)] =
              float(-0.5 * (Eigen::Vector2d(column + 0.5, row + 0.5) - at).squaredNorm() / (deviation * deviation));
    }
    for (int row = 0; row < label_side; ++row)
      for (int column = 0; column < label_side; ++column) {
        const Eigen::Vector2d p =
            place.origin + place.picture_from_crop *
                               Eigen::Vector2d((column + 0.5) * size / label_side, (row + 0.5) * size / label_side);
        double eye = -5;  // Positive inside of an eye's ellipse.
        for (const size_t first : {36, 42}) {
          const portrait::Box box = portrait::BoxOf({nearest->data() + 2 * first, 12});
          const Eigen::Vector2d d = p - box.centre();
          eye = std::max(eye, 4 * (1 - std::hypot(d.x() / (0.5 * box.width()), d.y() / (0.5 * box.height()))));
        }
        labels.row(
            b)[(size_t(PictureClass::kEyes) * size_t(label_side) + size_t(row)) * size_t(label_side) + size_t(column)] =
            float(eye);
        for (const auto other : {PictureClass::kBrows, PictureClass::kLips, PictureClass::kMouth, PictureClass::kEars,
                                 PictureClass::kHair, PictureClass::kBackground})
          labels.row(b)[(size_t(other) * size_t(label_side) + size_t(row)) * size_t(label_side) + size_t(column)] = -20;
      }
  }
  return {{"heat_maps", std::move(maps)},
          {"labels", std::move(labels)},
          {"states", std::move(states)},
          {"boxes", std::move(boxes)}};
}

}  // namespace daumier::testing

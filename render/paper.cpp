#include "render/paper.h"

#include "core/error.h"
#include "render/opencv_bridge.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace daumier::render {
namespace {

/// Blocks along the longer side, each of which has a vote on whether lines are dark or light.
constexpr int kNumVotes = 8;
/// Blocks along the longer side, each of which gives one sample of the paper's brightness.
constexpr int kNumBlocks = 24;
/// Share of a block's pixels that are darker than its paper.
constexpr double kPaperQuantile = 0.8;
/// Weight of a block below the surface against one above it, while the surface is sought.
constexpr double kWeightBelow = 0.05;
constexpr int kNumSurfaceSteps = 20;
/// Share of the surface's brightness by which a block may fall below it and still be paper.
constexpr double kPaperSpread = 0.15;
/// Share of its brightest point below which the surface cannot fall.
constexpr double kDarkestPaper = 0.2;
/// Side of the closing's window as a share of the longer side: wider than any line, narrower than most shadows.
constexpr double kShadowWindow = 0.12;
/// Brightness against the surface below which something dark is no shadow.
constexpr float kDarkestShadow = 0.6f;
/// Against noise, in pixels; little enough to keep lines of one pixel.
constexpr double kBlur = 0.7;

/// The pixels of a rectangle, cut at the border.
std::vector<uint8_t> ValuesOf(const cv::Mat& grey, const cv::Rect& rectangle) {
  const cv::Mat part = grey(rectangle & cv::Rect(0, 0, grey.cols, grey.rows));
  return {part.begin<uint8_t>(), part.end<uint8_t>()};
}

uint8_t Quantile(std::vector<uint8_t> values, double share) {
  const auto rank = values.begin() + static_cast<int64_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

/// Whether the lines are lighter than the paper: near lines, wherever they are, most of the picture is paper. The edge
/// of the picture, which may show what lies under the paper, has no say.
bool IsLightOnDark(const cv::Mat& grey) {
  const int side = std::max(1, std::max(grey.rows, grey.cols) / kNumVotes);
  int votes = 0;
  for (int row = grey.rows / kNumVotes; row < grey.rows - grey.rows / kNumVotes; row += side) {
    for (int column = grey.cols / kNumVotes; column < grey.cols - grey.cols / kNumVotes; column += side) {
      const auto values = ValuesOf(grey, {column, row, side, side});
      votes += Quantile(values, 0.02) + Quantile(values, 0.98) - 2 * Quantile(values, 0.5);
    }
  }
  return votes > 0;
}

/// 1, x, y, x^2, xy, y^2 with x and y in [-1, 1].
Eigen::Matrix<double, 1, 6> Monomials(double row, double column, const cv::Mat& grey) {
  const double x = 2.0 * column / grey.cols - 1.0, y = 2.0 * row / grey.rows - 1.0;
  return {1.0, x, y, x * x, x * y, y * y};
}

/// Coefficients of the quadratic that follows the brighter blocks.
Eigen::VectorXd FitPaperSurface(const cv::Mat& grey) {
  const int side = std::max(1, std::max(grey.rows, grey.cols) / kNumBlocks);
  std::vector<Eigen::Matrix<double, 1, 6>> rows;
  std::vector<double> brightness;
  for (int row = 0; row < grey.rows; row += side) {
    for (int column = 0; column < grey.cols; column += side) {
      rows.push_back(Monomials(row + 0.5 * side, column + 0.5 * side, grey));
      brightness.push_back(Quantile(ValuesOf(grey, {column, row, side, side}), kPaperQuantile));
    }
  }
  const auto num_blocks = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd design(num_blocks, 6);
  for (Eigen::Index i = 0; i < num_blocks; ++i) design.row(i) = rows[i];
  const Eigen::Map<const Eigen::VectorXd> values(brightness.data(), num_blocks);

  Eigen::VectorXd weights = Eigen::VectorXd::Ones(num_blocks), coefficients;
  for (int step = 0; step < kNumSurfaceSteps; ++step) {
    // A trace of regularisation keeps pictures of very few blocks solvable.
    Eigen::MatrixXd normal = design.transpose() * weights.asDiagonal() * design;
    normal.diagonal().tail(5).array() += 1e-6 * static_cast<double>(num_blocks);
    coefficients = normal.ldlt().solve(design.transpose() * weights.cwiseProduct(values));
    const Eigen::VectorXd surface = design * coefficients;
    // First an expectile, which climbs to the bright side; then what is clearly darker no longer counts.
    const double weight_of_dark = step < kNumSurfaceSteps / 2 ? kWeightBelow : 0.0;
    for (Eigen::Index i = 0; i < num_blocks; ++i) {
      const bool dark =
          step < kNumSurfaceSteps / 2 ? values[i] < surface[i] : values[i] < (1.0 - kPaperSpread) * surface[i];
      weights[i] = dark ? weight_of_dark : 1.0;
    }
  }
  return coefficients;
}

/// The picture divided by the surface: paper is about 1.
cv::Mat DivideBySurface(const cv::Mat& grey, const Eigen::VectorXd& coefficients) {
  cv::Mat surface(grey.size(), CV_32F);
  for (int row = 0; row < grey.rows; ++row) {
    for (int column = 0; column < grey.cols; ++column) {
      surface.at<float>(row, column) = static_cast<float>(Monomials(row + 0.5, column + 0.5, grey) * coefficients);
    }
  }
  double brightest = 0.0;
  cv::minMaxLoc(surface, nullptr, &brightest);
  surface = cv::max(surface, std::max(1.0, kDarkestPaper * brightest));
  cv::Mat even;
  cv::divide(grey, surface, even, 1.0, CV_32F);
  return even;
}

/// Brightness of shadows and stains: what remains when all that is narrower than the window is filled.
cv::Mat Shadows(const cv::Mat& even) {
  const int reach = std::max(1, static_cast<int>(0.5 * kShadowWindow * std::max(even.rows, even.cols)));
  const cv::Size window(2 * reach + 1, 2 * reach + 1);
  cv::Mat shadows;
  cv::morphologyEx(even, shadows, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, window));
  // Below the darkest shadow it is ink, whose paper is unknown: that of the surface is taken.
  shadows.setTo(1.0, shadows < kDarkestShadow);
  cv::GaussianBlur(shadows, shadows, {0, 0}, kBlur);
  return shadows;
}

}  // namespace

Image NormaliseBackground(const Image& picture) {
  DAUMIER_CHECK(!picture.pixels.empty(), "the picture is empty");
  cv::Mat grey;
  if (picture.channels == 3) {
    cv::cvtColor(MatView(picture), grey, cv::COLOR_RGB2GRAY);
  } else {
    grey = MatView(picture).clone();
  }
  if (IsLightOnDark(grey)) cv::bitwise_not(grey, grey);
  cv::GaussianBlur(grey, grey, {0, 0}, kBlur);
  const cv::Mat even = DivideBySurface(grey, FitPaperSurface(grey));
  cv::Mat flat;
  cv::divide(even, Shadows(even), flat, 255.0);

  Image flattened(picture.height, picture.width, 1);
  cv::Mat view = MatView(flattened);
  flat.convertTo(view, CV_8U);
  return flattened;
}

}  // namespace daumier::render

#include "render/paper.h"

#include "core/error.h"
#include "render/opencv_bridge.h"
#include "render/soft_shading.h"

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
/// Brightness against the surface below which something dark may be ink instead of a shadow. It is if it is that near
/// to the brightness of lines, as a share of what they take from the paper.
constexpr float kDarkestShadow = 0.6f;
constexpr double kNearLines = 0.3;
/// What is brighter than this and has this share of its pixels in lines is a shadow in any case.
constexpr double kDarkestWithLines = 0.3, kShareOfLines = 0.01;
/// Half the side of a window wider than lines, in pixels; the step of brightness of a line, at least; and its
/// brightness against what lies under it, at most.
constexpr int kLineReach = 7;
constexpr double kLeastLineStep = 0.06, kLineRatio = 0.8;
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

cv::Mat ClosedBy(const cv::Mat& even, int reach) {
  cv::Mat closed;
  cv::morphologyEx(even, closed, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1}));
  return closed;
}

/// Brightness of lines against what lies under them, where it is clearly below 1; 1 elsewhere.
cv::Mat LinesOn(const cv::Mat& even) {
  const cv::Mat ground = ClosedBy(even, kLineReach);
  cv::Mat ratio;
  cv::divide(even, cv::max(ground, 1e-3), ratio);
  ratio.setTo(1.0, ground - even < kLeastLineStep);
  return ratio;
}

/// The brightness that a quarter of the pixels of lines stay below; 0 if there are none.
double TypicalLine(const cv::Mat& lines) {
  std::vector<float> values;
  for (auto value = lines.begin<float>(); value != lines.end<float>(); ++value) {
    if (*value < kLineRatio) values.push_back(*value);
  }
  if (values.empty()) return 0.0;
  const auto rank = values.begin() + std::ssize(values) / 4;
  std::nth_element(values.begin(), rank, values.end());
  return *rank;
}

/// Where something dark and wide is ink: about as dark as lines, and without lines in it.
cv::Mat WideInk(const cv::Mat& even, const cv::Mat& shadows) {
  cv::Mat labels;
  const cv::Mat is_dark = shadows < kDarkestShadow;
  const int num_labels = cv::connectedComponents(is_dark, labels, 8, CV_32S);
  if (num_labels == 1) return is_dark;
  const cv::Mat lines = LinesOn(even);
  const double typical = TypicalLine(lines);
  struct Sums {
    double brightness = 0.0, num_pixels = 0.0, num_lines = 0.0;
  };
  std::vector<Sums> sums(num_labels);
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      Sums& area = sums[labels.at<int>(row, column)];
      area.brightness += shadows.at<float>(row, column);
      area.num_pixels += 1.0;
      area.num_lines += lines.at<float>(row, column) < kDarkestShadow;
    }
  }
  cv::Mat ink(labels.size(), CV_8U, cv::Scalar(0));
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      const int label = labels.at<int>(row, column);
      const Sums& area = sums[label];
      const double brightness = area.brightness / area.num_pixels;
      const bool holds_lines = brightness > kDarkestWithLines && area.num_lines > kShareOfLines * area.num_pixels;
      const bool is_like_lines = brightness < typical + kNearLines * (1.0 - typical);
      if (label != 0 && is_like_lines && !holds_lines) ink.at<uint8_t>(row, column) = 255;
    }
  }
  return ink;
}

/// Brightness of shadows and stains: what remains when all that is narrower than the window is filled.
cv::Mat Shadows(const cv::Mat& even) {
  const int reach = std::max(1, static_cast<int>(0.5 * kShadowWindow * std::max(even.rows, even.cols)));
  cv::Mat shadows = ClosedBy(even, reach);
  // A dark shadow continues beyond the border of the picture.
  cv::Mat continued;
  cv::copyMakeBorder(even, continued, reach, reach, reach, reach, cv::BORDER_REPLICATE);
  continued = ClosedBy(continued, reach)(cv::Rect(reach, reach, even.cols, even.rows)).clone();
  const cv::Mat ink = WideInk(even, continued);
  continued.copyTo(shadows, (continued < kDarkestShadow) & ~ink);
  // The paper under ink is unknown: that of the surface is taken.
  shadows.setTo(1.0, ink & (shadows < kDarkestShadow));
  cv::GaussianBlur(shadows, shadows, {0, 0}, kBlur);
  return shadows;
}

/// Divides by soft shading, if there is any.
void RemoveSoftShading(cv::Mat& even) {
  Image picture(even.rows, even.cols, 1);
  cv::Mat view = MatView(picture);
  even.convertTo(view, CV_8U, 255.0);
  const auto shading = SoftShading(picture);
  if (shading) cv::divide(even, MatView(*shading), even, 255.0, CV_32F);
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
  cv::Mat even = DivideBySurface(grey, FitPaperSurface(grey));
  RemoveSoftShading(even);
  cv::Mat flat;
  cv::divide(even, Shadows(even), flat, 255.0);

  Image flattened(picture.height, picture.width, 1);
  cv::Mat view = MatView(flattened);
  flat.convertTo(view, CV_8U);
  return flattened;
}

}  // namespace daumier::render

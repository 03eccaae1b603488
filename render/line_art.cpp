#include "render/line_art.h"

#include "core/error.h"
#include "render/opencv_bridge.h"
#include "render/photo_grey.h"
#include "render/photo_sheet.h"
#include "render/sheet_perspective.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

namespace daumier::render {
namespace {

/// Largest longer side at which a picture is measured; the side of the window that no line fills, as a share of the
/// longer side, and its least in pixels.
constexpr int kLineArtSide = 256, kLeastLineWindow = 5;
constexpr double kLineWindow = 0.035;
/// The surface of the paper: rounds of reweighting, the weight of what is darker, and the residual of half weight.
constexpr int kPaperRounds = 20, kPaperStep = 7;
constexpr double kDarkerWeight = 0.05, kPaperResidual = 0.05, kDarkestSurface = 0.05;
/// Relative to the paper: departures in brightness or colour of paper and of content, and the brightness of black.
constexpr double kPaperDeparture = 0.12, kContentDeparture = 0.2, kBlackBrightness = 0.35, kBlackColour = 0.15;
/// Difference of the channels of paper, from 0 to 1: what is more colourful is a wall.
constexpr double kColourfulPaper = 0.5;
/// Share of the content on each side that lies outside its box, and the margin round the box.
constexpr double kOutsideContent = 0.02, kContentMargin = 0.05;

/// RGB from 0 to 1, at most kLineArtSide long.
cv::Mat3d MeasuredColours(const Image& picture, const cv::Rect& part) {
  cv::Mat colours, small, numbers;
  const cv::Mat view = MatView(picture)(part);
  if (picture.channels == 1) {
    cv::cvtColor(view, colours, cv::COLOR_GRAY2RGB);
  } else {
    colours = view;
  }
  const double scale = std::min(1.0, double(kLineArtSide) / std::max(part.width, part.height));
  const cv::Size size(std::max(1, int(std::lround(scale * part.width))),
                      std::max(1, int(std::lround(scale * part.height))));
  cv::resize(colours, small, size, 0, 0, cv::INTER_AREA);
  small.convertTo(numbers, CV_64FC3, 1 / 255.0);
  return numbers;
}

double MeanOfChannels(const cv::Vec3d& colour) {
  return (colour[0] + colour[1] + colour[2]) / 3;
}
double SpreadOfChannels(const cv::Vec3d& colour) {
  return std::max({colour[0], colour[1], colour[2]}) - std::min({colour[0], colour[1], colour[2]});
}

/// Brightness of the paper, a quadratic over the picture that lies on the bright side of the least channel.
cv::Mat1d SurfaceOfPaper(const cv::Mat3d& without_lines) {
  const auto monomials = [&](int row, int column) {
    const double x = 2.0 * column / without_lines.cols - 1, y = 2.0 * row / without_lines.rows - 1;
    return Eigen::Matrix<double, 6, 1>{1, x, y, x * x, x * y, y * y};
  };
  std::vector<Eigen::Matrix<double, 6, 1>> places;
  std::vector<double> values;
  for (int index = 0; index < int(without_lines.total()); index += kPaperStep) {
    const int row = index / without_lines.cols, column = index % without_lines.cols;
    const cv::Vec3d& colour = without_lines(row, column);
    places.push_back(monomials(row, column));
    values.push_back(std::min({colour[0], colour[1], colour[2]}));
  }
  Eigen::Matrix<double, 6, 1> surface = Eigen::Matrix<double, 6, 1>::Zero();
  for (int round = 0; round < kPaperRounds; ++round) {
    Eigen::Matrix<double, 6, 6> normal = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    for (size_t i = 0; i < places.size(); ++i) {
      const double residual = round == 0 ? 0 : (values[i] - surface.dot(places[i])) / kPaperResidual;
      const double weight = (residual < 0 ? kDarkerWeight : 1) / (1 + residual * residual);
      normal += weight * places[i] * places[i].transpose();
      right += weight * values[i] * places[i];
    }
    surface = normal.ldlt().solve(right);
  }
  cv::Mat1d paper(without_lines.size());
  for (int row = 0; row < paper.rows; ++row)
    for (int column = 0; column < paper.cols; ++column)
      paper(row, column) = std::clamp(surface.dot(monomials(row, column)), kDarkestSurface, 1.0);
  return paper;
}

/// The median colour of what is as bright as the paper; none if nearly nothing is.
std::optional<cv::Vec3d> ColourOfPaper(const cv::Mat3d& relative) {
  std::array<std::vector<double>, 3> values;
  for (const cv::Vec3d& colour : relative) {
    if (std::abs(std::min({colour[0], colour[1], colour[2]}) - 1) >= 0.1) continue;
    for (int c = 0; c < 3; ++c) values[size_t(c)].push_back(colour[c]);
  }
  constexpr size_t kFewest = 50;
  if (values[0].size() < kFewest) return std::nullopt;
  cv::Vec3d median;
  for (int c = 0; c < 3; ++c) {
    auto& of = values[size_t(c)];
    const auto middle = of.begin() + ptrdiff_t(of.size() / 2);
    std::nth_element(of.begin(), middle, of.end());
    median[c] = *middle;
  }
  return median;
}

/// The values between which all but the outermost shares lie.
std::pair<int, int> CoreRange(std::vector<int> values) {
  std::ranges::sort(values);
  const auto last = double(values.size() - 1);
  return {values[size_t(kOutsideContent * last)], values[size_t((1 - kOutsideContent) * last)]};
}

struct MeasuredContent {
  cv::Rect box;  ///< Of the content, on the measured picture; empty where the paper is blank.
  double score = 0;
};

/// Of dark lines on light. Absent if there is no paper.
std::optional<MeasuredContent> MeasureContent(const cv::Mat3d& numbers) {
  cv::Mat3d without_lines;
  const int side =
      std::max(kLeastLineWindow, 2 * int(std::lround(0.5 * kLineWindow * std::max(numbers.rows, numbers.cols))) + 1);
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
  cv::morphologyEx(numbers, without_lines, cv::MORPH_CLOSE, window, {-1, -1}, 1, cv::BORDER_REPLICATE);
  const cv::Mat1d paper = SurfaceOfPaper(without_lines);
  cv::Mat3d relative(numbers.size());
  for (int row = 0; row < relative.rows; ++row)
    for (int column = 0; column < relative.cols; ++column)
      relative(row, column) = without_lines(row, column) / paper(row, column);
  const std::optional<cv::Vec3d> paper_colour = ColourOfPaper(relative);
  if (!paper_colour || SpreadOfChannels(*paper_colour) * cv::mean(paper)[0] > kColourfulPaper) return std::nullopt;
  const auto on_paper = [&](const cv::Vec3d& colour) {
    return cv::Vec3d(colour[0] / (*paper_colour)[0], colour[1] / (*paper_colour)[1], colour[2] / (*paper_colour)[2]);
  };
  std::vector<int> rows, columns;
  for (int row = 0; row < numbers.rows; ++row) {
    for (int column = 0; column < numbers.cols; ++column) {
      const cv::Vec3d colour = on_paper(numbers(row, column) / paper(row, column));
      if (std::abs(MeanOfChannels(colour) - 1) <= kContentDeparture && SpreadOfChannels(colour) <= kContentDeparture)
        continue;
      rows.push_back(row);
      columns.push_back(column);
    }
  }
  constexpr size_t kFewest = 20;
  if (rows.size() < kFewest) return MeasuredContent{.box = {}, .score = 1};
  const auto [top, bottom] = CoreRange(std::move(rows));
  const auto [left, right] = CoreRange(std::move(columns));
  MeasuredContent content{{left, top, right - left + 1, bottom - top + 1}};
  int num_paper = 0, num_tones = 0;
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const cv::Vec3d colour = on_paper(relative(row, column));
      const double brightness = MeanOfChannels(colour), colourfulness = SpreadOfChannels(colour);
      if (std::abs(brightness - 1) < kPaperDeparture && colourfulness < kPaperDeparture) {
        ++num_paper;
      } else if (brightness >= kBlackBrightness || colourfulness >= kBlackColour) {
        ++num_tones;
      }
    }
  }
  if (num_paper > 0) content.score = double(num_paper) / (num_paper + num_tones);
  return content;
}

/// Light lines on dark become dark ones on light.
void InvertDark(cv::Mat3d& numbers) {
  std::vector<double> brightness;
  for (const cv::Vec3d& colour : numbers) brightness.push_back(MeanOfChannels(colour));
  const auto middle = brightness.begin() + ptrdiff_t(brightness.size() / 2);
  std::nth_element(brightness.begin(), middle, brightness.end());
  if (*middle >= 0.5) return;
  for (cv::Vec3d& colour : numbers) colour = cv::Vec3d(1, 1, 1) - colour;
}

/// At most kSheetSide long: sheets are found faster.
Image SmallCopy(const Image& picture) {
  constexpr int kSheetSide = 512;
  const double scale = double(kSheetSide) / std::max(picture.width, picture.height);
  if (scale >= 1) return picture;
  Image copy(std::max(1, int(std::lround(scale * picture.height))),
             std::max(1, int(std::lround(scale * picture.width))), picture.channels);
  cv::Mat view = MatView(copy);
  cv::resize(MatView(picture), view, view.size(), 0, 0, cv::INTER_AREA);
  return copy;
}

double ScoreOfSheet(const Image& picture) {
  const cv::Rect whole(0, 0, picture.width, picture.height);
  cv::Mat3d numbers = MeasuredColours(picture, whole);
  InvertDark(numbers);
  const std::optional<MeasuredContent> first = MeasureContent(numbers);
  if (!first) return 0;
  if (first->box.empty()) return first->score;
  // Again, with the content as large as the picture.
  const double scale = double(whole.width) / numbers.cols;
  const double margin = kContentMargin * std::max(first->box.width, first->box.height);
  const cv::Rect part = cv::Rect(cv::Point(int(scale * (first->box.x - margin)), int(scale * (first->box.y - margin))),
                                 cv::Point(int(std::ceil(scale * (first->box.br().x + margin))),
                                           int(std::ceil(scale * (first->box.br().y + margin))))) &
                        whole;
  constexpr double kLarge = 0.8;
  if (std::max(part.width, part.height) > kLarge * std::max(whole.width, whole.height)) return first->score;
  numbers = MeasuredColours(picture, part);
  InvertDark(numbers);
  const std::optional<MeasuredContent> close = MeasureContent(numbers);
  return close ? close->score : first->score;
}

}  // namespace

double LineArtScore(const Image& picture) {
  DAUMIER_CHECK(!picture.pixels.empty(), "the picture is empty");
  double score = ScoreOfSheet(picture);
  if (score >= kLeastLineArt) return score;
  const Image small = SmallCopy(picture);
  const std::vector<PhotoSheet> sheets = FindSheets(small);
  if (!sheets.empty()) score = std::max(score, ScoreOfSheet(RectifySheet(small, sheets.front())));
  return score;
}

}  // namespace daumier::render

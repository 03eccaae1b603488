#include "render/ruling.h"

#include "core/statistics.h"
#include "render/opencv_bridge.h"
#include "render/ruled_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace daumier::render {
namespace {

/// Side of the window whose brightest pixel is the paper, in pixels: wider than a ruled line, narrower than a square.
constexpr int kPaperWindow = 7;
/// Darkness of a ruled line, of 255: at least, and in deviations of the darkness of all pixels.
constexpr double kLeastDarkness = 5.0, kNumDeviations = 3.0;
/// Share of its length on which a line alone is dark.
constexpr double kLoneCover = 0.85;
/// Half the width of the band along a line in which its profile is measured, and distance between the profile's
/// samples, in pixels.
constexpr double kBandReach = 4.0, kProfileStep = 0.5;
/// Stretches of a line, each of which has its own offset, and how far that may be from the line's.
constexpr int kNumStretches = 12;
constexpr double kMaxBend = 2.0;
/// A pixel whose brightness is this share below that of the line alone is wholly the drawing's.
constexpr double kDrawingShare = 0.2;
/// Brightness against the paper's below which a profile belongs to the line.
constexpr double kLineEdge = 0.97;
/// Cosine between colours, as what they take from the paper's, above which they are the same.
constexpr double kSameColour = 0.93;
/// Share of the darkest values that the drawing's pixels have.
constexpr double kInkShare = 0.5;
/// Brightness against the paper's, in its lightest channel, below which a line hides ink.
constexpr double kHidesInk = 0.5;
/// Largest shift along a line of ink on its other side, in widths of the line.
constexpr double kMaxShift = 1.0;

/// What is darker than the paper near by, in the channel in which it is darkest.
cv::Mat DarknessOfLines(const cv::Mat& picture) {
  cv::Mat paper, difference;
  cv::morphologyEx(picture, paper, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {kPaperWindow, kPaperWindow}));
  cv::subtract(paper, picture, difference);
  if (difference.channels() == 1) return difference;
  std::vector<cv::Mat> channels;
  cv::split(difference, channels);
  return cv::max(channels[0], cv::max(channels[1], channels[2]));
}

cv::Mat DarkerThanNoise(const cv::Mat& darkness) {
  std::vector<double> values;
  for (auto value = darkness.begin<uint8_t>(); value != darkness.end<uint8_t>(); ++value) values.push_back(*value);
  const double median = Median(values);
  for (double& value : values) value = std::abs(value - median);
  return darkness > std::max(kLeastDarkness, median + kNumDeviations * 1.4826 * Median(values));
}

using PageColour = cv::Vec3d;

PageColour ColourAt(const cv::Mat& picture, int row, int column) {
  if (picture.channels() == 1) return PageColour::all(picture.at<uint8_t>(row, column));
  return picture.at<cv::Vec3b>(row, column);
}

double CosineBetween(const PageColour& a, const PageColour& b) {
  const double norms = cv::norm(a) * cv::norm(b);
  return norms > 0.0 ? a.dot(b) / norms : 1.0;
}

/// The picture and its paper, and the drawing's colour as what it takes from the paper's.
struct Page {
  cv::Mat picture, paper;
  PageColour ink;

  PageColour Taken(int row, int column) const { return ColourAt(paper, row, column) - ColourAt(picture, row, column); }
};

Page PageOf(const cv::Mat& picture, const cv::Mat& darkness) {
  Page page{picture, {}, PageColour::all(0)};
  cv::morphologyEx(picture, page.paper, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {2 * kPaperWindow + 1, 2 * kPaperWindow + 1}));
  double darkest = 0.0;
  cv::minMaxLoc(darkness, nullptr, &darkest);
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      if (darkness.at<uint8_t>(row, column) >= kInkShare * darkest) page.ink += page.Taken(row, column);
    }
  }
  return page;
}

/// The offset of a line's dark pixels from it, in pieces along it.
std::array<double, kNumStretches> BendsOf(const cv::Mat& is_dark, const RuledLine& line) {
  std::array<double, kNumStretches> bends{};
  for (int stretch = 0; stretch < kNumStretches; ++stretch) {
    const int from = stretch * is_dark.cols / kNumStretches, to = (stretch + 1) * is_dark.cols / kNumStretches;
    std::vector<double> offsets;
    for (int column = from; column < to; ++column) {
      const double row = line.RowAt(column + 0.5 - 0.5 * is_dark.cols) + 0.5 * is_dark.rows;
      double sum = 0.0, count = 0.0;
      for (int r = static_cast<int>(std::ceil(row - kMaxBend - 0.5)); r + 0.5 <= row + kMaxBend; ++r) {
        if (r < 0 || r >= is_dark.rows || is_dark.at<uint8_t>(r, column) == 0) continue;
        sum += r + 0.5 - row;
        count += 1.0;
      }
      if (count > 0.0) offsets.push_back(sum / count);
    }
    if (3 * std::ssize(offsets) > to - from) bends[stretch] = Median(offsets);
  }
  // Strokes along the line have offsets of their own: a line through medians leaves them out [Theil 1950].
  std::vector<double> slopes, levels;
  for (int i = 0; i < kNumStretches; ++i) {
    for (int j = i + 1; j < kNumStretches; ++j) slopes.push_back((bends[j] - bends[i]) / (j - i));
  }
  const double slope = Median(slopes);
  for (int i = 0; i < kNumStretches; ++i) levels.push_back(bends[i] - slope * i);
  const double level = Median(levels);
  for (int i = 0; i < kNumStretches; ++i) bends[i] = level + slope * i;
  return bends;
}

/// Replaces a line by the paper.
class LineRemover {
 public:
  LineRemover(const Page& page, const cv::Mat& is_dark, const RuledLine& line)
      : page_(page), line_(line), bends_(BendsOf(is_dark, line)) {
    Measure();
  }

  /// Whether its colour is another than the drawing's.
  bool HasOwnColour() const { return CosineBetween(taken_, page_.ink) < kSameColour; }

  void RemoveFrom(cv::Mat& picture) const {
    const double half_width = HalfWidth();
    if (half_width <= 0.0) return;
    const bool hides_ink = HidesInk();
    for (int column = 0; column < picture.cols; ++column) {
      const double centre = RowAt(column);
      const int first = std::max(0, static_cast<int>(std::ceil(centre - kBandReach - 0.5)));
      for (int row = first; row < picture.rows && row + 0.5 <= centre + kBandReach; ++row) {
        const PageColour alone = DarkestNear(row + 0.5 - centre);
        const PageColour paper = ColourAt(page_.paper, row, column), pixel = ColourAt(page_.picture, row, column);
        double drawing = 0.0;
        for (int channel = 0; channel < picture.channels(); ++channel) {
          const double ratio = pixel[channel] / std::max(1.0, paper[channel]);
          drawing = std::max(drawing, (alone[channel] - ratio) / (kDrawingShare * alone[channel]));
        }
        const double share = std::clamp(drawing, 0.0, 1.0);
        const PageColour bridge = hides_ink ? DarkAcross(row, column, centre, half_width) : PageColour::all(255.0);
        for (int channel = 0; channel < picture.channels(); ++channel) {
          const double value = std::min((1.0 - share) * paper[channel] + share * pixel[channel], bridge[channel]);
          uint8_t& target = picture.ptr<uint8_t>(row)[column * picture.channels() + channel];
          target = static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
        }
      }
    }
  }

 private:
  static constexpr int kNumSamples = static_cast<int>(2.0 * kBandReach / kProfileStep) + 1;

  double RowAt(int column) const {
    const double place = (column + 0.5) * kNumStretches / page_.picture.cols - 0.5;
    const int left = std::clamp(static_cast<int>(std::floor(place)), 0, kNumStretches - 1);
    const int right = std::min(left + 1, kNumStretches - 1);
    const double t = std::clamp(place - left, 0.0, 1.0);
    const double bend = (1.0 - t) * bends_[left] + t * bends_[right];
    return line_.RowAt(column + 0.5 - 0.5 * page_.picture.cols) + 0.5 * page_.picture.rows + bend;
  }

  /// The median along the line of brightness over the paper's, for each distance from it.
  void Measure() {
    const int channels = page_.picture.channels();
    std::array<std::array<std::vector<double>, 3>, kNumSamples> values;
    for (int column = 0; column < page_.picture.cols; ++column) {
      const double centre = RowAt(column);
      const int first = std::max(0, static_cast<int>(std::ceil(centre - kBandReach - 0.5)));
      for (int row = first; row < page_.picture.rows && row + 0.5 <= centre + kBandReach; ++row) {
        const auto sample = std::lround((row + 0.5 - centre + kBandReach) / kProfileStep);
        const PageColour paper = ColourAt(page_.paper, row, column), pixel = ColourAt(page_.picture, row, column);
        for (int channel = 0; channel < channels; ++channel) {
          values[sample][channel].push_back(pixel[channel] / std::max(1.0, paper[channel]));
        }
      }
    }
    for (int sample = 0; sample < kNumSamples; ++sample) {
      profile_[sample] = PageColour::all(1.0);
      for (int channel = 0; channel < channels; ++channel) {
        auto& ratios = values[sample][channel];
        if (!ratios.empty()) profile_[sample][channel] = std::clamp(Median(ratios), 0.02, 1.0);
      }
      if (channels == 1) profile_[sample] = PageColour::all(profile_[sample][0]);
    }
    // A sample without pixels, as where the line is along a row, is between its neighbours.
    for (int sample = 1; sample + 1 < kNumSamples; ++sample) {
      if (values[sample][0].empty()) profile_[sample] = 0.5 * (profile_[sample - 1] + profile_[sample + 1]);
    }
    for (const PageColour& ratio : profile_) taken_ += PageColour::all(1.0) - ratio;
  }

  PageColour Profile(double distance) const {
    const double place = std::clamp((distance + kBandReach) / kProfileStep, 0.0, kNumSamples - 1.0);
    const int left = std::min(static_cast<int>(place), kNumSamples - 2);
    return (1.0 - (place - left)) * profile_[left] + (place - left) * profile_[left + 1];
  }

  /// The profile's least value within half a pixel: the place of the line is not exact.
  PageColour DarkestNear(double distance) const {
    PageColour darkest = Profile(distance);
    for (const double offset : {-0.5, 0.5}) {
      const PageColour other = Profile(distance + offset);
      for (int channel = 0; channel < 3; ++channel) darkest[channel] = std::min(darkest[channel], other[channel]);
    }
    return darkest;
  }

  /// Half the distance between the outermost samples that belong to the line, connected with its middle.
  double HalfWidth() const {
    constexpr int kMiddle = kNumSamples / 2;
    const auto is_line = [&](int sample) {
      return std::min({profile_[sample][0], profile_[sample][1], profile_[sample][2]}) < kLineEdge;
    };
    int reach = 0;
    for (int sample = 0; sample < kNumSamples; ++sample) {
      if (is_line(sample) && std::abs(sample - kMiddle) <= kMiddle - 1) {
        reach = std::max(reach, std::abs(sample - kMiddle) + 1);
      }
    }
    return reach * kProfileStep;
  }

  /// Whether the line is nearly as dark as ink.
  bool HidesInk() const {
    double darkest = 1.0;
    for (const PageColour& ratio : profile_) darkest = std::min(darkest, std::max({ratio[0], ratio[1], ratio[2]}));
    return darkest < kHidesInk;
  }

  /// The lightest of what is on both sides of the line where one straight stroke can cross it: dark if one does.
  PageColour DarkAcross(int row, int column, double centre, double half_width) const {
    PageColour darkest = PageColour::all(255.0);
    const double above = row + 0.5 - (centre - half_width - 0.5), below = centre + half_width + 0.5 - (row + 0.5);
    if (above <= 0.0 || below <= 0.0) return darkest;
    const int row_above = static_cast<int>(std::floor(centre - half_width - 0.5));
    const int row_below = static_cast<int>(std::floor(centre + half_width + 0.5));
    if (row_above < 0 || row_below >= page_.picture.rows) return darkest;
    const double reach = kMaxShift * (above + below);
    for (double shift = -reach; shift <= reach; shift += 1.0) {
      const int column_above = static_cast<int>(std::lround(column - shift * above / (above + below)));
      const int column_below = static_cast<int>(std::lround(column + shift * below / (above + below)));
      if (std::min(column_above, column_below) < 0) continue;
      if (std::max(column_above, column_below) >= page_.picture.cols) continue;
      const PageColour a = ColourAt(page_.picture, row_above, column_above),
                       b = ColourAt(page_.picture, row_below, column_below);
      for (int channel = 0; channel < 3; ++channel) {
        darkest[channel] = std::min(darkest[channel], std::max(a[channel], b[channel]));
      }
    }
    return darkest;
  }

  const Page& page_;
  RuledLine line_;
  std::array<double, kNumStretches> bends_;
  std::array<PageColour, kNumSamples> profile_;
  PageColour taken_ = PageColour::all(0.0);
};

/// Replaces those of the lines near the rows that are the page by the paper.
void RemoveLines(cv::Mat& picture, const cv::Mat& darkness, const cv::Mat& is_dark, const std::vector<RuledLine>& lines,
                 const std::vector<RuledLine>& regular, bool is_page_ruled) {
  for (const RuledLine& line : lines) {
    const Page page = PageOf(picture.clone(), darkness);
    const LineRemover remover(page, is_dark, line);
    const bool is_regular =
        std::any_of(regular.begin(), regular.end(), [&](const RuledLine& other) { return other.v == line.v; });
    const bool is_lone = line.cover >= kLoneCover && (is_page_ruled || remover.HasOwnColour());
    if (is_regular || is_lone) remover.RemoveFrom(picture);
  }
}

Image MaskFrom(const cv::Mat& is_dark) {
  Image mask(is_dark.rows, is_dark.cols, 1);
  is_dark.copyTo(MatView(mask));
  return mask;
}

}  // namespace

Image WithoutRuling(const Image& picture) {
  constexpr int kMinSide = 64;
  if (std::min(picture.height, picture.width) < kMinSide) return picture;
  Image result = picture;
  cv::Mat view = MatView(result);
  const cv::Mat darkness = DarknessOfLines(view), is_dark = DarkerThanNoise(darkness);
  cv::Mat turned_darkness, turned_is_dark;
  cv::transpose(darkness, turned_darkness);
  cv::transpose(is_dark, turned_is_dark);
  const std::vector<RuledLine> rows = LinesNearRows(MaskFrom(is_dark)),
                               columns = LinesNearRows(MaskFrom(turned_is_dark));
  const std::vector<RuledLine> regular_rows = RegularLines(rows), regular_columns = RegularLines(columns);
  const bool is_page_ruled = !regular_rows.empty() || !regular_columns.empty();
  if (!rows.empty()) RemoveLines(view, darkness, is_dark, rows, regular_rows, is_page_ruled);
  if (!columns.empty()) {
    cv::Mat turned;
    cv::transpose(view, turned);
    RemoveLines(turned, turned_darkness, turned_is_dark, columns, regular_columns, is_page_ruled);
    cv::transpose(turned, view);
  }
  return result;
}

}  // namespace daumier::render

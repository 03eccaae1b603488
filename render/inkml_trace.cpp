#include "render/inkml_trace.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace daumier::render {
namespace {

/// Channels of a point; more are no ink.
constexpr int kMostChannels = 64;

/// Decodes the values of one channel.
class ChannelDecoder {
 public:
  void SetOrder(int order) { order_ = order; }
  /// A number of the current order; its value becomes that of the channel.
  void Take(double number) {
    given_ = number;
    if (order_ == 0) {
      velocity_ = number - value_;
      value_ = number;
      return;
    }
    velocity_ = order_ == 1 ? number : velocity_ + number;
    value_ += velocity_;
  }
  void Repeat() { Take(given_); }
  double value() const { return value_; }

 private:
  int order_ = 0;  ///< Of the differences that are given.
  double given_ = 0.0, velocity_ = 0.0, value_ = 0.0;
};

/// Reads one value after the other.
class TraceText {
 public:
  explicit TraceText(std::string_view text) : rest_(text) { SkipSpace(); }

  bool AtEnd() const { return rest_.empty(); }
  bool Skip(char c) {
    if (rest_.empty() || rest_[0] != c) return false;
    rest_.remove_prefix(1);
    SkipSpace();
    return true;
  }
  std::optional<int> Order() {
    for (const auto& [prefix, order] : {std::pair{'!', 0}, {'\'', 1}, {'"', 2}})
      if (Skip(prefix)) return order;
    return std::nullopt;
  }
  double Number() {
    double value = 0.0;
    const char* const end_of_text = rest_.data() + rest_.size();
    std::from_chars_result result{};
    if (rest_.starts_with('#')) {
      long hexadecimal = 0;
      result = std::from_chars(rest_.data() + 1, end_of_text, hexadecimal, 16);
      value = double(hexadecimal);
    } else {
      const bool plus = rest_.starts_with('+') && !rest_.starts_with("+-");
      result = std::from_chars(rest_.data() + (plus ? 1 : 0), end_of_text, value);
    }
    DAUMIER_CHECK(result.ec == std::errc() && std::isfinite(value), "'{}' is not a value of a trace",
                  rest_.substr(0, 20));
    rest_.remove_prefix(size_t(result.ptr - rest_.data()));
    SkipSpace();
    return value;
  }

 private:
  void SkipSpace() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size())); }
  std::string_view rest_;
};

}  // namespace

std::vector<Eigen::Vector2d> ParseInkMlTrace(std::string_view content, const InkMlChannels& channels) {
  std::array<ChannelDecoder, kMostChannels> decoders;
  std::vector<Eigen::Vector2d> points;
  TraceText text(content);
  while (!text.AtEnd()) {
    int channel = 0;
    bool has_x = false, has_y = false;
    for (; !text.AtEnd() && !text.Skip(','); ++channel) {
      DAUMIER_CHECK(channel < kMostChannels, "a point has more than {} values", kMostChannels);
      ChannelDecoder& decoder = decoders[size_t(channel)];
      if (const auto order = text.Order()) decoder.SetOrder(*order);
      bool recorded = true;
      if (text.Skip('?')) {
        recorded = false;
      } else if (text.Skip('*')) {
        decoder.Repeat();
      } else if (text.Skip('T') || text.Skip('F')) {
        recorded = false;
      } else {
        decoder.Take(text.Number());
      }
      has_x = has_x || (channel == channels.x && recorded);
      has_y = has_y || (channel == channels.y && recorded);
    }
    if (!has_x || !has_y) continue;
    const Eigen::Vector2d point(channels.x_sign * decoders[size_t(channels.x)].value(),
                                channels.y_sign * decoders[size_t(channels.y)].value());
    DAUMIER_CHECK(point.cast<float>().allFinite(), "a point of a trace is ({}, {})", point.x(), point.y());
    points.push_back(point);
  }
  return points;
}

}  // namespace daumier::render

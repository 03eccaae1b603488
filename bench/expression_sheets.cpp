// Counts and pictures of the expressions of rigged heads:
//   expression_sheets SOURCE PATH OUT [FACES]
// SOURCE is ict or makehuman, PATH as source.path. Prints how lids and lips fit on FACES (50) caricatures of amount 3,
// and writes to OUT the 52 expressions of one person, the same of a caricature by transfer and as plain offsets, and 20
// pairs of expressions used together.
#include "core/error.h"
#include "faces/controls/caricature_generator.h"
#include "faces/finished_head.h"
#include "faces/source.h"
#include "geometry/flips.h"
#include "render/sheet.h"
#include "reports/face_surface.h"
#include "rig/arkit_names.h"
#include "rig/expression_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

constexpr int kCell = 210, kPopulation = 60;
constexpr double kCaricature = 3, kGapMm = 0.3, kSinkMm = 0.05;

struct Weight {
  std::string name;
  double weight = 1;
};
using Weights = std::vector<Weight>;

Weights Both(const std::string& name, double weight = 1) {
  return {{name + "Left", weight}, {name + "Right", weight}};
}
Weights operator+(Weights a, const Weights& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Pair {
  const char* caption;
  Weights weights;
};
std::vector<Pair> Pairs() {
  const Weights jaw = {{"jawOpen", 0.6}}, funnel = {{"mouthFunnel"}}, pucker = {{"mouthPucker"}};
  return {{"jawOpen + smile", jaw + Both("mouthSmile")},
          {"blink + squint", Both("eyeBlink") + Both("eyeSquint")},
          {"blink + lookDown", Both("eyeBlink") + Both("eyeLookDown")},
          {"blink + wide", Both("eyeBlink") + Both("eyeWide")},
          {"browDown + squint", Both("browDown") + Both("eyeSquint")},
          {"jawOpen + pucker", jaw + pucker},
          {"jawOpen + funnel", jaw + funnel},
          {"funnel + pucker", funnel + pucker},
          {"smile + frown", Both("mouthSmile") + Both("mouthFrown")},
          {"smile + cheekSquint", Both("mouthSmile") + Both("cheekSquint")},
          {"sneer + upperUp", Both("noseSneer") + Both("mouthUpperUp")},
          {"upperUp + lowerDown", Both("mouthUpperUp") + Both("mouthLowerDown")},
          {"jawOpen + close", {{"jawOpen", 0.6}, {"mouthClose", 0.6}}},
          {"jawLeft + jawOpen", jaw + Weights{{"jawLeft"}}},
          {"browInnerUp + browDown", Weights{{"browInnerUp"}} + Both("browDown")},
          {"wide + browOuterUp", Both("eyeWide") + Both("browOuterUp")},
          {"blink + smile + cheekSquint", Both("eyeBlink") + Both("mouthSmile") + Both("cheekSquint")},
          {"rolls + press", Weights{{"mouthRollLower"}, {"mouthRollUpper"}} + Both("mouthPress")},
          {"stretch + jawOpen", jaw + Both("mouthStretch")},
          {"squint + lookUp", Both("eyeSquint") + Both("eyeLookUp")}};
}

class Subject {
 public:
  explicit Subject(const faces::FaceModel& model)
      : model_(model),
        expressions_(model),
        head_(model.face_template),
        mm_(faces::MillimetresPerCm(model.face_template)) {
    std::vector<geometry::Points> population;
    for (int i = 0; i < kPopulation; ++i) {
      Rng rng = Stream(1, "population", i);
      population.push_back(faces::IdentityFace(model, faces::DrawIdentity(model, rng)));
    }
    generator_.emplace(model.face_template, population, faces::CaricatureOptions{}, faces::ExaggerationOptions{});
  }

  const rig::ExpressionTargets& expressions() const { return expressions_; }
  double mm() const { return mm_; }

  geometry::Points Person(int i) const {
    Rng rng = Stream(1, "identity", i);
    return faces::IdentityFace(model_, faces::DrawIdentity(model_, rng));
  }
  geometry::Points Caricature(int i) const {
    const geometry::Points person = Person(i);
    Rng rng = Stream(1, "caricature", i);
    return generator_->Make(person, kCaricature, generator_->DrawValues(person, kCaricature, rng)).face;
  }

  /// The face with eyeballs that stay.
  render::Image Picture(const geometry::Points& neutral, const geometry::Points& pose) const {
    const auto& landmarks = model_.face_template.annotation.landmarks;
    // Between ear and nose, so that a turn keeps it in the middle.
    const double height = neutral(landmarks[27], 1) - neutral(landmarks[8], 1);
    const Eigen::Vector3d centre(0, neutral(landmarks[29], 1), neutral(landmarks[29], 2) - 0.6 * height);
    render::RenderInput input = reports::InputOf(head_, pose);
    input.surface.vertices = head_.Vertices(pose, head_.Eyeballs(neutral));
    return render::RenderMesh(input, render::TurnedCamera(centre, 0.95 * height, kCell, 15));
  }

 private:
  const faces::FaceModel& model_;
  rig::ExpressionTargets expressions_;
  faces::FinishedHead head_;
  double mm_;
  std::optional<faces::CaricatureGenerator> generator_;
};

geometry::Points PoseOf(const geometry::Points& neutral, const Eigen::MatrixXf& offsets, const Weights& weights) {
  geometry::Points pose = neutral;
  for (const auto& [name, weight] : weights) {
    const Eigen::VectorXd offset = weight * offsets.col(rig::FindArkitName(name).value()).cast<double>();
    Eigen::Map<Eigen::VectorXd>(pose.data(), pose.size()) += offset;
  }
  return pose;
}

/// The worst of each kind, mm, and how many are beyond the limit.
struct Tally {
  const char* name;
  double limit, worst = 0;
  int num = 0, num_bad = 0;
  void Add(double value) {
    worst = std::max(worst, value);
    ++num;
    num_bad += value > limit;
  }
};

void CountContact(const Subject& subject, int num_faces) {
  Tally gap{"gap of lids, eyeBlink 1", kGapMm}, sink{"depth of lids in the ball, eyeBlink 1", kSinkMm},
      way{"depth on the way, eyeBlink 0.2 .. 0.8", kSinkMm}, look{"depth with eyeLook 0.5 and 1, eye turned", kSinkMm},
      close{"gap of lips, jawOpen 1 + mouthClose 1", kGapMm}, rest{"height between lips, neutral", kGapMm},
      half{"height between lips, jawOpen 0.5 + mouthClose 0.5", kGapMm}, press{"gap of lips, mouthPress both", kGapMm},
      cross{"lips crossed, closed or pressed", 0.1}, both{"lids crossed, blink 0.75 + squint", 0.1},
      down{"lids crossed, blink 0.5 + lookDown", 0.1};
  const rig::FaceContact& contact = subject.expressions().contact();
  const double mm = subject.mm();
  const auto greatest = [&](const std::vector<double>& values) { return mm * *std::ranges::max_element(values); };
  const auto least = [&](const std::vector<double>& values) { return mm * *std::ranges::min_element(values); };
  for (int i = 0; i < num_faces; ++i) {
    const geometry::Points face = subject.Caricature(i);
    const Eigen::MatrixXf offsets = subject.expressions().On(face).offsets;
    for (const auto& eye : contact.eyes()) {
      const faces::Eyeball ball = eye.fit.Fit(face);
      const rig::SeamFrame frame = eye.Frame(face, ball);
      const auto depth = [&](const Weights& weights, const Eigen::Vector3d& gaze) {
        return -mm * eye.skin.LeastClearance(ball, gaze, PoseOf(face, offsets, weights));
      };
      const Eigen::Vector3d front = Eigen::Vector3d::UnitZ();
      const std::string blink = "eyeBlink" + eye.side;
      gap.Add(greatest(eye.lids.Gaps(PoseOf(face, offsets, {{blink}}))));
      sink.Add(depth({{blink}}, front));
      for (const double weight : {0.2, 0.4, 0.6, 0.8}) way.Add(depth({{blink, weight}}, front));
      const double out = eye.side == "Left" ? rig::kGazeDegrees : -rig::kGazeDegrees;
      for (const double weight : {0.5, 1.0}) {
        look.Add(depth({{"eyeLookDown" + eye.side, weight}}, rig::GazeOf(0, weight * rig::kGazeDegrees)));
        look.Add(depth({{"eyeLookUp" + eye.side, weight}}, rig::GazeOf(0, -weight * rig::kGazeDegrees)));
        look.Add(depth({{"eyeLookOut" + eye.side, weight}}, rig::GazeOf(weight * out, 0)));
        look.Add(depth({{"eyeLookIn" + eye.side, weight}}, rig::GazeOf(-weight * out, 0)));
      }
      both.Add(-least(
          eye.lids.Heights(frame, PoseOf(face, offsets, {{blink, rig::BlinkLimit(1, 0)}, {"eyeSquint" + eye.side}}))));
      down.Add(-least(eye.lids.Heights(
          frame, PoseOf(face, offsets, {{blink, rig::BlinkLimit(0, 1)}, {"eyeLookDown" + eye.side}}))));
    }
    const rig::SeamFrame frame = contact.LipFrame(face);
    const geometry::Points closed = PoseOf(face, offsets, {{"jawOpen"}, {"mouthClose"}}),
                           pressed = PoseOf(face, offsets, Both("mouthPress"));
    close.Add(greatest(contact.lips().Gaps(closed)));
    rest.Add(greatest(contact.lips().Heights(frame, face)));
    half.Add(greatest(contact.lips().Heights(frame, PoseOf(face, offsets, {{"jawOpen", 0.5}, {"mouthClose", 0.5}}))));
    press.Add(greatest(contact.lips().Gaps(pressed)));
    cross.Add(-std::min(least(contact.lips().Heights(frame, closed)), least(contact.lips().Heights(frame, pressed))));
  }
  std::printf("%d faces of amount %g; mm at 200 mm a face\n", num_faces, kCaricature);
  for (const Tally& tally : {gap, sink, way, look, close, rest, half, press, cross, both, down})
    std::printf("%-50s worst %6.2f  beyond %.2f: %d of %d\n", tally.name, tally.worst, tally.limit, tally.num_bad,
                tally.num);
}

void WriteAll(const Subject& subject, const geometry::Points& face, const fs::path& path) {
  const Eigen::MatrixXf offsets = subject.expressions().On(face).offsets;
  std::vector<render::SheetCell> cells = {{subject.Picture(face, face), "neutral"}};
  for (const std::string_view name : rig::ArkitNames())
    cells.push_back({subject.Picture(face, PoseOf(face, offsets, {{std::string(name)}})), std::string(name)});
  render::WriteImage(path, render::MakeSheet(cells, 9, {.text_height = 13}), 70);
}

/// Above: the template's own displacements added to the face. Below: transferred.
void WriteTransfer(const Subject& subject, const faces::FaceModel& model, const geometry::Points& face,
                   const fs::path& path) {
  const std::vector<Pair> poses = {{"neutral", {}},
                                   {"jawOpen", {{"jawOpen"}}},
                                   {"eyeBlink", Both("eyeBlink")},
                                   {"mouthSmile", Both("mouthSmile")},
                                   {"mouthFunnel", {{"mouthFunnel"}}},
                                   {"browInnerUp", {{"browInnerUp"}}}};
  std::vector<render::SheetCell> cells;
  for (const Eigen::MatrixXf& offsets : {rig::ArkitShapesOf(model).shapes, subject.expressions().On(face).offsets})
    for (const auto& [caption, weights] : poses)
      cells.push_back({subject.Picture(face, PoseOf(face, offsets, weights)), caption});
  render::WriteImage(path, render::MakeSheet(cells, int(poses.size()), {.row_titles = {"plain offsets", "transfer"}}),
                     82);
}

void WritePairs(const Subject& subject, const faces::FaceModel& model, const geometry::Points& person,
                const geometry::Points& caricature, const fs::path& path) {
  std::vector<render::SheetCell> cells;
  for (const geometry::Points& face : {person, caricature}) {
    const Eigen::MatrixXf offsets = subject.expressions().On(face).offsets;
    for (const auto& [caption, weights] : Pairs()) {
      const geometry::Points pose = PoseOf(face, offsets, weights);
      std::printf("%-28s %d triangles flip\n", caption,
                  geometry::CountFlippedTriangles(face, pose, model.face_template.triangles));
      cells.push_back({subject.Picture(face, pose), caption});
    }
  }
  render::WriteImage(path, render::MakeSheet(cells, 10, {.text_height = 12}), 75);
}

int Run(const std::vector<std::string>& words) {
  if (words.size() < 3) throw UsageError("expression_sheets SOURCE PATH OUT [FACES]");
  const faces::FaceModel model = faces::LoadFaceModel({.name = words[0], .path = words[1]});
  const fs::path out = words[2];
  fs::create_directories(out);
  const Subject subject(model);
  for (const std::string& warning : subject.expressions().warnings()) std::printf("%s\n", warning.c_str());
  CountContact(subject, words.size() > 3 ? std::stoi(words[3]) : 50);
  const geometry::Points person = subject.Person(1), caricature = subject.Caricature(1);
  WriteAll(subject, person, out / ("expressions_" + words[0] + ".jpg"));
  WriteTransfer(subject, model, caricature, out / ("transfer_" + words[0] + ".jpg"));
  WritePairs(subject, model, person, caricature, out / ("pairs_" + words[0] + ".jpg"));
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

// Pictures of the expressions of rigged heads, as they are shipped:
//   expression_sheets SOURCE PATH OUT [PIXELS]
// SOURCE is ict or makehuman, PATH as source.path. Writes to OUT the 52 expressions of one person and of a caricature,
// the caricature's by transfer and as plain offsets, and 20 pairs of expressions used together, pictures of PIXELS (210)
// a side; and prints how many triangles flip.
#include "bench/expression_subject.h"
#include "core/error.h"
#include "geometry/flips.h"
#include "render/camera.h"
#include "render/sheet.h"
#include "reports/rigged_head.h"
#include "rig/head_pose.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

struct Pair {
  const char* caption;
  ExpressionWeights weights;
};
std::vector<Pair> Pairs() {
  const ExpressionWeights jaw = {{"jawOpen", 0.6}}, funnel = {{"mouthFunnel", 1}}, pucker = {{"mouthPucker", 1}};
  return {{"jawOpen + smile", jaw + Both("mouthSmile")},
          {"blink, limited + squint", Both("eyeBlink", rig::BlinkLimit(1, 0)) + Both("eyeSquint")},
          {"blink, limited + lookDown", Both("eyeBlink", rig::BlinkLimit(0, 1)) + Both("eyeLookDown")},
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
          {"jawLeft + jawOpen", jaw + ExpressionWeights{{"jawLeft", 1}}},
          {"browInnerUp + browDown", ExpressionWeights{{"browInnerUp", 1}} + Both("browDown")},
          {"wide + browOuterUp", Both("eyeWide") + Both("browOuterUp")},
          {"blink + smile + cheekSquint", Both("eyeBlink") + Both("mouthSmile") + Both("cheekSquint")},
          {"rolls + press", ExpressionWeights{{"mouthRollLower", 1}, {"mouthRollUpper", 1}} + Both("mouthPress")},
          {"stretch + jawOpen", jaw + Both("mouthStretch")},
          {"squint + lookUp", Both("eyeSquint") + Both("eyeLookUp")}};
}

/// A face's head in pictures, close to its face.
class Pictures {
 public:
  Pictures(const ExpressionSubject& subject, const geometry::Points& neutral, const rig::MorphTargets& targets,
           int size)
      : names_(targets.names), pictures_(subject.head_rig().On(neutral, targets)) {
    const auto& landmarks = subject.model().face_template.annotation.landmarks;
    // Between ear and nose, so that a turn keeps it in the middle.
    const double height = neutral(landmarks[27], 1) - neutral(landmarks[8], 1);
    const Eigen::Vector3d centre(neutral(landmarks[29], 0), neutral(landmarks[29], 1),
                                 neutral(landmarks[29], 2) - 0.6 * height);
    camera_ = render::TurnedCamera(centre, 0.95 * height, size, 15);
  }

  /// Eyes turn with eyeLook*.
  render::Image Draw(const ExpressionWeights& weights) const {
    rig::WeightsClip clip;
    clip.names = names_;
    clip.weights = Eigen::MatrixXf::Zero(1, std::ssize(names_));
    for (const auto& [name, weight] : weights) clip.weights(0, *rig::FindArkitName(name)) += float(weight);
    return pictures_.Draw(rig::PosesOf(clip, names_).front(), camera_);
  }

 private:
  std::vector<std::string> names_;
  reports::RiggedHeadPictures pictures_;
  render::Camera camera_;
};

struct SheetPlace {
  fs::path folder;
  std::string source;
  int size;
  fs::path File(const char* name) const { return folder / fmt::format("{}_{}.jpg", name, source); }
};

void WriteAll(const ExpressionSubject& subject, const geometry::Points& face, const SheetPlace& place,
              const char* name) {
  const Pictures pictures(subject, face, subject.expressions().On(face), place.size);
  std::vector<render::SheetCell> cells = {{pictures.Draw({}), "neutral"}};
  for (const std::string_view expression : rig::ArkitNames())
    cells.push_back({pictures.Draw({{std::string(expression), 1}}), std::string(expression)});
  render::WriteImage(place.File(name), render::MakeSheet(cells, 9, {.text_height = 13}), 70);
}

/// Above: the template's own displacements added to the face. Below: transferred.
void WriteTransfer(const ExpressionSubject& subject, const geometry::Points& face, const SheetPlace& place) {
  const std::vector<Pair> poses = {{"neutral", {}},
                                   {"jawOpen", {{"jawOpen", 1}}},
                                   {"eyeBlink", Both("eyeBlink")},
                                   {"mouthSmile", Both("mouthSmile")},
                                   {"mouthFunnel", {{"mouthFunnel", 1}}},
                                   {"browInnerUp", {{"browInnerUp", 1}}}};
  const rig::MorphTargets transferred = subject.expressions().On(face),
                          plain = {transferred.names, rig::ArkitShapesOf(subject.model()).shapes};
  std::vector<render::SheetCell> cells;
  for (const rig::MorphTargets* targets : {&plain, &transferred}) {
    const Pictures pictures(subject, face, *targets, place.size);
    for (const auto& [caption, weights] : poses) cells.push_back({pictures.Draw(weights), caption});
  }
  render::WriteImage(place.File("transfer"),
                     render::MakeSheet(cells, int(poses.size()), {.row_titles = {"plain offsets", "transfer"}}), 82);
}

void WritePairs(const ExpressionSubject& subject, const std::vector<geometry::Points>& faces, const SheetPlace& place) {
  std::vector<render::SheetCell> cells;
  for (const geometry::Points& face : faces) {
    const rig::MorphTargets targets = subject.expressions().On(face);
    const Pictures pictures(subject, face, targets, place.size);
    for (const auto& [caption, weights] : Pairs()) {
      fmt::print("{:<28} {} triangles flip\n", caption,
                 geometry::CountFlippedTriangles(face, PoseOf(face, targets, weights),
                                                 subject.model().face_template.triangles));
      cells.push_back({pictures.Draw(weights), caption});
    }
  }
  render::WriteImage(place.File("pairs"), render::MakeSheet(cells, 10, {.text_height = 12}), 75);
}

int Run(const std::vector<std::string>& words) {
  if (words.size() < 3) throw UsageError("expression_sheets SOURCE PATH OUT [PIXELS]");
  const ExpressionSubject subject({.name = words[0], .path = words[1]});
  const SheetPlace place{words[2], words[0], words.size() > 3 ? std::stoi(words[3]) : 210};
  fs::create_directories(place.folder);
  for (const std::string& warning : subject.expressions().warnings()) fmt::print("{}\n", warning);
  const geometry::Points person = subject.Person(1), caricature = subject.Caricature(1);
  WriteAll(subject, person, place, "expressions");
  WriteAll(subject, caricature, place, "expressions_caricature");
  WriteTransfer(subject, caricature, place);
  WritePairs(subject, {person, caricature}, place);
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

// Not a benchmark: the tables and sheets of docs/results/heads.md on fine alignment.
//   portrait_alignment WEIGHTS DATA OUT [key=value ...]
// WEIGHTS: shipped weights or a run of the system portrait, with those of the landmarks next to it. DATA: a folder of
// portraits (daumier dataset portraits), or of pictures with landmark files of the same name. OUT: a new folder for
// table.md, metrics.json and sheets.
#include "core/config.h"
#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/options.h"
#include "core/weights_folder.h"
#include "datasets/read/portrait_database.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "systems/portrait/alignment_tables.h"
#include "systems/portrait/landmark_files.h"
#include "systems/portrait/picture_files.h"
#include "systems/portrait/portrait_predictor.h"
#include "systems/training_library.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

struct AlignmentProgramOptions {
  std::string landmarks = "given";
  int max_images = 50;
  std::vector<std::string> rows = {};
  bool sheets = true;
  PortraitAlignmentOptions alignment;

  template <class V>
  void Visit(V&& visit) {
    visit("landmarks", landmarks, Choices{{"given", "found"}},
          "Landmarks by which faces are cropped and to which they are fitted: those of DATA, or found ones.");
    visit("max_images", max_images, Range{1, 1e6}, "Largest number of portraits, evenly spaced.");
    visit("rows", rows, Text{}, "Names of the rows that are measured; empty: all.");
    visit("sheets", sheets, Flag{}, "Whether pictures are drawn.");
    visit("alignment", alignment, Table{}, "Of the rows `fine`.");
  }
};

/// A picture and what is known of it.
struct KnownPicture {
  AlignmentSubject subject;
  render::Image picture, mask;   ///< mask: grey, PictureClass; may be empty.
  std::vector<float> landmarks;  ///< In the picture.
};

std::vector<KnownPicture> ReadDatabase(const fs::path& folder, int most) {
  const datasets::PortraitDatabase portraits(folder);
  std::vector<int> images(size_t(portraits.size()));
  std::iota(images.begin(), images.end(), 0);
  std::vector<KnownPicture> pictures;
  for (const int i : EvenlySpaced(images, most)) {
    KnownPicture known{.picture = portraits.picture(i), .mask = portraits.mask(i), .landmarks = portraits.landmarks(i)};
    known.subject.name = fmt::format("{}", i);
    known.subject.person = portraits.person(i);
    if (portraits.has_vertices()) known.subject.vertices = portraits.vertices(i);
    pictures.push_back(std::move(known));
  }
  return pictures;
}

std::vector<KnownPicture> ReadPictureFolder(const fs::path& folder, int most) {
  std::vector<KnownPicture> pictures;
  for (const fs::path& file : EvenlySpaced(PicturesIn(folder), most)) {
    auto landmarks = LandmarksInFolder(folder, file.stem().string());
    if (!landmarks) continue;
    KnownPicture known{.picture = render::ToRgb(render::ReadImage(file)), .landmarks = std::move(*landmarks)};
    known.subject.name = file.stem().string();
    known.subject.person = int(pictures.size());
    known.subject.on_silhouette = true;
    pictures.push_back(std::move(known));
  }
  DAUMIER_CHECK(!pictures.empty(), "{} holds no picture with a landmark file of its name", folder.string());
  return pictures;
}

/// Crops, coarse faces and landmarks of the pictures.
std::vector<AlignmentSubject> MakeSubjects(const PortraitPredictor& predictor, const LandmarkDetector& detector,
                                           std::vector<KnownPicture> pictures, bool found) {
  std::vector<AlignmentSubject> subjects;
  for (KnownPicture& known : pictures) {
    AlignmentSubject subject = std::move(known.subject);
    std::vector<float> landmarks = known.landmarks;
    const DetectedFace face = found ? detector.FindOne(known.picture) : detector.FindGiven(known.picture, landmarks);
    if (found) {
      landmarks = face.landmarks;
      subject.confidences = face.landmark_confidences;
    }
    const PortraitPrediction prediction = predictor.FromLandmarks(known.picture, landmarks);
    const render::Image mask =
        known.mask.pixels.empty() ? face.Mask(known.picture.height, known.picture.width) : std::move(known.mask);
    subject.crop = prediction.crop;
    subject.shown = FaceMask(WarpPicture(mask, prediction.map, Sampling::kNearest));
    subject.coefficients = prediction.coefficients;
    subject.landmarks = MapLandmarks(landmarks, prediction.map);
    subject.truth = MapLandmarks(known.landmarks, prediction.map);
    subjects.push_back(std::move(subject));
  }
  return subjects;
}

/// A face of clay over the crop, with its landmarks in red.
render::Image Clay(const AlignmentMeasurement& measurement, const AlignmentSubject& subject,
                   const AlignedPortrait& face) {
  constexpr float kClay = 0.72F;
  std::vector<float> x = face.coefficients;
  std::fill_n(x.begin() + faces::kLightSlot.first, faces::kLightSlot.count, 0.0F);
  x[size_t(faces::kLightSlot.first)] = -0.05F;
  x[size_t(faces::kLightSlot.first + 1)] = -0.12F;  // From above, from the front and from the side.
  x[size_t(faces::kLightSlot.first + 2)] = 0.28F;
  x[size_t(faces::kLightSlot.first + 3)] = 0.12F;
  const Eigen::MatrixXf albedo = Eigen::MatrixXf::Constant(face.vertices.rows(), 3, kClay);
  return OverlayFace(subject.crop, measurement.painter().Paint({face.vertices, albedo}, x));
}

render::Image Doubled(const render::Image& picture) {
  return render::Resize(picture, 2 * picture.height, 2 * picture.width);
}

/// Input with given landmarks, coarse, Adjust Id+Exp and fine faces of these subjects, one a row.
render::Image Sheet(const AlignmentMeasurement& measurement, const std::vector<AlignmentSubject>& subjects,
                    const std::vector<std::pair<std::string, size_t>>& chosen) {
  std::vector<render::SheetCell> cells;
  for (const auto& [title, i] : chosen) {
    const AlignmentSubject& subject = subjects[i];
    const std::vector<float> weights = subject.confidences.empty() ? std::vector<float>(68, 1.0F) : subject.confidences;
    cells.push_back({DotsOver(Doubled(subject.crop),
                              [&] {
                                std::vector<float> dots = subject.truth;
                                for (float& number : dots) number *= 2;
                                return dots;
                              }(),
                              {40, 220, 80}),
                     fmt::format("{}: {}", title, subject.name)});
    for (const AlignmentMethod method :
         {AlignmentMethod::kCoarse, AlignmentMethod::kAdjustIdExpPose, AlignmentMethod::kFine})
      cells.push_back({Doubled(Clay(measurement, subject, measurement.Fit(method, subject, weights))), NameOf(method)});
  }
  return render::MakeSheet(cells, 4);
}

void Measure(const fs::path& weights, const fs::path& data, const fs::path& out,
             const AlignmentProgramOptions& options) {
  DAUMIER_CHECK(!fs::exists(out), "{} exists; name a new folder", out.string());
  const systems::TrainingLibrary& library = systems::LoadTrainingLibrary();
  const fs::path of_landmarks = WeightsNextTo(weights, kLandmarkSystem);
  const LandmarkDetector detector(ReadLandmarkNetworkOptions(of_landmarks), library.open_network(of_landmarks, {}));
  PortraitRunFolder folder = ReadPortraitFolder(weights);
  const faces::MorphableModel model = folder.model;
  const PortraitPredictor predictor(std::move(folder), library.open_network(weights, {}), nullptr, {.fine = false});
  const bool is_database = fs::exists(data / "shards");
  const std::vector<AlignmentSubject> subjects =
      MakeSubjects(predictor, detector,
                   is_database ? ReadDatabase(data, options.max_images) : ReadPictureFolder(data, options.max_images),
                   options.landmarks == "found");
  const AlignmentMeasurement measurement(model, options.alignment);
  std::vector<AlignmentRow> rows;
  for (int m = 0; m < kNumAlignmentMethods; ++m) {
    const auto method = AlignmentMethod(m);
    if (!options.rows.empty() && std::ranges::count(options.rows, NameOf(method)) == 0) continue;
    AlignmentRow row{method, {}};
    for (const AlignmentSubject& subject : subjects) row.errors.push_back(measurement.Measure(method, subject));
    rows.push_back(std::move(row));
    fmt::print(stderr, "{}\n", NameOf(method));
  }
  std::vector<int> persons;
  for (const AlignmentSubject& subject : subjects) persons.push_back(subject.person);
  std::string text;
  for (const reports::ReportTable& table : {LandmarkTable(rows), LeftOutTable(rows), ShapeTable(rows, persons)})
    text += fmt::format("{}\n\n{}\n", table.title, reports::TableMarkdown(table));
  fs::create_directories(out);
  WriteFileAtomically(out / "table.md", text);
  Json per_portrait = Json::array();
  for (const AlignmentRow& row : rows) {
    Json numbers = Json::array();
    for (const AlignmentErrors& errors : row.errors)
      numbers.push_back(std::accumulate(errors.used_px.begin(), errors.used_px.end(), 0.0) / 68 /
                        errors.interocular_px);
    per_portrait.push_back({{"name", NameOf(row.method)}, {"landmark_errors", numbers}});
  }
  WriteFileAtomically(
      out / "metrics.json",
      Json{{"options", ToJson(options)}, {"rows", AlignmentJson(rows)}, {"portraits", per_portrait}}.dump(1) + "\n");
  fmt::print("{}", text);
  if (!options.sheets) return;
  std::vector<std::pair<std::string, size_t>> all;
  for (size_t i = 0; i < subjects.size(); ++i) all.emplace_back("number", i);
  constexpr size_t kRowsOfSheet = 6;
  for (size_t first = 0; first < all.size(); first += kRowsOfSheet) {
    const size_t last = std::min(all.size(), first + kRowsOfSheet);
    render::WriteImage(out / fmt::format("sheet_{:02}.jpg", first / kRowsOfSheet),
                       Sheet(measurement, subjects, {all.begin() + long(first), all.begin() + long(last)}));
  }
}

}  // namespace
}  // namespace daumier::portrait

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    if (arguments.size() < 3) {
      std::fputs("usage: portrait_alignment WEIGHTS DATA OUT [key=value ...]\n", stderr);
      return 2;
    }
    const auto options = daumier::ParseOptions<daumier::portrait::AlignmentProgramOptions>(
        daumier::LoadConfig({}, {arguments.begin() + 3, arguments.end()}), "the command line");
    daumier::portrait::Measure(arguments[0], arguments[1], arguments[2], options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}

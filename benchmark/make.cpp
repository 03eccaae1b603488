#include "benchmark/make.h"

#include "benchmark/inputs.h"
#include "benchmark/record.h"
#include "core/error.h"
#include "core/files.h"
#include "core/licence_text.h"
#include "core/npy.h"
#include "core/parallel.h"
#include "core/staged_directory.h"
#include "datasets/build/portraits.h"
#include "geometry/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace daumier::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWorkFolder = ".work";
constexpr double kTruthUnitsPerCm = 1e4;

/// Files of a kit that is being made, and its items.
class KitWriter {
 public:
  KitWriter(fs::path folder, const BenchmarkOptions& options) : folder_(std::move(folder)), options_(options) {}

  void Write(const std::string& name, const std::string& bytes) {
    MakeDirectory((folder_ / name).parent_path());
    WriteFileAtomically(folder_ / name, bytes);
    checksums_[name] = Sha256(bytes);
  }
  void WriteFace(KitTask task, KitSplit split, const std::string& name, const geometry::Points& vertices) {
    NpyTable table{vertices.rows(), 3, {}};
    for (Eigen::Index i = 0; i < vertices.size(); ++i)
      table.numbers.push_back(float(std::round(kTruthUnitsPerCm * vertices.data()[i]) / kTruthUnitsPerCm));
    const std::string file = TruthFolder(task, split) + "/" + name + ".npy";
    if (!checksums_.contains(file)) Write(file, EncodeNpy(table));
  }
  void Add(KitTask task, KitSplit split, const KitItem& item) { items_[size_t(task)][size_t(split)].push_back(item); }

  Json Items() const {
    Json json = Json::object();
    for (size_t task = 0; task < items_.size(); ++task)
      for (size_t split = 0; split < items_[task].size(); ++split)
        json[std::string(kKitTaskNames[task])][std::string(kKitSplitNames[split])] = ItemsToJson(items_[task][split]);
    return json;
  }
  KitSplit SplitOf(int person) const {
    int split = 0;
    while (person >= PersonsOf(options_.persons, split).end) ++split;
    return static_cast<KitSplit>(split);
  }
  const fs::path& folder() const { return folder_; }
  std::map<std::string, std::string>& checksums() { return checksums_; }

 private:
  fs::path folder_;
  const BenchmarkOptions& options_;
  std::map<std::string, std::string> checksums_;
  std::array<std::array<std::vector<KitItem>, 3>, 4> items_;
};

std::string PlacesText(const geometry::Points& places) {
  std::string text;
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    text += fmt::format("{:.4f} {:.4f} {:.4f}\n", places(i, 0), places(i, 1), places(i, 2));
  return text;
}

void WriteDrawings(const faces::FaceDatabase& faces, const datasets::SketchDatabase& sketches, KitWriter& kit,
                   const BenchmarkOptions& options) {
  std::array<Json, 3> labels;
  ForEachInOrder(
      faces.num_persons(),
      [&](int person) { return DrawingsOf(faces, sketches, options.drawings, person, options.faces.seed); },
      [&](const std::vector<KitDrawing>& drawings) {
        for (const KitDrawing& drawing : drawings) {
          const KitSplit split = kit.SplitOf(drawing.item.person);
          kit.Add(KitTask::kDrawings, split, drawing.item);
          kit.Write(InputFolder(KitTask::kDrawings, split) + "/" + drawing.item.name + ".png",
                    render::EncodeImage(drawing.picture, render::ImageFormat::kPng));
          kit.WriteFace(KitTask::kDrawings, split, drawing.item.truth, faces.points(drawing.face));
          labels[size_t(split)][drawing.item.name] = drawing.label;
        }
      });
  for (size_t split = 0; split < labels.size(); ++split)
    kit.Write(TruthFolder(KitTask::kDrawings, KitSplit(split)) + "/labels.json",
              Json{{"about", "Points of drawings that the program made, by projection; no person set them."},
                   {"drawings", labels[split]}}
                      .dump(1) +
                  "\n");
}

void WriteCaricatures(const faces::FaceDatabase& faces, KitWriter& kit, const BenchmarkOptions& options) {
  for (int person = 0; person < faces.num_persons(); ++person) {
    const KitSplit split = kit.SplitOf(person);
    for (const KitCaricature& made : CaricaturesOf(faces, options.caricatures, person, options.faces.seed)) {
      const std::string input = InputFolder(KitTask::kCaricatures, split) + "/" + made.item.name;
      kit.Add(KitTask::kCaricatures, split, made.item);
      kit.Write(input + ".pts", PtsText(made.pixels));
      kit.Write(input + ".xyz", PlacesText(made.places));
      kit.WriteFace(KitTask::kCaricatures, split, made.item.truth, faces.points(made.face));
    }
  }
}

void WritePortraits(const datasets::PortraitDatabase& portraits, KitWriter& kit) {
  int person = -1, count = 0;
  for (int i = 0; i < portraits.size(); ++i) {
    count = portraits.person(i) == person ? count + 1 : 0;
    person = portraits.person(i);
    const KitSplit split = kit.SplitOf(person);
    const std::string name = FaceName(person, count);
    const KitItem item{name, person, name, portraits.style(i)};
    kit.Add(KitTask::kPortraits, split, item);
    kit.Add(KitTask::kLandmarks, split, item);
    kit.Write(InputFolder(KitTask::kPortraits, split) + "/" + name + ".png",
              render::EncodeImage(portraits.picture(i), render::ImageFormat::kPng));
    const std::vector<float> numbers = portraits.landmarks(i);
    eval::LandmarkRow row;
    std::ranges::copy(numbers, row.begin());
    kit.Write(TruthFolder(KitTask::kLandmarks, split) + "/" + name + ".pts", PtsText(row));
    const geometry::Points vertices = portraits.vertices(i).rowwise() + portraits.centre().transpose();
    kit.WriteFace(KitTask::kPortraits, split, name, vertices);
  }
}

void WriteTemplate(const faces::FaceTemplate& face_template, KitWriter& kit) {
  for (const auto& [name, checksum] : faces::WriteFaceTemplate(kit.folder(), face_template))
    kit.checksums()[name] = checksum;
  geometry::WriteObj(kit.folder() / "template.obj",
                     geometry::TriangleMesh{face_template.neutral, face_template.triangles});
  kit.checksums()["template.obj"] = Sha256OfFile(kit.folder() / "template.obj");
  std::string landmarks;
  for (const int vertex : face_template.annotation.landmarks) landmarks += fmt::format("{}\n", vertex);
  kit.Write("landmarks.txt", landmarks);
}

std::string ReadmeText(const BenchmarkOptions& options, const Json& sources) {
  return fmt::format(
      "# {}\n\nInputs and truth of a benchmark, made by `daumier benchmark make`. docs/benchmark.md of Daumier has the "
      "rules.\nDrawings, landmarks and portraits are drawn by a program from faces of a model; no person drew or is "
      "shown.\n\n"
      "    inputs/SPLIT/TASK/NAME   what a method reads\n"
      "    truth/SPLIT/TASK/NAME    V x 3 float32 (numpy.load), cm, vertices of template.obj; or 68 landmarks\n"
      "    landmarks.txt            68 vertices of template.obj, iBUG order\n"
      "    manifest.json            items of each task and split, and the SHA-256 of each file\n\n"
      "Splits are by person: a number NNN of person-NNN is in one split alone.\n\n## Licence\n\nWho passes the kit on "
      "keeps to the licences of its sources:\n\n{}",
      options.name, LicenceNotices(sources));
}

}  // namespace

PersonRange PersonsOf(const PersonCounts& counts, int split) {
  const int sizes[] = {counts.train, counts.validation, counts.test};
  DAUMIER_CHECK(split >= 0 && split < 3, "there is no split {}", split);
  int begin = 0;
  for (int i = 0; i < split; ++i) begin += sizes[i];
  return {begin, begin + sizes[split]};
}

void MakeBenchmark(const faces::FaceModel& model, BenchmarkOptions options, const fs::path& out, const Task& task) {
  options.faces.num_persons = options.persons.all();
  options.faces.num_interpolated = 0;
  if (datasets::LevelStrengths(options.faces).size() < 2)
    throw UsageError("a benchmark needs two levels of faces or more: regular faces, and caricatures last");
  StagedDirectory staged(out, kBenchmarkKind);
  const fs::path work = staged.path() / kWorkFolder;
  KitWriter kit(staged.path(), options);

  datasets::BuildFaces(model, options.faces, work / "faces", task.Stage("faces"));
  const faces::FaceDatabase faces(work / "faces", Checksums::kSkip);
  WriteTemplate(faces.face_template(), kit);

  datasets::SketchesOptions sketches;
  sketches.faces = (work / "faces").string();
  sketches.curve_height = options.drawings.curve_height;
  datasets::BuildSketches(sketches, work / "sketches", task.Stage("sketches"));
  WriteDrawings(faces, datasets::SketchDatabase(work / "sketches", Checksums::kSkip), kit, options);
  WriteCaricatures(faces, kit, options);

  datasets::PortraitsOptions portraits;
  portraits.faces = (work / "faces").string();
  portraits.source = options.faces.source;
  portraits.num_images = options.portraits.per_person * options.persons.all();
  portraits.big_eyes = options.portraits.big_eyes;
  portraits.seed = options.faces.seed;
  portraits.pictures = options.portraits.pictures;
  datasets::BuildPortraits(model, portraits, work / "portraits", task.Stage("portraits"));
  const datasets::PortraitDatabase pictures(work / "portraits", Checksums::kSkip);
  WritePortraits(pictures, kit);

  const Json sources = faces.manifest().sources;
  kit.Write("README.md", ReadmeText(options, sources));
  Manifest manifest;
  manifest.kind = kBenchmarkKind;
  manifest.verb = "benchmark make";
  options.faces.source.path.clear();
  manifest.config = ToJson(options);
  manifest.seed = options.faces.seed;
  manifest.sources = sources;
  manifest.counts = {{"persons", options.persons.all()}, {"vertices", faces.num_vertices()}};
  manifest.details = {{"version", kBenchmarkVersion},
                      {"name", options.name},
                      {"portrait_size", pictures.image_size()},
                      {"items", kit.Items()}};
  fs::remove_all(work);
  kit.Write(kRecordFile, RecordText(RecordOf(staged.path(), kit.checksums(), options.name)));
  manifest.checksums = kit.checksums();
  WriteManifest(staged.path(), manifest);
  staged.Commit();
}

}  // namespace daumier::benchmark

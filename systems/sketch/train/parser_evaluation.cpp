#include "systems/sketch/train/parser_evaluation.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/files.h"
#include "core/progress.h"
#include "core/run_manifest.h"
#include "core/statistics.h"
#include "core/stopwatch.h"
#include "datasets/read/run_data.h"
#include "datasets/styles/drawing_raster.h"
#include "export/torch_runner.h"
#include "render/heat_map_decoding.h"
#include "render/sheet.h"
#include "systems/sketch/parser_counts.h"
#include "systems/sketch/parser_metrics.h"
#include "systems/sketch/parser_overlay.h"
#include "systems/sketch/train/parser_export.h"
#include "systems/sketch/train/parser_recipe.h"
#include "systems/sketch/train/parser_run.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

constexpr int kMeanDrawings = 300, kSheetSide = 220, kSheetColumns = 6, kShownOfAKind = 6;

DrawnPoints TruePoints(const datasets::StyledDrawing& drawing) {
  DrawnPoints points;
  for (size_t i = 0; i < points.size(); ++i) {
    const auto& point = drawing.points[i];
    if (point.is_shown()) points[i] = {point.value[0], point.value[1]};
  }
  return points;
}

DrawnPoints FoundPoints(const ParsedDrawing& parsed) {
  DrawnPoints points;
  for (size_t i = 0; i < points.size(); ++i) points[i] = {parsed.points[i].x(), parsed.points[i].y()};
  return points;
}

Eigen::AlignedBox2d ExtentsOf(const datasets::StyledDrawing& drawing) {
  Eigen::AlignedBox2d box;
  for (const auto& stroke : drawing.strokes)
    for (const auto& point : stroke.points) box.extend(Eigen::Vector2d(point[0], point[1]));
  return box;
}

/// The mean place of each point in the extents of drawings, as shares.
class MeanPoints {
 public:
  explicit MeanPoints(const datasets::StyledDataset& drawings) {
    std::array<int, faces::kNumFacePoints> counts = {};
    for (int i = 0; i < drawings.size(); ++i) {
      const datasets::StyledDrawing drawing = drawings.Drawing(i, 0);
      const Eigen::AlignedBox2d box = ExtentsOf(drawing);
      const DrawnPoints points = TruePoints(drawing);
      for (size_t p = 0; p < points.size(); ++p) {
        if (!points[p]) continue;
        shares_[p] += Eigen::Vector2d((*points[p])[0], (*points[p])[1]).cwiseQuotient(box.sizes()) -
                      box.min().cwiseQuotient(box.sizes());
        ++counts[p];
      }
    }
    for (size_t p = 0; p < shares_.size(); ++p) shares_[p] /= std::max(1, counts[p]);
  }

  DrawnPoints In(const Eigen::AlignedBox2d& box) const {
    DrawnPoints points;
    for (size_t p = 0; p < points.size(); ++p) {
      const Eigen::Vector2d at = box.min() + box.sizes().cwiseProduct(shares_[p]);
      points[p] = {at.x(), at.y()};
    }
    return points;
  }

 private:
  std::array<Eigen::Vector2d, faces::kNumFacePoints> shares_ = [] {
    std::array<Eigen::Vector2d, faces::kNumFacePoints> zeros;
    zeros.fill(Eigen::Vector2d::Zero());
    return zeros;
  }();
};

class ParserEvaluation {
 public:
  ParserEvaluation(const fs::path& run_directory, const ParserEvalOptions& options, FolderCache& databases,
                   const Task& task)
      : options_(options),
        task_(task),
        run_(LoadParserRun(run_directory)),
        faces_folder_(Folder("faces", options.data.faces)),
        sketches_folder_(Folder("sketches", options.data.sketches)),
        faces_(databases.Open<faces::FaceDatabase>(faces_folder_)),
        sketches_(databases.Open<datasets::SketchDatabase>(sketches_folder_)),
        profiles_(HasProfiles()
                      ? &databases.Open<datasets::SketchDatabase>(Folder("profiles", options.data.profiles, "sketches"))
                      : nullptr),
        split_(datasets::SplitOfRun(run_directory, run_.manifest, run_.config, faces_)),
        reading_(ParseOptions<datasets::StyledReading>(run_.config.at("drawings"))),
        measured_(EvenlySpaced(datasets::SubsetOf(split_, options.split), options.drawings)),
        network_(std::make_shared<exporting::TorchRunner>(NetworkOf(DescribeParserExport(run_directory)), torch::kCPU)),
        parser_(run_.network_options, network_, options.parser) {
    if (measured_.empty()) throw UsageError(fmt::format("the side '{}' of the split has no face", options.split));
  }

  reports::Evaluation Measure() {
    const Stopwatch stopwatch;
    const datasets::StyledDataset drawings = Drawings(measured_);
    const MeanPoints mean(Drawings(EvenlySpaced(split_.train, kMeanDrawings)));
    Progress progress(task_.Stage("Drawings"), drawings.size(), "drawings");
    for (int i = 0; i < drawings.size(); ++i) {
      task_.ThrowIfCancelled("the evaluation was stopped; nothing was written");
      MeasureDrawing(drawings, i, mean);
      progress.Step();
    }
    seconds_ = stopwatch.seconds();
    const reports::MetricTable table = Table();
    const Json metrics = Metrics(table);
    return {.table = table,
            .metrics = metrics,
            .report = Report(table, metrics),
            .sheet =
                reports::Evaluation::Sheet{
                    Sheet(drawings),
                    "Colours: labels and points of the parser. Drawings of median, worst 5 % and first by index."},
            .manifest = ReportManifest()};
  }

 private:
  fs::path Folder(const char* kind, const std::string& moved, const std::string& manifest_kind = "") const {
    return datasets::FindRunData(run_.directory, run_.manifest, run_.config, kind, moved, manifest_kind);
  }

  bool HasProfiles() const { return run_.manifest.details.at("data").contains("profiles"); }

  datasets::StyledDataset Drawings(const std::vector<int>& of_faces) const {
    return {SourcesOf({sketches_, profiles_}, of_faces), reading_, run_.manifest.seed + 2,
            SidesOf(run_.network_options)};
  }

  int FaceOf(int sample) const {
    const int num_fronts = int(measured_.size());
    return measured_[size_t(sample < num_fronts ? sample : (sample - num_fronts) * int(kProfileEvery))];
  }

  void MeasureDrawing(const datasets::StyledDataset& drawings, int sample, const MeanPoints& mean) {
    const datasets::StyledDrawing drawing = drawings.Drawing(sample, 0);
    const DrawnPoints truth = TruePoints(drawing);
    const Stopwatch stopwatch;
    const ParsedDrawing parsed = parser_.Parse(datasets::LabelledStrokes(drawing));
    milliseconds_.push_back(1e3 * stopwatch.seconds());
    const int of_batch[] = {sample};
    SampleBatch batch = drawings.Get(of_batch, 0);
    NamedArrays outputs = network_->Run({{"pictures", batch.arrays.at("pictures")}});
    const size_t before = of_network_.points.size();
    of_network_.Add(batch, {outputs.at("heat_maps"), outputs.at("labels"), outputs.at("states")}, run_.network_options);
    AddStates(drawing, parsed);
    const auto whole = ErrorsOfPoints(FoundPoints(parsed), truth);
    if (!whole) return;
    samples_.push_back(sample);
    parser_errors_.push_back(*whole);
    network_errors_.push_back(of_network_.points.at(before));
    mean_errors_.push_back(*ErrorsOfPoints(mean.In(ExtentsOf(drawing)), truth));
  }

  void AddStates(const datasets::StyledDrawing& drawing, const ParsedDrawing& parsed) {
    if (drawing.mouth.is_shown())
      states_.mouth.Add(int64_t(drawing.mouth.value), int64_t(render::Likeliest(parsed.mouth)));
    for (size_t eye = 0; eye < 2; ++eye)
      if (drawing.eyes[eye].is_shown())
        states_.eyes.Add(int64_t(drawing.eyes[eye].value), int64_t(render::Likeliest(parsed.eyes[eye])));
    if (drawing.view.is_shown()) states_.view.Add(int64_t(drawing.view.value), int64_t(render::Likeliest(parsed.view)));
  }

  reports::MetricTable Table() const {
    reports::MetricTable table{.columns = ParserColumns()};
    for (const int sample : samples_) {
      table.faces.push_back(FaceOf(sample));
      table.groups.push_back(faces_.id(table.faces.back()).person);
    }
    table.data_hash = {{"faces", DataHash(faces_folder_)}, {"sketches", DataHash(sketches_folder_)}};
    const auto add = [&](const char* name, const std::vector<PointErrors>& errors) {
      reports::FaceValues values;
      for (const PointErrors& of_drawing : errors) values["error"].push_back(of_drawing.all);
      table.rows.push_back(reports::MakeRow(table, name, values, run_.manifest.seed));
      for (size_t part = 0; part < PointParts().size(); ++part) {
        std::vector<double> shown;
        for (const PointErrors& of_drawing : errors)
          if (of_drawing.parts[part]) shown.push_back(*of_drawing.parts[part]);
        const auto column = reports::FindColumn(table.columns, std::string(PointParts()[part].name));
        if (!shown.empty()) table.rows.back().values[*column] = reports::MetricValue{Mean(shown)};
      }
    };
    add("parser", parser_errors_);
    add("network alone", network_errors_);
    add("mean points in the extents", mean_errors_);
    table.rows.back().baseline = true;
    return table;
  }

  Json Metrics(const reports::MetricTable& table) const {
    return {{"system", kParserSystem},
            {"num_faces", samples_.size()},
            {"num_persons", std::set<int>(table.groups.begin(), table.groups.end()).size()},
            {"split", options_.split},
            {"normalised_error", table.rows[0].error().mean},
            {"table", reports::TableJson(table)},
            {"mouth", states_.mouth.ToJson(faces::kMouthStateNames)},
            {"eyes", states_.eyes.ToJson(faces::kEyeStateNames)},
            {"view", states_.view.ToJson(faces::kDrawnViewNames)},
            {"labels", of_network_.labels.ToJson(faces::kLineLabelNames)},
            {"milliseconds", Median(milliseconds_)},
            {"data_hash", table.data_hash},
            {"faces", table.faces},
            {"groups", table.groups},
            {"seconds", seconds_}};
  }

  reports::ReportData Report(const reports::MetricTable& table, const Json& metrics) const {
    reports::ReportData report;
    report.title = fmt::format("Parser of drawings, {} split", options_.split);
    report.summary = fmt::format(
        "{} styled drawings of {} persons. Mean distance of the points that a drawing shows over the distance of the "
        "outer eye corners. The interval resamples persons.",
        samples_.size(), metrics.at("num_persons").get<size_t>());
    report.tables = {reports::TextTable(table)};
    for (const char* state : {"mouth", "eyes", "view", "labels"}) {
      reports::ReportTable recalls{fmt::format("{}: balanced accuracy {:.1f} %", state,
                                               100 * metrics.at(state).at("balanced_accuracy").get<double>()),
                                   {"class", "recall %", "number"},
                                   {}};
      for (const auto& [name, value] : metrics.at(state).at("of_classes").items())
        if (!value.at("recall").is_null())
          recalls.rows.push_back({name, fmt::format("{:.1f}", 100 * value.at("recall").get<double>()),
                                  fmt::format("{}", value.at("num").get<int64_t>())});
      report.tables.push_back(recalls);
    }
    report.facts = {{"faces (data hash)", table.data_hash.at("faces").get<std::string>()},
                    {"sketches (data hash)", table.data_hash.at("sketches").get<std::string>()},
                    {"seed", fmt::format("{}", run_.manifest.seed)},
                    {"milliseconds a drawing", fmt::format("{:.1f}", Median(milliseconds_))},
                    {"seconds", fmt::format("{:.1f}", seconds_)}};
    return report;
  }

  render::Image Sheet(const datasets::StyledDataset& drawings) const {
    std::vector<size_t> order(samples_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, {}, [&](size_t i) { return parser_errors_[i].all; });
    std::vector<size_t> shown;
    const size_t count = std::min(order.size(), size_t{kShownOfAKind});
    for (const double share : {0.5, 0.95}) {
      const size_t begin = std::min(size_t(share * double(order.size())), order.size() - count);
      shown.insert(shown.end(), order.begin() + ptrdiff_t(begin), order.begin() + ptrdiff_t(begin + count));
    }
    for (size_t i = 0; i < count; ++i) shown.push_back(i);
    std::vector<render::SheetCell> cells;
    for (const size_t i : shown) {
      const datasets::StyledDrawing drawing = drawings.Drawing(samples_[i], 0);
      const ParsedDrawing parsed = parser_.Parse(datasets::LabelledStrokes(drawing));
      render::Image image = ParsedPicture(parsed, {}, kSheetSide);
      cells.push_back({std::move(image), fmt::format("{}: {:.1f} %", samples_[i], 100 * parser_errors_[i].all)});
    }
    return render::MakeSheet(cells, kSheetColumns);
  }

  Manifest ReportManifest() const {
    Manifest manifest{.kind = "report", .verb = "eval"};
    manifest.config = ToJson(options_);
    manifest.config.erase("data");
    manifest.seed = run_.manifest.seed;
    manifest.sources = run_.manifest.sources;
    manifest.counts = {{"drawings", samples_.size()}};
    manifest.details = {{"system", kParserSystem},
                        {"data", {{"faces", DataHash(faces_folder_)}, {"sketches", DataHash(sketches_folder_)}}},
                        {"weights", Sha256OfFile(BestWeights(run_.directory))}};
    return manifest;
  }

  const ParserEvalOptions options_;
  const Task task_;
  const ParserRun run_;
  const fs::path faces_folder_, sketches_folder_;
  const faces::FaceDatabase& faces_;
  const datasets::SketchDatabase& sketches_;
  const datasets::SketchDatabase* profiles_;
  const datasets::Split split_;
  const datasets::StyledReading reading_;
  const std::vector<int> measured_;  ///< Faces.
  const std::shared_ptr<const runtime::NetworkRunner> network_;
  const DrawingParser parser_;
  std::vector<int> samples_;  ///< Of measured_, those whose drawing shows a point.
  std::vector<PointErrors> parser_errors_, network_errors_, mean_errors_;
  std::vector<double> milliseconds_;
  ParserCounts states_;      ///< Of the parser.
  ParserCounts of_network_;  ///< Of the network alone.
  double seconds_ = 0;
};

}  // namespace

reports::Evaluation EvaluateParser(const fs::path& run_directory, const ParserEvalOptions& options,
                                   FolderCache& databases, const Task& task) {
  return ParserEvaluation(run_directory, options, databases, task).Measure();
}

}  // namespace daumier::sketch

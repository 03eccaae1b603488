#include "systems/sketch/train/stroke_prefixes.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/statistics.h"
#include "datasets/styles/drawing_raster.h"
#include "datasets/styles/face_lines.h"
#include "eval/metrics.h"
#include "export/torch_runner.h"
#include "reports/curve_chart.h"
#include "systems/sketch/metrics.h"
#include "systems/sketch/parsed_face.h"
#include "systems/sketch/parser_predictor.h"
#include "systems/sketch/stroke_network.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/parser_export.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

namespace daumier::sketch {
namespace {

using Strokes = std::vector<render::Stroke>;

constexpr double kDearStrokeMm = 1;

/// The chain of SketchPredictor, of strokes on the canvas.
class PrefixChain {
 public:
  PrefixChain(const SketchRunData& data, const std::string& parser, const DrawingFitOptions& fitting)
      : network_(data.run, std::make_shared<exporting::TorchRunner>(
                               exporting::NetworkOf(DescribeSketchExport(data.run.directory)), torch::kCPU)),
        fitter_(data.run, std::make_shared<const DrawingParser>(OpenParserOfRun(ParserFolder(parser))), fitting) {}

  struct Faces {
    std::vector<float> network, fitted;
  };
  /// Absent if the strokes are refused.
  std::optional<Faces> FacesOf(const Strokes& strokes) const {
    try {
      const ParsedDrawing parsed = fitter_.Parse(strokes);
      RefuseProfile(parsed);
      const render::Placement frame = fitter_.FrameOf(parsed);
      Faces faces;
      faces.network = network_.Predict({render::MapToCanvas(LinesOfFace(parsed), frame)}).front().vertices;
      faces.fitted = fitting::Upright(fitter_.Fit(parsed, frame, faces.network));
      return faces;
    } catch (const Error&) {
      return std::nullopt;
    }
  }

 private:
  StrokeNetwork network_;
  DrawingFitter fitter_;
};

datasets::StyledDrawing WholeDrawing(const SketchRunData& data, int face) {
  datasets::StyleOptions styles = datasets::StyledShare::DrawnAsTheFaceIs();
  styles.doodles = 0;
  styles.page.prefix = 0;
  Rng rng = Stream(data.run.manifest.seed, "stroke prefixes", uint64_t(face));
  return datasets::DrawInStyle(datasets::ShapeOf(data.sketches, face, 0), styles, rng);
}

std::vector<int> PrefixesOf(int num_strokes, bool every_stroke) {
  std::vector<int> prefixes;
  if (every_stroke) {
    prefixes.resize(size_t(num_strokes));
    std::iota(prefixes.begin(), prefixes.end(), 1);
    return prefixes;
  }
  std::ranges::copy_if(kPrefixes, std::back_inserter(prefixes), [&](int n) { return n < num_strokes; });
  prefixes.push_back(num_strokes);
  return prefixes;
}

/// One number a face.
template <class Value>
std::vector<double> ValuesOf(std::span<const PrefixErrors> faces, const Value& value) {
  std::vector<double> values;
  for (const PrefixErrors& face : faces) values.push_back(double(value(face)));
  return values;
}

Json PrefixErrorsToJson(const PrefixErrors& errors) {
  std::vector<std::string_view> labels;
  for (const faces::LineLabel label : errors.last_label) labels.push_back(faces::kLineLabelNames[size_t(label)]);
  return {{"face", errors.face},    {"num_strokes", errors.num_strokes},
          {"mm", errors.fitted_mm}, {"network_mm", errors.network_mm},
          {"last_label", labels},   {"mean_face_mm", errors.mean_face_mm}};
}

Json AddedStroke(std::span<const PrefixErrors> faces) {
  std::vector<double> costs;
  int num_faces = 0;
  for (const PrefixErrors& face : faces) {
    if (!face.has_every_stroke()) continue;
    ++num_faces;
    for (size_t i = 1; i < face.fitted_mm.size(); ++i) costs.push_back(face.fitted_mm[i] - face.fitted_mm[i - 1]);
  }
  if (costs.empty()) return nullptr;
  const auto num_dear = std::ranges::count_if(costs, [](double cost) { return cost > kDearStrokeMm; });
  return {{"num_faces", num_faces},
          {"num", costs.size()},
          {"mean_mm", Mean(costs)},
          {"p95_mm", Percentile(costs, 95)},
          {"p99_mm", Percentile(costs, 99)},
          {"max_mm", std::ranges::max(costs)},
          {"above_1_mm", double(num_dear) / double(costs.size())}};
}

reports::ReportChart ChartOf(const Json& metrics, double mean_strokes) {
  reports::ChartCurve fitted{"network and fit", {}, {}}, network{"network alone", {}, {}}, mean{"mean face", {}, {}};
  reports::ChartCurve low{"95 % interval by person", {}, {}}, high = low;
  for (const Json& at : metrics.at("by_number")) {
    const bool is_whole = at.at("strokes").is_string();
    const double x = is_whole ? mean_strokes : at.at("strokes").get<double>();
    if (is_whole && !fitted.x.empty() && x <= fitted.x.back()) continue;
    const auto add = [&](reports::ChartCurve& curve, const Json& y) {
      curve.x.push_back(x);
      curve.y.push_back(y.get<double>());
    };
    add(fitted, at.at("mm"));
    add(network, at.at("network_mm"));
    add(mean, metrics.at("mean_face_mm"));
    add(low, at.at("interval_mm")[0]);
    add(high, at.at("interval_mm")[1]);
  }
  return {
      "Error by number of strokes", "strokes.svg",
      fmt::format("Mean over {} drawings of the error after their first strokes. A drawing with fewer strokes stays "
                  "as it is; the last place is that of whole drawings.",
                  metrics.at("num_faces").get<int>()),
      reports::CurveChartSvg({{"Error by number of strokes", {fitted, low, high, network, mean}}},
                             "Error by number of strokes", "strokes", "mm")};
}

}  // namespace

size_t PrefixErrors::at(int strokes) const {
  const auto beyond = std::ranges::upper_bound(num_strokes, strokes);
  return beyond == num_strokes.begin() ? 0 : size_t(beyond - num_strokes.begin() - 1);
}

bool PrefixErrors::has_every_stroke() const {
  return !num_strokes.empty() && num_strokes.back() == int(num_strokes.size());
}

std::vector<PrefixErrors> MeasurePrefixes(const SketchTestSet& test, int num_faces, const std::string& parser,
                                          const DrawingFitOptions& fitting) {
  const SketchRunData& data = test.data();
  const PrefixChain chain(data, parser, fitting);
  const std::vector<int> faces = EvenlySpaced(test.faces(), num_faces);
  const Eigen::RowVectorXf mean_row =
      eval::MeanFace([&](int face) { return data.faces.vertices(face); }, data.split.train);
  const std::span<const float> mean(mean_row.data(), size_t(mean_row.size()));
  const double mm_per_cm = faces::MillimetresPerCm(data.faces.face_template());
  const auto measure = [&](int i) {
    PrefixErrors errors{.face = faces[size_t(i)], .person = data.faces.group(faces[size_t(i)])};
    const auto error_of = [&](std::span<const float> vertices) {
      return eval::MeanVertexError(vertices, data.faces.vertices(errors.face), test.region(), mm_per_cm);
    };
    errors.mean_face_mm = error_of(mean);
    const datasets::StyledDrawing drawing = WholeDrawing(data, errors.face);
    errors.num_strokes = PrefixesOf(int(drawing.strokes.size()), i % kEveryStrokeOf == 0);
    for (const int num_strokes : errors.num_strokes) {
      test.task().ThrowIfCancelled("the evaluation was stopped; nothing was written");
      const auto found = chain.FacesOf(datasets::LabelledStrokes(datasets::FirstStrokes(drawing, num_strokes)));
      errors.refused.push_back(!found);
      errors.last_label.push_back(drawing.strokes[size_t(num_strokes - 1)].labels.front());
      errors.network_mm.push_back(found ? error_of(found->network) : errors.mean_face_mm);
      errors.fitted_mm.push_back(found ? error_of(found->fitted) : errors.mean_face_mm);
    }
    return errors;
  };
  Progress progress(test.task().Stage("First strokes"), int64_t(faces.size()), "faces");
  std::vector<PrefixErrors> result;
  ForEachInOrder(int(faces.size()), measure, [&](PrefixErrors errors) {
    result.push_back(std::move(errors));
    progress.Step();
  });
  return result;
}

PrefixReport ReportPrefixes(std::span<const PrefixErrors> faces, uint64_t seed) {
  DAUMIER_CHECK(!faces.empty(), "errors by the number of strokes need a face");
  std::vector<int> persons;
  for (const PrefixErrors& face : faces) persons.push_back(face.person);
  PrefixReport report;
  report.metrics = {
      {"num_faces", faces.size()},
      {"num_persons", std::set<int>(persons.begin(), persons.end()).size()},
      {"mean_strokes", Mean(ValuesOf(faces, [](const PrefixErrors& face) { return face.num_strokes.back(); }))},
      {"mean_face_mm", Mean(ValuesOf(faces, [](const PrefixErrors& face) { return face.mean_face_mm; }))},
      {"by_number", Json::array()}};
  report.table = {"Error by number of strokes",
                  {"strokes", "mm", "95 % interval", "network alone", "mean face", "worse than it, %", "refused, %"},
                  {}};
  const auto add = [&](const Json& strokes, int most) {
    const auto errors = ValuesOf(faces, [&](const PrefixErrors& face) { return face.fitted_mm[face.at(most)]; });
    const double mm = Mean(errors);
    const Interval interval = PersonBootstrap(errors, persons, seed);
    const double network =
        Mean(ValuesOf(faces, [&](const PrefixErrors& face) { return face.network_mm[face.at(most)]; }));
    const double worse = Mean(ValuesOf(
        faces, [&](const PrefixErrors& face) { return face.fitted_mm[face.at(most)] > face.mean_face_mm ? 1 : 0; }));
    const double refused =
        Mean(ValuesOf(faces, [&](const PrefixErrors& face) { return face.refused[face.at(most)] ? 1 : 0; }));
    report.metrics["by_number"].push_back({{"strokes", strokes},
                                           {"mm", mm},
                                           {"interval_mm", {interval.low, interval.high}},
                                           {"network_mm", network},
                                           {"worse_than_mean_face", worse},
                                           {"refused", refused}});
    report.table.rows.push_back(
        {strokes.is_string() ? strokes.get<std::string>() : strokes.dump(), fmt::format("{:.2f}", mm),
         fmt::format("{:.2f} to {:.2f}", interval.low, interval.high), fmt::format("{:.2f}", network),
         fmt::format("{:.2f}", report.metrics.at("mean_face_mm").get<double>()), fmt::format("{:.1f}", 100 * worse),
         fmt::format("{:.1f}", 100 * refused)});
  };
  for (const int strokes : kPrefixes) add(strokes, strokes);
  add("all", std::numeric_limits<int>::max());
  report.metrics["added_stroke"] = AddedStroke(faces);
  report.metrics["of_faces"] = Json::array();
  for (const PrefixErrors& face : faces) report.metrics["of_faces"].push_back(PrefixErrorsToJson(face));
  report.chart = ChartOf(report.metrics, report.metrics.at("mean_strokes").get<double>());
  if (const Json& added = report.metrics.at("added_stroke"); !added.is_null()) {
    const auto number = [&](const char* key) { return added.at(key).get<double>(); };
    report.facts.push_back(
        {"cost of one added stroke, mm",
         fmt::format("95th percentile {:.2f}, 99th {:.2f}, greatest {:.2f}; above 1 mm {:.1f} % of {:.0f} strokes of "
                     "{:.0f} drawings",
                     number("p95_mm"), number("p99_mm"), number("max_mm"), 100 * number("above_1_mm"), number("num"),
                     number("num_faces"))});
  }
  return report;
}

}  // namespace daumier::sketch

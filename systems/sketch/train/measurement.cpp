#include "systems/sketch/train/measurement.h"

#include "core/error.h"
#include "core/log.h"
#include "geometry/coordinates.h"
#include "render/strokes.h"
#include "systems/sketch/parser_predictor.h"
#include "systems/sketch/train/baseline_rows.h"
#include "systems/sketch/train/fits.h"
#include "systems/sketch/train/parser_export.h"
#include "systems/sketch/train/shape_codes.h"

#include <algorithm>
#include <memory>

namespace daumier::sketch {
namespace {

/// A run whose network reads no curve coefficients, on the data of `data`.
SketchRun OpenRecoveringRun(const SketchRunData& data, const std::string& directory) {
  SketchRun run = LoadSketchRun(directory);
  DAUMIER_CHECK(!run.network->options().reads_shape(),
                "{} reads curve coefficients itself, and cannot be the run that they are recovered with", directory);
  for (const char* key : {"data", "split"}) {
    DAUMIER_CHECK(run.manifest.details.at(key) == data.run.manifest.details.at(key),
                  "{}: its {} differs from that of {}", directory, key, data.run.directory.string());
  }
  return run;
}

/// The curve coefficients of a block, for a network that reads them.
using Numbers = std::function<eval::FaceRows(const FaceBlock& block)>;

/// Reads all sketches of the test set with a network, in blocks.
StoredCoefficients ReadAll(const SketchTestSet& test, const SketchNetwork& network, const Numbers& numbers) {
  log::Info("Predicting {} faces by the network", test.faces().size());
  StoredCoefficients stored(network);
  for (size_t begin = 0; begin < test.faces().size(); begin += kBlock) {
    test.task().ThrowIfCancelled("the evaluation was stopped; nothing was written");
    const size_t count = std::min(kBlock, test.faces().size() - begin);
    const FaceBlock block{begin, std::span(test.faces()).subspan(begin, count)};
    if (network->options().reads_shape()) {
      const eval::FaceRows shape = numbers(block);
      stored.Append(test.reader().Forward(network, block.faces, &shape));
    } else {
      stored.Append(test.reader().Forward(network, block.faces));
    }
  }
  return stored;
}

SketchPredictions Decode(const StoredCoefficients& stored, const FaceBlock& block) {
  return stored.Decode(int64_t(block.begin), int64_t(block.faces.size()));
}

eval::FaceRows NumbersOf(const FaceBlock& block, const std::function<const faces::CurveCode&(size_t position)>& code) {
  const Eigen::Index num_numbers = code(block.begin).numbers().size();
  eval::FaceRows numbers(Eigen::Index(block.faces.size()), num_numbers);
  for (size_t i = 0; i < block.faces.size(); ++i)
    numbers.row(Eigen::Index(i)) = code(block.begin + i).numbers().transpose();
  return numbers;
}

/// The network with the curve coefficients that it reads: the stored result, and the row with given ones before it.
struct NetworkRows {
  StoredCoefficients result;
  std::string input;
};

NetworkRows AddNetworkRows(const SketchTestSet& test, const ShapeCodes& codes, SketchMeasurement& measured) {
  const SketchNetwork& network = test.data().run.network;
  const auto add = [&](const StoredCoefficients& stored, const std::string& input) {
    const SketchErrors errors =
        test.Measure("network", [&](const FaceBlock& block) { return Decode(stored, block).faces; });
    measured.table.result = measured.table.rows.size();
    measured.table.rows.push_back(test.Row("network", input, errors));
    measured.of_vertices = errors.of_vertices;
  };
  if (!network->options().reads_shape()) {
    add(codes.without_shape(), "none");
    return {codes.without_shape(), "none"};
  }
  const auto read = [&](const std::string& input) {
    return ReadAll(test, network, [&](const FaceBlock& block) {
      return NumbersOf(block, [&](size_t i) -> const faces::CurveCode& {
        return input == "given" ? codes.given(test.faces()[i]) : codes.recovered(i);
      });
    });
  };
  const StoredCoefficients given = read("given");
  add(given, "given");
  if (!codes.can_recover()) return {given, "given"};
  const StoredCoefficients recovered = read("recovered");
  add(recovered, "recovered");
  return {recovered, "recovered"};
}

/// Contours matched.
void AddRefinedRow(const SketchTestSet& test, const NetworkRows& network, SketchMeasurement& measured) {
  log::Info("Matching contours of {} faces", test.faces().size());
  const RefinedRow refiner(test.data(), test.reader());
  const SketchErrors errors = test.Measure(
      "contours", [&](const FaceBlock& block) { return refiner.Refine(block.faces, Decode(network.result, block)); });
  measured.table.rows.push_back(test.Row("network, refined", network.input, errors));
}

/// The network's faces fitted to the sketches as a parser reads them.
void AddFittedRow(const SketchTestSet& test, const NetworkRows& network, const std::string& parser,
                  SketchMeasurement& measured) {
  log::Info("Fitting {} faces to parsed sketches", test.faces().size());
  const FittedRow fitter(test.data(), test.reader(),
                         std::make_shared<const DrawingParser>(OpenParserOfRun(ParserFolder(parser))));
  const SketchErrors errors = test.Measure(
      "fits", [&](const FaceBlock& block) { return fitter.Fit(block.faces, Decode(network.result, block).faces); });
  measured.table.rows.push_back(test.Row("network, fitted", network.input, errors));
}

void AddMorphableRows(const SketchTestSet& test, SketchMeasurement& measured) {
  log::Info("Fitting the bilinear model to the strokes of {} faces", test.faces().size());
  const MorphableRow fit(test.data(), test.reader());
  const auto add = [&](const std::string& name, const fitting::MorphableFitOptions& options) {
    measured.table.rows.push_back(test.Row(name, "given", test.Measure("fits", [&](const FaceBlock& block) {
      return fit.Predict(block.faces, options);
    })));
  };
  const auto with_prior = fit.ChooseOptions(test.data().split.validation, test.region());
  log::Info("The deviation of labelled points is {} pixels, by validation", with_prior.deviation_px);
  add("morphable model fit", with_prior);
  add("morphable model fit without prior", {.prior = false});
}

reports::Predictions KeptPredictions(const SketchTestSet& test, const NetworkRows& network,
                                     const reports::MetricTable& table) {
  const std::vector<int> kept = reports::KeptFaces(table);
  std::vector<int64_t> entries;
  for (const int face : kept)
    entries.push_back(std::find(test.faces().begin(), test.faces().end(), face) - test.faces().begin());
  const SketchPredictions predicted = network.result.Decode(entries);
  reports::Predictions predictions{reports::SurfaceOf(test.data().run.face_template), {}};
  for (size_t i = 0; i < kept.size(); ++i) {
    const std::span<const float> vertices = eval::RowSpan(predicted.faces, i);
    const datasets::AugmentedSketch sketch = test.reader().SketchOf(kept[i]);
    predictions.faces.push_back({kept[i], render::RasteriseStrokes(sketch.strokes, render::kSketchCanvas, sketch.style),
                                 test.data().faces.points(kept[i]), geometry::PointsFrom(vertices),
                                 test.ErrorMap(vertices, kept[i])});
  }
  return predictions;
}

}  // namespace

SketchMeasurement MeasureSketchRun(const SketchTestSet& test, const SketchEvalOptions& options) {
  SketchMeasurement measured{.table = test.EmptyTable()};
  const SketchRunData& data = test.data();
  std::optional<SketchRun> recovering;
  if (!options.recover_with.empty()) recovering = OpenRecoveringRun(data, options.recover_with);
  const SketchNetwork& without_shape = recovering ? recovering->network : data.run.network;
  std::optional<StoredCoefficients> start;
  if (!without_shape->options().reads_shape()) start = ReadAll(test, without_shape, nullptr);
  const ShapeCodes codes(test, start, options.baselines);

  const NetworkRows network = AddNetworkRows(test, codes, measured);
  if (options.refine) AddRefinedRow(test, network, measured);
  if (options.deform) AddFittedRow(test, network, options.parser, measured);
  if (options.fit) AddMorphableRows(test, measured);
  if (options.baselines) {
    BaselineRows baselines = MeasureBaselines(test, codes, options.strength);
    for (reports::MetricRow& row : baselines.rows) measured.table.rows.push_back(std::move(row));
    measured.ridge_lambda = baselines.ridge_lambda;
    measured.shape_error_px = baselines.shape_error_px;
  }
  measured.predictions = KeptPredictions(test, network, measured.table);
  return measured;
}

}  // namespace daumier::sketch

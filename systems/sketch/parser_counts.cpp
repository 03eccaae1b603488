#include "systems/sketch/parser_counts.h"

#include "render/heat_map_decoding.h"

namespace daumier::sketch {
namespace {

DrawnPoints TrueCells(const SampleBatch& batch, int64_t row) {
  const float* const cells = batch.arrays.at("points").row(row);
  const float* const weights = batch.arrays.at("weights").row(row);
  DrawnPoints points;
  for (size_t i = 0; i < points.size(); ++i)
    if (weights[i] > 0) points[i] = {cells[2 * i], cells[2 * i + 1]};
  return points;
}

}  // namespace

void ParserCounts::Add(const SampleBatch& batch, const ParserOutputs& outputs, const ParserNetworkOptions& network) {
  const int side = network.map_side();
  const int64_t num_cells = int64_t(network.label_side()) * network.label_side();
  const auto& true_labels = batch.indices.at("labels");
  const auto& true_states = batch.indices.at("states");
  for (int64_t row = 0; row < int64_t(batch.samples.size()); ++row) {
    DrawnPoints found;
    const auto peaks = render::FindPeaks(RowOf(outputs.heat_maps, row), faces::kNumFacePoints, side, side,
                                         {.deviation = network.deviation});
    for (size_t i = 0; i < found.size(); ++i) found[i] = {peaks[i].x, peaks[i].y};
    if (const auto errors = ErrorsOfPoints(found, TrueCells(batch, row))) points.push_back(*errors);

    const float* const scores = outputs.labels.row(row);
    for (int64_t cell = 0; cell < num_cells; ++cell) {
      const int64_t truth = true_labels.row(row)[cell];
      if (truth == datasets::kUnknownClass) continue;
      int64_t best = 0;
      for (int64_t label = 1; label < faces::kNumLineLabels; ++label)
        if (scores[label * num_cells + cell] > scores[best * num_cells + cell]) best = label;
      labels.Add(truth, best);
    }

    const auto states = render::StateProbabilities(RowOf(outputs.states, row), datasets::kDrawingStateClasses);
    ClassCounts* const counts[] = {&mouth, &eyes, &eyes, &view};
    for (size_t state = 0; state < states.size(); ++state) {
      const int64_t truth = true_states.row(row)[state];
      if (truth != datasets::kUnknownClass) counts[state]->Add(truth, int64_t(render::Likeliest(states[state])));
    }
  }
}

double ParserCounts::mean_error() const {
  double sum = 0;
  for (const PointErrors& errors : points) sum += errors.all;
  return points.empty() ? 0 : sum / double(points.size());
}

}  // namespace daumier::sketch

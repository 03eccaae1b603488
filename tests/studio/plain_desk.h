#pragma once
#include "systems/sketch/predictor.h"
#include "tests/fitting/drawn_circles.h"
#include "tests/support/ideal_parser_network.h"
#include "tests/support/plain_sketch_run.h"
#include "tests/support/temp_dir.h"

#include <memory>
#include <vector>

/// A predictor of the synthetic face, which needs no weights, and events of its sessions.
namespace daumier::testing {

inline std::shared_ptr<const sketch::SketchPredictor> PlainSketchPredictor() {
  static const TempDir folder;
  static const std::shared_ptr<const sketch::SketchPredictor> predictor = [] {
    WritePlainSketchRun(folder.path());
    const sketch::SketchRunFolder run = sketch::ReadSketchRunFolder(folder.path());
    return std::make_shared<const sketch::SketchPredictor>(
        run, std::make_shared<FixedNetwork>(run.models.bilinear),
        std::make_shared<const sketch::DrawingParser>(
            sketch::ParserNetworkOptions(), std::make_shared<IdealParserNetwork>(sketch::ParserNetworkOptions())));
  }();
  return predictor;
}

inline Json DrawEvent(const Json& points) {
  return {{"do", "draw"}, {"points", points}};
}

/// Lines of a face on a sheet of 512 x 512: an event a line.
inline std::vector<Json> FaceEvents() {
  std::vector<Json> events;
  for (const render::Stroke& circle : fitting::Circles()) {
    Json points = Json::array();
    for (const auto& [x, y] : circle.points) points.push_back({2 * x, 2 * y});
    events.push_back(DrawEvent(points));
  }
  return events;
}

/// A line that is no line of the face: in follow-up mode a wrinkle.
inline Json WrinkleEvent(int number = 0) {
  return DrawEvent({{10 + 4 * number, 10}, {18 + 4 * number, 10}});
}

}  // namespace daumier::testing

#pragma once
#include "core/options.h"
#include "systems/sketch/drawing_parser.h"
#include "systems/sketch/evaluation_options.h"

#include <string>

namespace daumier::sketch {

struct ParserEvalOptions {
  std::string split = "test";
  SketchEvalData data = {};
  int drawings = 400;
  DrawingParserOptions parser = {};

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"train", "validation", "test"}}, "Subset of the run's split that is measured.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("drawings", drawings, Range{1, 1e6},
          "Number of drawings that are measured: of faces of the subset, evenly spaced, each in a style of its own.");
    visit("parser", parser, Table{}, "How drawings are parsed.");
  }
};

}  // namespace daumier::sketch

#pragma once
#include "core/options.h"
#include "systems/sketch/drawing_parser.h"

#include <string>

namespace daumier::sketch {

/// Where the data of a run are now.
struct ParserEvalData {
  std::string faces = {}, sketches = {}, profiles = {};

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces that the run was trained on, if they have moved.");
    visit("sketches", sketches, Text{}, "Folder of their sketches, if they have moved.");
    visit("profiles", profiles, Text{}, "Folder of their sketches from the side, if they have moved.");
  }
};

struct ParserEvalOptions {
  std::string split = "test";
  ParserEvalData data = {};
  int drawings = 400;
  DrawingParserOptions parser = {};

  template <class V>
  void Visit(V&& visit) {
    visit("split", split, Choices{{"train", "validation", "test"}}, "Subset of the run's split that is measured.");
    visit("data", data, Table{}, "The run's own data, found by their data hash.");
    visit("drawings", drawings, Range{1, 1e6},
          "Number of faces whose drawings are measured, evenly spaced, each in a style of its own; a tenth of them "
          "also from "
          "the side, where the run has profiles.");
    visit("parser", parser, Table{}, "How drawings are parsed.");
  }
};

}  // namespace daumier::sketch

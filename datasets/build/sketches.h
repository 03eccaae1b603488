#pragma once
#include "core/options.h"
#include "core/task.h"
#include "datasets/build/sketch_lines.h"
#include "datasets/build/sketch_views.h"

#include <filesystem>
#include <string>

namespace daumier::datasets {

struct SketchesOptions {
  std::string faces;
  std::string view = "frontal";
  double curve_height = 0.62;
  int num_views = 1;
  ViewNoise noise;
  TurnedViews turned;
  WrinkleOptions wrinkles;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{}, "Folder of the faces that are drawn.");
    visit("view", view, Choices{{"frontal", "side"}}, "View of the orthographic camera.");
    visit("curve_height", curve_height, Range{0.2, 1.0},
          "Height of the mean head's curves on the canvas, as a share of its side.");
    visit("num_views", num_views, Range{1, 100},
          "Number of sketches of a face; the first view is exact, the others have `noise`.");
    visit("noise", noise, Table{}, "Random deviation of views.");
    visit("turned", turned, Table{}, "Views from the side.");
    visit("wrinkles", wrinkles, Table{}, "Lines in addition to the annotation's curves.");
  }
};

/// Writes a SketchDatabase of every face of a database. Resumes an interrupted build of the same options. @throws Error
/// as faces::FaceDatabase, SketchCamera, SketchLines and BuildShards.
void BuildSketches(const SketchesOptions& options, const std::filesystem::path& directory, const Task& task = {});

}  // namespace daumier::datasets

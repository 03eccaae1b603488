#include "systems/sketch/evaluation_options.h"

#include "core/error.h"

namespace daumier::sketch {

void CheckEvalOptions(const SketchEvalOptions& options) {
  if (options.faces.empty() != options.sketches.empty())
    throw UsageError("a sketch run is measured on other faces by their sketches: give both 'faces' and 'sketches'");
  if (options.faces.empty()) return;
  const auto refuse = [](bool given, const char* key) {
    if (given)
      throw UsageError(fmt::format("faces excludes {} (all of these faces are measured, refined and fitted)", key));
  };
  refuse(options.split != SketchEvalOptions().split, "split");
  refuse(!options.recover_with.empty(), "recover_with");
  refuse(options.refine, "refine");
  refuse(options.deform, "deform");
  refuse(options.fit, "fit");
  refuse(options.styled, "styled");
  refuse(options.strokes > 0, "strokes");
}

}  // namespace daumier::sketch

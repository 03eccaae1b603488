#pragma once
#include "core/options.h"
#include "core/task.h"
#include "faces/controls/caricature_generator.h"
#include "faces/exaggeration.h"
#include "faces/face_model.h"
#include "faces/part_exaggeration.h"
#include "faces/source.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier::datasets {

struct FacesOptions {
  faces::SourceOptions source;
  int num_persons = 150;
  uint64_t seed = 1;
  double identity_spread = 1.0;
  std::vector<std::string> expressions;
  double expression_variation = 0.1;
  std::string levels = "whole";
  faces::ExaggerationOptions exaggeration;
  faces::PartExaggerationOptions parts;
  faces::CaricatureOptions caricature;
  std::vector<std::string> own_controls;
  int num_interpolated = 0;
  int family_size = 5;

  template <class V>
  void Visit(V&& visit) {
    visit("source", source, Table{}, "Where faces come from.");
    visit("num_persons", num_persons, Range{1, 100000},
          "Number of persons drawn from a model, each with every level and expression. A source of given meshes uses "
          "all of its meshes instead.");
    visit("seed", seed, Range{0, 9e15}, "Seed of all random numbers.");
    visit("identity_spread", identity_spread, Range{0.0, 3.0},
          "Factor of the standard deviation of every identity control.");
    visit("expressions", expressions, Text{},
          "Names of expressions, neutral first; empty: all expressions of the source.");
    visit("expression_variation", expression_variation, Range{0.0, 0.5},
          "Standard deviation of the strength with which a person shows an expression. The mean is 1; strengths are "
          "cut off at two deviations.");
    visit("levels", levels, Choices{{"whole", "parts", "controls"}},
          "whole: a level exaggerates the whole face by its gamma. parts: a level exaggerates each part of the face by "
          "its own random strength, in proportion to the gamma. controls: each level is a caricature by named "
          "controls, of the amount in caricature.amounts.");
    visit("exaggeration", exaggeration, Table{}, "Levels of exaggeration; the first gamma has to be 0.");
    visit("parts", parts, Table{}, "How strengths of parts are drawn.");
    visit("caricature", caricature, Table{}, "How values of controls are drawn.");
    visit("own_controls", own_controls, Text{},
          "Further controls. NAME=FILE.target: a target in the source's vertex numbers. NAME=FROM.obj,TO.obj: two "
          "meshes; value 1 moves FROM to TO.");
    visit("num_interpolated", num_interpolated, Range{0, 10000000},
          "Number of faces that are interpolated, each between two persons of a family.");
    visit("family_size", family_size, Range{2, 1000},
          "Number of persons in a family. Faces are interpolated within families; a split by person keeps a family in "
          "one subset.");
  }
};

/// The strength of each level: gammas of the exaggeration, or amounts of caricature where levels are by controls.
const std::vector<double>& LevelStrengths(const FacesOptions& options);

/// Writes a faces::FaceDatabase.
/// - Person p is DrawIdentity from Stream(seed, "identity", p).
/// - Levels of its neutral face are Exaggerate, ExaggerateParts with strengths from Stream(seed, "parts", p), or
///   caricatures of CaricatureGenerator with values from Stream(seed, "caricature", p), which measures what distinguishes
///   a person from 200 identities of Stream(seed, "population", i).
/// - Every expression is carried to every level by ExpressionTransfer; its displacement is multiplied by the person's
///   strength of that expression, from Stream(seed, "expression strengths", p), so that the faces are no plain
///   bilinear product of persons and expressions.
/// - Interpolated faces are Interpolate of faces of two persons of a family (datasets/build/interpolation.h).
/// A source that gives faces instead of a model goes to BuildGivenFaces. Resumes an interrupted build of the same
/// options.
/// @throws Error as BuildShards; UsageError on an unknown expression, if neutral or gamma 0 is not first, or if there
/// is nobody to interpolate with.
void BuildFaces(const FacesOptions& options, const std::filesystem::path& directory, const Task& task = {});
/// The same from a model at hand; `options.source` is only recorded.
void BuildFaces(const faces::FaceModel& model, const FacesOptions& options, const std::filesystem::path& directory,
                const Task& task = {});

}  // namespace daumier::datasets

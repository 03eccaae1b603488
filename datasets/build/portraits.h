#pragma once
#include "core/options.h"
#include "core/task.h"
#include "datasets/build/portrait_expressions.h"
#include "datasets/build/portrait_maker.h"
#include "faces/source.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace daumier::datasets {

struct PortraitsOptions {
  std::string faces;
  std::string expressions = "shapes";
  faces::SourceOptions source;
  int num_images = 3000;
  double big_eyes = 0.3;
  uint64_t seed = 1;
  bool vertices = true;
  bool buffers = false;
  PictureOptions pictures;

  template <class V>
  void Visit(V&& visit) {
    visit("faces", faces, Text{},
          "Folder of the faces that are portrayed: the neutral ones, of every person and level.");
    visit("expressions", expressions, Choices{{"shapes", "stored"}},
          "shapes: the expression shapes of `source`, carried to each face by deformation transfer. stored: mixes of "
          "the expressions that the folder of faces holds.");
    visit("source", source, Table{}, "The source of the faces, for its expression shapes.");
    visit("num_images", num_images, Range{1, 10000000},
          "Number of portraits, the same for every person up to one; levels take turns.");
    visit("big_eyes", big_eyes, Range{0, 1},
          "Share of faces (a person's level) whose eyes are enlarged in addition, by the control eye_size.");
    visit("seed", seed, Range{0, 9e15}, "Seed of all random numbers.");
    visit("vertices", vertices, Flag{}, "Store the vertices of each portrait: 6 bytes a vertex, 62 KB of ict.");
    visit("buffers", buffers, Flag{}, "Write an OpenEXR file of depth, normal and position a portrait.");
    visit("pictures", pictures, Table{}, "What a portrait looks like.");
  }
};

/// Writes a PortraitDatabase, a shard a person. Portrait i is of person floor(i P / N) and makes all of its choices from
/// Stream(seed, "portrait", i). Its face is PortraitExpressions::FaceOf of its level and weights; the neutral face is the
/// database's with a share of eyes enlarged (EnlargedEyes), with values from Stream(seed, "big eyes", face). With buffers it also
/// writes buffers/000000.exr and on. Resumes an interrupted build of the same options.
/// @throws Error as faces::FaceDatabase, LoadFaceModel, PortraitExpressions, PortraitMaker and BuildShards.
void BuildPortraits(const PortraitsOptions& options, const std::filesystem::path& directory, const Task& task = {});
/// The same with a model at hand; `options.source` is only recorded.
void BuildPortraits(const faces::FaceModel& model, const PortraitsOptions& options,
                    const std::filesystem::path& directory, const Task& task = {});

}  // namespace daumier::datasets

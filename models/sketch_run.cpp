#include "models/sketch_run.h"

#include "core/config.h"
#include "core/error.h"
#include "faces/face_database.h"
#include "tensor/module_state.h"

namespace daumier::models {

SketchRun LoadSketchRun(const std::filesystem::path& directory) {
  SketchRun run;
  run.directory = directory;
  DAUMIER_CHECK(std::filesystem::exists(directory / "manifest.json"),
                "{} is not a run folder (manifest.json is missing): make one with `daumier train CONFIG --out {}`",
                directory.string(), directory.string());
  run.manifest = ReadManifest(directory, "run");
  const auto config_file = directory / "resolved.toml", weights_file = directory / "best" / "model.safetensors";
  DAUMIER_CHECK(std::filesystem::exists(weights_file),
                "{} has no best weights yet ({} is missing): go on training it with `daumier train --resume --out {}`",
                directory.string(), weights_file.string(), directory.string());
  VerifyChecksums(directory, run.manifest);
  run.config = LoadConfig(config_file);
  DAUMIER_CHECK(run.config.contains("network"), "{} has no table 'network': it is not the config of a sketch run",
                config_file.string());
  run.face_template = faces::ReadFaceTemplate(directory);
  run.bilinear = faces::ReadBilinearModel(directory / "bilinear.safetensors");
  DAUMIER_CHECK(run.bilinear.num_coordinates() == 3 * run.face_template.num_vertices(),
                "{}: the bilinear model has {} coordinates, but the template {} vertices", directory.string(),
                run.bilinear.num_coordinates(), run.face_template.num_vertices());
  run.network = SketchNetwork(ParseOptions<PixelCnnOptions>(run.config["network"], config_file.string()), run.bilinear);
  tensor::LoadModule(weights_file, *run.network);
  run.network->eval();
  return run;
}

}  // namespace daumier::models

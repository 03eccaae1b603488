#pragma once
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

/// The program run as its users run it, on a database small enough for a test.
namespace daumier::testing {

inline std::vector<std::string> Command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {DAUMIER_PROGRAM, "--quiet"});
  return arguments;
}

inline ProcessResult Daumier(std::vector<std::string> arguments) {
  return RunProcess(Command(std::move(arguments)));
}

/// Six persons, three expressions and two levels of the default source.
inline std::vector<std::string> FacesCommand(const std::filesystem::path& out) {
  return {"dataset",
          "faces",
          "--out",
          out.string(),
          "source.path=" + MakeHumanData()->string(),
          "num_persons=6",
          "exaggeration.gammas=[0.0, 0.2]",
          "expressions=[\"neutral\", \"smile\", \"surprise\"]",
          "seed=3"};
}

inline std::vector<std::string> SketchesCommand(const std::filesystem::path& faces, const std::filesystem::path& out) {
  return {"dataset", "sketches", "--out", out.string(), "faces=" + faces.string()};
}

inline std::vector<std::string> TrainCommand(const std::filesystem::path& data, const std::filesystem::path& run) {
  return {"train",
          (SourceRoot() / "configs/sketch/demo.toml").string(),
          "--out",
          run.string(),
          "data.faces=" + (data / "faces").string(),
          "data.sketches=" + (data / "sketches").string(),
          "split.validation=0.2",
          "split.test=0.2",
          "bilinear.num_identity=4",
          "bilinear.num_expression=3",
          "network.resolution=32",
          "network.width=8",
          "network.hidden=32",
          "epochs=3",
          "batch=8"};
}

}  // namespace daumier::testing

#pragma once
#include "core/files.h"
#include "studio/studio.h"
#include "systems/sketch/predictor.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"

#include <memory>
#include <string>

/// What tests of the studio open once a program, as it takes a second: the shipped weights.
namespace daumier::testing {

inline std::filesystem::path ShippedFolder(const std::string& name) {
  return SourceRoot() / "weights" / name;
}

inline std::shared_ptr<const sketch::SketchPredictor> ShippedSketchPredictor() {
  static const auto predictor = sketch::OpenSessionPredictor(ShippedFolder("sketch-ict"), {});
  return predictor;
}

inline studio::FaceShaper& ShippedShaper() {
  static studio::FaceShaper shaper(ShippedFolder("face-ict"));
  return shaper;
}

/// A program that is not there: jobs which start it write their files, and fail.
inline constexpr const char* kNoProgram = "/nonexistent/daumier";

/// A studio whose folder has one session, s-0007, and what an earlier start has left in uploads/ and jobs/.
class ShippedStudio {
 public:
  static ShippedStudio& Get() {
    static ShippedStudio shipped;
    return shipped;
  }
  studio::Studio& studio() { return *studio_; }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  ShippedStudio() {
    for (const char* part : {"sessions/s-0007", "uploads/u-0001", "jobs/j-0001"}) MakeDirectory(folder_ / part);
    WriteFileAtomically(folder_ / "sessions/s-0007/about.json",
                        R"({"name": "Kept", "sheet": [300, 200], "begin": "mean"})");
    WriteFileAtomically(folder_ / "uploads/u-0001/old.csv", "old");
    WriteFileAtomically(folder_ / "jobs/j-0001/old.glb", "old");
    studio_ = std::make_unique<studio::Studio>(folder_.path(),
                                               studio::StudioWeights{.sketch = ShippedFolder("sketch-ict"),
                                                                     .face_model = ShippedFolder("face-ict"),
                                                                     .gestures = ShippedFolder("gestures"),
                                                                     .has_portraits = true},
                                               SourceRoot() / "docs/examples/sessions", kNoProgram);
  }

  const TempDir folder_;
  std::unique_ptr<studio::Studio> studio_;
};

}  // namespace daumier::testing

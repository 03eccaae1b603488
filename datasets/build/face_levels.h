#pragma once
#include "datasets/build/faces.h"
#include "datasets/build/faces_plan.h"
#include "faces/controls/caricature_generator.h"
#include "faces/face_parts.h"

#include <functional>
#include <optional>
#include <vector>

namespace daumier::datasets {

/// The neutral faces of which the mean and the deviations of controls are those: num_faces of them, 0-based.
struct Population {
  int num_faces;
  std::function<geometry::Points(int)> face;
};

/// Makes the levels of persons' neutral faces as specified by options.levels. Keeps references to the template and the
/// options. Thread-safe once made.
class LevelMaker {
 public:
  /// `population` is used only where levels are by controls. @throws Error as faces::MakeFaceParts (levels by parts),
  /// faces::CaricatureGenerator and faces::ReadGivenControls (levels by controls).
  LevelMaker(const faces::FaceTemplate& face_template, const FacesOptions& options, const Population& population,
             const faces::SourceNumbering& numbering = {});

  /// The levels of a person's neutral face (V x 3, cm), NumLevels of them. Strengths of parts are drawn from
  /// Stream(seed, "parts", person), control values from Stream(seed, "caricature", person), and appended to `arrays`.
  /// With gamma 0 alone, exaggerated as a whole, it is the face itself, which needs no region of the annotation.
  std::vector<geometry::Points> Make(const geometry::Points& neutral, int person, PersonArrays& arrays) const;

  /// What the manifest's details say of parts or controls.
  Json Details() const;

 private:
  std::vector<geometry::Points> MakeByParts(const geometry::Points& neutral, int person, PersonArrays& arrays) const;
  std::vector<geometry::Points> MakeByControls(const geometry::Points& neutral, int person, PersonArrays& arrays) const;

  const faces::FaceTemplate& face_template_;
  const FacesOptions& options_;
  faces::FaceParts parts_;
  std::optional<faces::CaricatureGenerator> generator_;
};

}  // namespace daumier::datasets

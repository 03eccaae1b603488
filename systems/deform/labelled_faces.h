#pragma once
#include "core/task.h"
#include "faces/controls/control_fit.h"
#include "faces/face_database.h"
#include "fitting/code_directions.h"
#include "systems/deform/open_code_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::deform {

/// The label of faces of a level above the first.
inline constexpr const char* kCaricatureLabel = "caricature";

/// Anatomical controls as labels: their values on a neutral face, measured by faces::ControlFit from the mean of the
/// regular ones; of a pair the mean of both sides.
class ControlLabels {
 public:
  /// database: its neutral faces of the first level are the regular ones. @throws Error as ControlFit.
  explicit ControlLabels(const faces::FaceDatabase& database);

  const std::vector<std::string>& names() const { return names_; }
  /// One value a name. face: V x 3, cm.
  Eigen::VectorXd Of(const geometry::Points& face) const;

 private:
  faces::FaceControls controls_;
  faces::ControlFit fit_;
  std::vector<std::string> names_;
};

/// Labelled faces, and the mean code of the regular ones (neutral, first level), from which a face is exaggerated.
struct LabelledDatabase {
  fitting::LabelledCodes faces;
  Eigen::VectorXd regular_mean;  ///< M; empty where there are no regular faces among them.
};

/// Faces of a database as codes with labels:
/// - ControlLabels of the neutral faces (others are not labelled by these), where there are enough regular faces,
/// - each expression by its name: 1, and 0 of neutral faces; other expressions are not labelled,
/// - kCaricatureLabel: 1 of levels above the first.
/// At most `most` faces, evenly spaced; of a run's own faces those that it was trained on, with their codes, others by
/// CodesOfMeshes. @throws Error if the topology is another one than the model's; Cancelled.
LabelledDatabase LabelledFaces(const OpenedModel& opened, const faces::FaceDatabase& database, int most,
                               const Task& task = {});

/// Labels of a CSV file on faces of a database (WebCariA's attributes in columns): a header `name,LABEL,...`, a row a
/// face: its name (face-00012, person-00003-level-1-smile, or a person's), then 0 or 1, -1 or 1, or any numbers; an
/// empty cell: not labelled.
/// @throws Error naming file and line: no header, a row of another length, no number, a face that is not there.
fitting::LabelledCodes LabelledByFile(const OpenedModel& opened, const faces::FaceDatabase& database,
                                      const std::filesystem::path& file, const Task& task = {});

}  // namespace daumier::deform

#include "faces/controls/given_controls.h"

#include "core/error.h"
#include "faces/morph_target.h"
#include "geometry/obj.h"
#include "geometry/ply.h"

#include <filesystem>

namespace daumier::faces {
namespace {

namespace fs = std::filesystem;

/// Of the template's vertices, cm: a row of each in `points`, which are the template's or the source's.
geometry::Points OfTemplate(const geometry::Points& points, const FaceTemplate& face_template,
                            const SourceNumbering& numbering, const fs::path& file) {
  if (points.rows() == face_template.num_vertices()) return points;
  DAUMIER_CHECK(!numbering.vertices.empty() && points.rows() == numbering.num_vertices,
                "{} has {} vertices; a control of this template needs its {} vertices{}", file.string(), points.rows(),
                face_template.num_vertices(),
                numbering.vertices.empty() ? "" : fmt::format(" or the {} of its source", numbering.num_vertices));
  return numbering.cm_per_unit * points(numbering.vertices, Eigen::all);
}

geometry::Points VerticesInFile(const fs::path& file) {
  return (file.extension() == ".ply" ? geometry::ReadPly(file) : geometry::ReadObj(file)).vertices;
}

}  // namespace

std::vector<GivenControl> ReadGivenControls(const std::vector<std::string>& specifications,
                                            const FaceTemplate& face_template, const SourceNumbering& numbering) {
  std::vector<GivenControl> controls;
  for (const std::string& specification : specifications) {
    const size_t equals = specification.find('='), comma = specification.find(',', equals + 1);
    const auto bad = [&](const std::string& reason) {
      return UsageError(
          fmt::format("control '{}': {}; write NAME=FILE.target or NAME=FROM.obj,TO.obj", specification, reason));
    };
    if (equals == std::string::npos || equals == 0) throw bad("it has no name");
    GivenControl control{specification.substr(0, equals), {}};
    const fs::path first = specification.substr(equals + 1, comma == std::string::npos ? comma : comma - equals - 1);
    if (comma != std::string::npos) {
      const fs::path second = specification.substr(comma + 1);
      const geometry::Points from = VerticesInFile(first), to = VerticesInFile(second);
      control.displacement =
          OfTemplate(to, face_template, numbering, second) - OfTemplate(from, face_template, numbering, first);
    } else if (first.extension() == ".target") {
      if (numbering.vertices.empty())
        throw bad("the vertex numbers of this source are not known, so that a .target cannot be read");
      control.displacement =
          numbering.cm_per_unit * ReadMorphTarget(first, numbering.num_vertices)(numbering.vertices, Eigen::all);
    } else {
      throw bad("one file that is no .target");
    }
    DAUMIER_CHECK(control.displacement.rowwise().norm().maxCoeff() > 0, "control '{}' moves no vertex of the template",
                  control.name);
    controls.push_back(std::move(control));
  }
  return controls;
}

}  // namespace daumier::faces

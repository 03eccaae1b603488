#include "faces/controls/given_controls.h"

#include "core/error.h"
#include "faces/morph_target.h"
#include "geometry/obj.h"
#include "geometry/ply.h"

#include <algorithm>
#include <cctype>
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

std::string Extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

geometry::Points VerticesInFile(const fs::path& file) {
  const geometry::Points vertices =
      (Extension(file) == ".ply" ? geometry::ReadPly(file) : geometry::ReadObj(file)).vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    DAUMIER_CHECK(vertices.row(v).allFinite(),
                  "{}: vertex {} is not finite; a control needs all vertices of its meshes", file.string(), v);
  }
  return vertices;
}

std::string Trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

bool IsName(const std::string& name) {
  constexpr size_t kMaxLength = 64;
  return !name.empty() && name.size() <= kMaxLength &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

/// @throws Error if nothing moves, or a vertex farther than the face is large: another unit, or another order of vertices.
void CheckDisplacement(const GivenControl& control, const FaceTemplate& face_template) {
  const geometry::Points& points = face_template.neutral;
  const double size = (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
  Eigen::Index farthest = 0;
  const double most = control.displacement.rowwise().norm().maxCoeff(&farthest);
  DAUMIER_CHECK(most > 0, "control '{}' moves no vertex of the template", control.name);
  DAUMIER_CHECK(most < size / 4,
                "control '{}' moves vertex {} of the template by {:.3g} cm, more than a quarter of the head ({:.3g} "
                "cm); have its "
                "files the unit and the order of vertices of the template?",
                control.name, farthest, most, size);
}

}  // namespace

std::vector<GivenControl> ReadGivenControls(const std::vector<std::string>& specifications,
                                            const FaceTemplate& face_template, const SourceNumbering& numbering) {
  std::vector<GivenControl> controls;
  for (const std::string& specification : specifications) {
    const size_t equals = specification.find('='), comma = specification.find(',', equals + 1);
    const auto bad = [&](const std::string& reason) {
      return UsageError(
          fmt::format("own_controls '{}': {}; write NAME=FILE.target or NAME=FROM.obj,TO.obj", specification, reason));
    };
    if (equals == std::string::npos) throw bad("there is no '='");
    GivenControl control{Trimmed(specification.substr(0, equals)), {}};
    if (!IsName(control.name)) throw bad("a name has 1 to 64 letters, digits, _ and -");
    const auto& known = AnatomicalControls();
    if (std::ranges::any_of(known, [&](const FaceControl& other) { return other.name == control.name; }))
      throw bad("there is a control of this name already");
    const fs::path first =
        Trimmed(specification.substr(equals + 1, comma == std::string::npos ? comma : comma - equals - 1));
    if (first.empty()) throw bad("it has no file");
    if (comma != std::string::npos) {
      const fs::path second = Trimmed(specification.substr(comma + 1));
      if (second.empty()) throw bad("it has one file; two meshes are needed");
      const geometry::Points from = VerticesInFile(first), to = VerticesInFile(second);
      control.displacement =
          OfTemplate(to, face_template, numbering, second) - OfTemplate(from, face_template, numbering, first);
    } else if (Extension(first) == ".target") {
      if (numbering.vertices.empty())
        throw bad("the vertex numbers of this source are not known, so that a .target cannot be read");
      control.displacement =
          numbering.cm_per_unit * ReadMorphTarget(first, numbering.num_vertices)(numbering.vertices, Eigen::all);
    } else {
      throw bad("one file that is no .target");
    }
    CheckDisplacement(control, face_template);
    controls.push_back(std::move(control));
  }
  return controls;
}

}  // namespace daumier::faces

#include "datasets/build/face_attributes.h"

#include "core/error.h"
#include "core/parallel.h"
#include "datasets/build/identity_sliders.h"
#include "datasets/build/interpolation.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

using geometry::Vector3;

/// A face of the grid as an interpolation that goes nowhere, any other as it was made.
Interpolation Origin(const faces::FaceDatabase& database, int face) {
  if (face >= database.num_grid_faces()) return ReadInterpolation(database, face);
  return {database.id(face), database.id(face), 0, 0};
}

/// The same person and expression without exaggeration.
geometry::Points RegularFace(const faces::FaceDatabase& database, int face, Interpolation origin) {
  origin.a.level = origin.b.level = 0;
  if (face < database.num_grid_faces()) return database.points(database.index(origin.a));
  const std::vector<float> vertices = Interpolate(database.directory(), origin);
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(vertices.data(), database.num_vertices(), 3).cast<double>();
}

double HeightToHairline(const faces::Annotation& annotation, const geometry::Points& face) {
  return face(annotation.hairline_vertex, 1) - face(annotation.landmarks[8], 1);
}

/// The shares of both parents: s is that of the second.
double Mix(double a, double b, float s) {
  return (1 - double(s)) * a + double(s) * b;
}

}  // namespace

std::vector<std::string> MeasuredAttributeNames() {
  return {"smile", "mouth_open", "nose_size", "forehead", "chin", "face_width"};
}

Eigen::RowVectorXf MeasureAttributes(const faces::FaceTemplate& face_template, const geometry::Points& face) {
  const faces::Annotation& annotation = face_template.annotation;
  const auto at = [&](int landmark) -> Vector3 { return face.row(annotation.landmarks[size_t(landmark)]).transpose(); };
  const auto distance = [&](int a, int b) { return (at(a) - at(b)).norm(); };
  const double eyes = distance(36, 45), height = HeightToHairline(annotation, face);
  DAUMIER_CHECK(eyes > 0 && height > 0, "a face whose eyes are {} cm apart, and {} cm high", eyes, height);

  double brows = 0;
  for (int landmark = 17; landmark <= 26; ++landmark) brows += at(landmark).y() / 10;
  const double lips = (at(62).y() + at(66).y()) / 2, corners = (at(48).y() + at(54).y()) / 2;
  const double nose_depth = at(30).z() - (at(31).z() + at(35).z()) / 2;
  Eigen::RowVectorXd values(6);
  values << (distance(48, 54) / 2 + corners - lips) / eyes, (at(62).y() - at(66).y()) / eyes,
      (distance(27, 33) + distance(31, 35) + nose_depth) / 3 / eyes,
      (face(annotation.hairline_vertex, 1) - brows) / height, (at(57).y() - at(8).y()) / height,
      distance(0, 16) / height;
  return values.cast<float>();
}

std::vector<std::string> FaceAttributeNames(const faces::FaceDatabase& database) {
  std::vector<std::string> names = MeasuredAttributeNames();
  names.insert(names.end(), {"exaggeration", "caricature"});
  const std::vector<std::string> sliders = SlidersOf(database).names;
  names.insert(names.end(), sliders.begin(), sliders.end());
  return names;
}

AttributeTable FaceAttributes(const faces::FaceDatabase& database) {
  AttributeTable table;
  table.names = FaceAttributeNames(database);
  table.values.resize(database.num_faces(), Eigen::Index(table.names.size()));
  const std::vector<double> gammas = database.gammas();
  const faces::FaceTemplate& face_template = database.face_template();
  const std::vector<int>& region = faces::RegionFor(face_template.annotation, "face", "attributes");
  const auto num_measured = Eigen::Index(MeasuredAttributeNames().size());
  const IdentitySliders sliders = SlidersOf(database);
  OnAllCores(database.num_faces(), [&](int64_t index) {
    const auto face = static_cast<int>(index);
    const geometry::Points points = database.points(face);
    const Interpolation origin = Origin(database, face);
    const auto& [a, b, identity_share, expression_share] = origin;
    const geometry::Points regular = RegularFace(database, face, origin);
    const double distance = (points - regular)(region, Eigen::all).rowwise().norm().mean();
    const auto exaggerated = [&](const faces::FaceId& id) { return gammas.at(size_t(id.level)) > 0 ? 1.0 : 0.0; };

    auto row = table.values.row(face);
    row.head(num_measured) = MeasureAttributes(face_template, points);
    row[num_measured] = static_cast<float>(distance / HeightToHairline(face_template.annotation, points));
    row[num_measured + 1] = Mix(exaggerated(a), exaggerated(b), identity_share) >= 0.5 ? 1 : 0;
    if (sliders.names.empty()) return;
    const auto weights = [&](int person) {
      const auto numbers = database.identity_weights(person);
      return Eigen::Map<const Eigen::VectorXf>(numbers.data(), Eigen::Index(numbers.size()));
    };
    const Eigen::VectorXf mixed = (1 - identity_share) * weights(a.person) + identity_share * weights(b.person);
    row.tail(Eigen::Index(sliders.names.size())) = (sliders.from_weights * mixed).transpose();
  });
  return table;
}

}  // namespace daumier::datasets

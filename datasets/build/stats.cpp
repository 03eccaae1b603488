#include "datasets/build/stats.h"

#include "core/error.h"
#include "core/random.h"
#include "faces/principal_components.h"
#include "geometry/symmetric_eigen.h"

#include <algorithm>
#include <vector>

namespace daumier::datasets {

int NumPrincipalComponents(const faces::FaceDatabase& database, std::span<const int> faces, double share) {
  const auto num_faces = static_cast<Eigen::Index>(faces.size());
  const Eigen::MatrixXd gram = faces::GramMatrix(
      int(num_faces), 3 * database.num_vertices(), [&](int i) { return database.vertices(faces[i]); },
      faces::Centring::kMean);
  const Eigen::VectorXd variances = geometry::SymmetricEigenvalues(gram).cwiseMax(0);
  const double total = variances.sum();
  double explained = 0;
  int count = 0;
  while (count < num_faces && total > 0 && explained < share * total) explained += variances(num_faces - ++count);
  return count;
}

std::vector<int> SampleFaces(const faces::FaceDatabase& database, int count) {
  std::vector<int> faces = Stream(0, "sample of faces").Permutation(database.num_faces());
  faces.resize(std::min(count, database.num_faces()));
  std::sort(faces.begin(), faces.end());
  return faces;
}

Json FaceStatistics(const std::filesystem::path& directory) {
  const faces::FaceDatabase database(directory);
  std::vector<int> neutrals;
  for (int person = 0; person < database.num_persons(); ++person) neutrals.push_back(database.index({person, 0, 0}));
  constexpr int kMaxFaces = 1500;
  const std::vector<int> chosen = SampleFaces(database, kMaxFaces);
  constexpr double kShare = 0.99;
  const Manifest& manifest = database.manifest();
  Json result = manifest.counts;
  result["source"] = manifest.details.at("source");
  result["licences"] = manifest.sources;
  result["gammas"] = manifest.details.at("gammas");
  result["expression_names"] = manifest.details.at("expressions");
  if (manifest.details.contains("failed")) result["failed"] = manifest.details.at("failed");
  result["millimetres_per_cm"] = faces::MillimetresPerCm(database.face_template());
  result["data_hash"] = DataHash(directory);
  result["principal_components_99"] = {{"identities", NumPrincipalComponents(database, neutrals, kShare)},
                                       {"faces", NumPrincipalComponents(database, chosen, kShare)},
                                       {"num_faces", chosen.size()}};
  return result;
}

}  // namespace daumier::datasets

#include "faces/face_basis.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "faces/principal_components.h"

namespace daumier::faces {
namespace {

/// A direction that explains a smaller share than this of the first one is rounding.
constexpr double kLeastShare = 1e-12;

void StopBasisIfCancelled(const Task& task) {
  task.ThrowIfCancelled("stopped while a basis of faces was fitted; nothing was written");
}

}  // namespace

FaceBasis FitFaceBasis(int num_faces, int num_coordinates, const std::function<std::span<const float>(int)>& face,
                       int size, const Task& task) {
  DAUMIER_CHECK(size > 0 && size <= num_faces, "{} directions cannot be fitted to {} faces", size, num_faces);
  const SnapshotComponents components =
      FindComponents(GramMatrix(num_faces, num_coordinates, face, Centring::kNone), size, kLeastShare);
  DAUMIER_CHECK(components.variances.size() == size, "{} directions cannot be fitted to faces that span fewer", size);

  BilinearModel::Core faces(num_faces, num_coordinates);
  for (int i = 0; i < num_faces; ++i) {
    StopBasisIfCancelled(task);
    faces.row(i) = Eigen::Map<const Eigen::RowVectorXf>(face(i).data(), num_coordinates);
  }
  FaceBasis basis;
  basis.rows = components.weights.cast<float>().transpose() * faces;
  for (int k = 0; k < size; ++k) FixSign(basis.rows.row(k));
  return basis;
}

std::string WriteFaceBasis(const std::filesystem::path& file, const FaceBasis& basis) {
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "face basis");
  writer.Add<float>("rows", {basis.rows.rows(), basis.rows.cols()},
                    {basis.rows.data(), static_cast<size_t>(basis.rows.size())});
  writer.Add<float>("deviation", {basis.deviation.size()},
                    {basis.deviation.data(), static_cast<size_t>(basis.deviation.size())});
  return writer.Write(file);
}

FaceBasis ReadFaceBasis(const std::filesystem::path& file) {
  const SafetensorsFile arrays(file);
  const ArrayView &rows = arrays.at("rows"), &deviation = arrays.at("deviation");
  DAUMIER_CHECK(rows.shape.size() == 2 && deviation.shape.size() == 1 && rows.shape[0] == deviation.shape[0],
                "{}: a basis has a deviation for each of its rows", file.string());
  return {Eigen::Map<const BilinearModel::Core>(rows.As<float>().data(), rows.shape[0], rows.shape[1]),
          Eigen::Map<const Eigen::VectorXf>(deviation.As<float>().data(), deviation.shape[0])};
}

}  // namespace daumier::faces

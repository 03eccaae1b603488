#include "faces/face_basis.h"

#include "core/error.h"
#include "core/safetensors.h"
#include "faces/leading_eigenvectors.h"

#include <algorithm>

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
  BilinearModel::Core faces(num_faces, num_coordinates);
  for (int i = 0; i < num_faces; ++i) {
    StopBasisIfCancelled(task);
    const std::span<const float> coordinates = face(i);
    DAUMIER_CHECK(int(coordinates.size()) == num_coordinates, "face {} has {} coordinates, expected {}", i,
                  coordinates.size(), num_coordinates);
    faces.row(i) = Eigen::Map<const Eigen::RowVectorXf>(coordinates.data(), num_coordinates);
  }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(num_faces, num_faces);
  constexpr Eigen::Index kBlock = 4096;  // Coordinates at a time, so that the double copy stays small.
  for (Eigen::Index begin = 0; begin < num_coordinates; begin += kBlock) {
    StopBasisIfCancelled(task);
    const Eigen::Index width = std::min<Eigen::Index>(kBlock, num_coordinates - begin);
    gram.selfadjointView<Eigen::Lower>().rankUpdate(faces.middleCols(begin, width).cast<double>().eval());
  }
  const auto [variances, directions] = FindLeadingEigenvectors(gram, size);
  DAUMIER_CHECK(variances[size - 1] > kLeastShare * variances[0],
                "{} directions cannot be fitted to faces that span fewer", size);

  FaceBasis basis;
  const Eigen::MatrixXf weights = (directions * variances.cwiseSqrt().cwiseInverse().asDiagonal()).cast<float>();
  basis.rows = weights.transpose() * faces;
  for (int k = 0; k < size; ++k) {
    Eigen::Index largest = 0;
    basis.rows.row(k).cwiseAbs().maxCoeff(&largest);
    if (basis.rows(k, largest) < 0) basis.rows.row(k) *= -1;
  }
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

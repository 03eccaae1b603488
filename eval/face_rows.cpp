#include "eval/face_rows.h"

namespace daumier::eval {

Eigen::RowVectorXf MeanFace(const FaceReader& vertices, std::span<const int> faces) {
  DAUMIER_CHECK(!faces.empty(), "a mean face needs training faces");
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(Eigen::Index(vertices(faces[0]).size()));
  for (const int face : faces) {
    const std::span<const float> numbers = vertices(face);
    DAUMIER_CHECK(Eigen::Index(numbers.size()) == sum.size(), "face {} has {} numbers, others have {}", face,
                  numbers.size(), sum.size());
    sum += AsRow(numbers).cast<double>();
  }
  return (sum / double(faces.size())).cast<float>();
}

CentredRows Centre(FaceRows rows) {
  DAUMIER_CHECK(rows.rows() > 0, "a mean needs faces");
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(rows.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    DAUMIER_CHECK(rows.row(i).allFinite(), "row {} contains a number that is not finite", i);
    sum += rows.row(i).cast<double>();
  }
  Eigen::RowVectorXf mean = (sum / double(rows.rows())).cast<float>();
  rows.rowwise() -= mean;
  return {std::move(rows), std::move(mean)};
}

}  // namespace daumier::eval

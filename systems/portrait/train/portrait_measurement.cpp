#include "systems/portrait/train/portrait_measurement.h"

#include "core/error.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/portrait_angles.h"
#include "systems/portrait/portrait_metrics.h"

#include <cmath>

namespace daumier::portrait {
namespace {

void SetMean(reports::MetricTable& table, reports::MetricRow& row, const char* key, const std::vector<double>& values) {
  if (values.empty()) return;
  double sum = 0;
  for (const double value : values) sum += value;
  row.values.at(*reports::FindColumn(table.columns, key)) = reports::MetricValue{sum / double(values.size()), {}};
}

fitting::PortraitPose OnlyAngles(const float* angles) {
  fitting::PortraitPose pose = fitting::PortraitPose::Zero();
  for (int k = 0; k < 3; ++k) pose[k] = angles[k];
  return pose;
}

}  // namespace

CropMeasurement::CropMeasurement(const faces::MorphableModel& model, const datasets::PortraitDatabase& portraits,
                                 const std::vector<int>& images, const std::vector<PictureMap>& maps, uint64_t seed)
    : painter_(model), measure_(model.face_template), seed_(seed) {
  DAUMIER_CHECK(!images.empty() && images.size() == maps.size(), "{} portraits with {} crops are measured",
                images.size(), maps.size());
  table_.columns = PortraitColumns();
  const int side = portraits.image_size();
  for (size_t i = 0; i < images.size(); ++i) {
    const int image = images[i];
    MeasuredPortrait portrait;
    portrait.image = image;
    portrait.person = portraits.person(image);
    portrait.map = maps[i];
    portrait.crop = WarpPicture(portraits.picture(image), maps[i]);
    portrait.shown = FaceMask(WarpPicture(portraits.mask(image), maps[i], Sampling::kNearest));
    const std::vector<float> in_picture = portraits.landmarks(image);
    portrait.landmarks = MapLandmarks(in_picture, maps[i]);
    portrait.vertices = portraits.vertices(image);
    portrait.states = portraits.states(image);
    const Eigen::Vector2d from = OffsetOf(in_picture, side) * (double(kPortraitSide) / side);
    portrait.angles =
        MovedAngles(portraits.pose(image), from, OffsetOf(portrait.landmarks, kPortraitSide), maps[i].rotation());
    table_.faces.push_back(image);
    table_.groups.push_back(portrait.person);
    portraits_.push_back(std::move(portrait));
  }
}

void CropMeasurement::AddRow(const std::string& name, const PortraitGuesses& guesses, bool baseline) {
  const size_t count = guesses.coefficients.size();
  DAUMIER_CHECK(count > 0 && count <= portraits_.size(), "row '{}' has {} guesses for {} portraits", name, count,
                portraits_.size());
  reports::FaceValues values;
  std::vector<double> closed_eyes, winks, photometric;
  for (size_t i = 0; i < count; ++i) {
    const std::vector<float>& x = guesses.coefficients[i];
    const MeasuredPortrait& portrait = portraits_[i];
    const faces::ColouredFace face = faces::Reconstruct(painter_.model(), x);
    const FacePicture picture = painter_.Paint(face, x);
    values["error"].push_back(measure_.SimilarityErrorMm(face.vertices, portrait.vertices));
    values["landmark_error"].push_back(NormalisedError(picture.landmarks, portrait.landmarks));
    values["angle_error"].push_back(
        fitting::AngleBetween(OnlyAngles(x.data() + faces::kPoseSlot.first), OnlyAngles(portrait.angles.data())));
    const double colours = PhotometricError(picture, portrait.crop, portrait.shown);
    if (std::isfinite(colours)) photometric.push_back(colours);
    const OpeningErrors openings = CompareGaps(measure_.GapsMm(face.vertices), portrait.states);
    values["mouth"].push_back(openings.mouth);
    if (openings.closed_eyes) closed_eyes.push_back(*openings.closed_eyes);
    if (openings.wink) winks.push_back(*openings.wink);
  }
  reports::MetricRow row = reports::MakeRow(table_, name, values, seed_);
  row.baseline = baseline;
  SetMean(table_, row, "photometric", photometric);
  SetMean(table_, row, "closed_eyes", closed_eyes);
  SetMean(table_, row, "wink", winks);
  SetMean(table_, row, "num_images", {double(count)});
  if (guesses.ms) SetMean(table_, row, "ms", {*guesses.ms});
  row.details = {{"closed_eyes_pictures", closed_eyes.size()}, {"wink_pictures", winks.size()}};
  table_.rows.push_back(std::move(row));
}

}  // namespace daumier::portrait

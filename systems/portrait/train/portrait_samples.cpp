#include "systems/portrait/train/portrait_samples.h"

#include "core/error.h"
#include "losses/landmark_loss.h"
#include "systems/portrait/portrait_angles.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace daumier::portrait {
namespace {

std::vector<float> MarkedWeights() {
  const torch::Tensor weights = losses::PortraitLandmarkWeights();
  return {weights.data_ptr<float>(), weights.data_ptr<float>() + weights.numel()};
}

void Copy(const std::vector<float>& from, FloatArray& to, int64_t b) {
  DAUMIER_CHECK(int64_t(from.size()) == to.row_size(), "{} numbers, expected {}", from.size(), to.row_size());
  std::copy(from.begin(), from.end(), to.row(b));
}

/// Brightness and contrast of all channels, and a little of each.
void ChangeTones(std::vector<float>& planes, double amount, Rng& rng) {
  const size_t plane = planes.size() / 3;
  const double contrast = 1 + amount * rng.Uniform(-1, 1), brightness = amount * rng.Uniform(-1, 1);
  for (size_t c = 0; c < 3; ++c) {
    const float gain = float(contrast * (1 + 0.5 * amount * rng.Uniform(-1, 1))), lift = float(brightness);
    for (size_t i = c * plane; i < (c + 1) * plane; ++i)
      planes[i] = std::clamp((planes[i] - 0.5F) * gain + 0.5F + lift, 0.0F, 1.0F);
  }
}

}  // namespace

PictureMap PlainCrop(const datasets::PortraitDatabase& database, int image, const PortraitPictureOptions& options) {
  const int side = database.image_size();
  return options.crop == "none" ? CropOfWhole(side, side) : CropOfLandmarks(database.landmarks(image), options.size);
}

std::vector<int> ImagesOfPersons(const datasets::PortraitDatabase& portraits, const std::vector<int>& persons,
                                 const std::vector<std::string>& leave_out) {
  for (const std::string& style : leave_out) {
    if (style == kBaldStyle || std::ranges::count(portraits.style_names(), style) > 0) continue;
    throw UsageError(fmt::format("pictures.leave_out: the portraits have no style '{}' (expected {} or {})", style,
                                 kBaldStyle, fmt::join(portraits.style_names(), ", ")));
  }
  const std::set<int> wanted(persons.begin(), persons.end());
  const std::set<std::string> unwanted(leave_out.begin(), leave_out.end());
  std::vector<int> images;
  for (int i = 0; i < portraits.size(); ++i) {
    if (!wanted.contains(portraits.person(i)) || unwanted.contains(portraits.style(i))) continue;
    if (portraits.is_bald(i) && unwanted.contains(kBaldStyle)) continue;
    images.push_back(i);
  }
  return images;
}

CropSamples::CropSamples(const datasets::PortraitDatabase& portraits, std::vector<int> images,
                         const datasets::PortraitDatabase* real, const PortraitTrainingOptions& options, Jitter jitter,
                         PortraitArrays arrays)
    : portraits_(portraits),
      images_(std::move(images)),
      real_(real),
      options_(options),
      jitter_(jitter),
      arrays_(arrays),
      landmark_weights_(MarkedWeights()) {
  DAUMIER_CHECK(!arrays.vertices || portraits.has_vertices(),
                "the portraits were built without vertices, which the loss needs: build them with vertices=true");
}

int CropSamples::size() const {
  return int(images_.size()) + (real_ == nullptr ? 0 : real_->size());
}

CropSamples::Row CropSamples::RowOf(int sample) const {
  DAUMIER_CHECK(sample >= 0 && sample < size(), "portrait sample {} of {}", sample, size());
  if (sample < int(images_.size())) return {&portraits_, images_[size_t(sample)], true};
  return {real_, sample - int(images_.size()), false};
}

SampleBatch CropSamples::Get(std::span<const int> samples, int64_t epoch) const {
  const auto batch_size = int64_t(samples.size());
  const int64_t r = options_.network.resolution;
  SampleBatch batch;
  batch.samples.assign(samples.begin(), samples.end());
  const auto add = [&](const char* name, std::vector<int64_t> shape) {
    shape.insert(shape.begin(), batch_size);
    batch.arrays[name] = FloatArray(shape);
  };
  add("input", {3, r, r});
  add("landmarks", {68, 2});
  add("landmark_weights", {68});
  add("known", {});
  add("expression", {64});
  add("albedo", {80});
  add("light", {9});
  add("angles", {3});
  if (arrays_.picture) {
    add("picture", {3, kPortraitSide, kPortraitSide});
    add("skin", {1, kPortraitSide, kPortraitSide});
  }
  if (arrays_.vertices) add("vertices", {portraits_.face_template().num_vertices(), 3});
  for (int64_t b = 0; b < batch_size; ++b) Fill(batch, b, samples[size_t(b)], epoch);
  return batch;
}

void CropSamples::Fill(SampleBatch& batch, int64_t b, int sample, int64_t epoch) const {
  const Row row = RowOf(sample);
  const datasets::PortraitDatabase& database = *row.database;
  Rng rng = Stream(options_.seed, "portrait sample", uint64_t(epoch) * uint64_t(size()) + uint64_t(sample));
  const int side = database.image_size();
  PictureMap map = PlainCrop(database, row.image, options_.pictures);
  if (jitter_ == Jitter::kRandom) map = Compose(DrawJitter(options_.pictures, rng), map);
  const render::Image crop = WarpPicture(database.picture(row.image), map);

  const auto array = [&](const char* name) -> FloatArray& { return batch.arrays.at(name); };
  std::vector<float> input = NetworkPicture(crop, options_.network.resolution);
  if (jitter_ == Jitter::kRandom) ChangeTones(input, options_.pictures.colour, rng);
  Copy(input, array("input"), b);
  const std::vector<float> in_picture = database.landmarks(row.image), landmarks = MapLandmarks(in_picture, map);
  Copy(landmarks, array("landmarks"), b);
  std::vector<float> weights = landmark_weights_;
  const std::vector<uint8_t> visible = database.visibility(row.image);
  for (size_t n = 0; n < weights.size(); ++n)
    if (visible[n] == 0) weights[n] *= float(options_.loss.hidden);
  Copy(weights, array("landmark_weights"), b);
  if (arrays_.picture) {
    Copy(ColourPlanes(crop), array("picture"), b);
    Copy(FaceMask(WarpPicture(database.mask(row.image), map, Sampling::kNearest)), array("skin"), b);
  }
  if (!row.known) return;
  array("known").values[size_t(b)] = 1;
  const auto copy_row = [&](const char* name, std::span<const float> numbers) {
    Copy({numbers.begin(), numbers.end()}, array(name), b);
  };
  copy_row("expression", database.expression(row.image));
  copy_row("albedo", database.albedo(row.image));
  copy_row("light", database.light(row.image));
  // Offsets of the picture in units in which its camera has the focal length of a crop's.
  const Eigen::Vector2d from = OffsetOf(in_picture, side) * (double(kPortraitSide) / side);
  const std::array<float, 3> angles =
      MovedAngles(database.pose(row.image), from, OffsetOf(landmarks, kPortraitSide), map.rotation());
  copy_row("angles", angles);
  if (arrays_.vertices) {
    const geometry::Points vertices = database.vertices(row.image);
    std::transform(vertices.data(), vertices.data() + vertices.size(), array("vertices").row(b),
                   [](double number) { return float(number); });
  }
}

}  // namespace daumier::portrait

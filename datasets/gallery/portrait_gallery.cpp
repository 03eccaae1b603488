#include "datasets/gallery/portrait_gallery.h"

#include "core/files.h"
#include "core/output_place.h"
#include "datasets/gallery/sketch_gallery.h"
#include "render/draw.h"
#include "render/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPortraitGalleryKind = "gallery";
const std::vector<std::string> kPortraitPictures = {"portraits.jpg", "portrait_truth.jpg"};
constexpr int kNumShown = 64, kInARow = 8, kCellSize = 160;

/// Of the classes of a mask.
constexpr std::array<render::Rgb, kNumPictureClasses> kClassColours = {{{30, 30, 34},
                                                                        {236, 188, 150},
                                                                        {110, 64, 26},
                                                                        {255, 255, 255},
                                                                        {214, 60, 84},
                                                                        {120, 10, 20},
                                                                        {250, 140, 20},
                                                                        {60, 96, 200}}};
constexpr render::Rgb kSeenColour = {40, 255, 60}, kHiddenColour = {150, 0, 0};

template <class Draw>
render::Image PortraitSheet(const PortraitDatabase& database, const Draw& draw) {
  std::vector<render::SheetCell> cells;
  for (int i = 0; i < std::min(kNumShown, database.size()); ++i)
    cells.push_back({render::Resize(draw(i), kCellSize, kCellSize), database.style(i)});
  return render::MakeSheet(cells, kInARow);
}

}  // namespace

render::Image PortraitTruth(const PortraitDatabase& database, int i) {
  constexpr int kMaskShare = 60;  // Percent.
  render::Image image = database.picture(i);
  const render::Image mask = database.mask(i);
  for (size_t pixel = 0; pixel < mask.pixels.size(); ++pixel) {
    const render::Rgb& colour = kClassColours[mask.pixels[pixel]];
    for (size_t c = 0; c < 3; ++c) {
      uint8_t& value = image.pixels[3 * pixel + c];
      value = static_cast<uint8_t>((value * (100 - kMaskShare) + colour[c] * kMaskShare) / 100);
    }
  }
  const std::vector<float> landmarks = database.landmarks(i);
  const std::vector<uint8_t> visibility = database.visibility(i);
  for (size_t l = 0; l < visibility.size(); ++l) {
    const int left = static_cast<int>(std::floor(landmarks[2 * l])),
              top = static_cast<int>(std::floor(landmarks[2 * l + 1]));
    render::FillRectangle(image, top - 1, left - 1, 2, 2, visibility[l] ? kSeenColour : kHiddenColour);
  }
  return image;
}

void CheckPortraitGalleryFolder(const fs::path& out, const std::vector<fs::path>& inputs) {
  CheckOutputFolder(out, {kPortraitGalleryKind}, inputs);
  CheckOwnFiles(out, kPortraitPictures);
}

void WritePortraitGallery(const PortraitDatabase& database, const fs::path& folder, const Task& task) {
  const std::vector<GalleryPicture> pictures = {
      {kPortraitPictures[0], [&] { return PortraitSheet(database, [&](int i) { return database.picture(i); }); }},
      {kPortraitPictures[1],
       [&] { return PortraitSheet(database, [&](int i) { return PortraitTruth(database, i); }); }}};
  Manifest manifest{.kind = kPortraitGalleryKind, .verb = "dataset gallery"};
  manifest.sources = database.manifest().sources;
  manifest.counts = {{"portraits", database.size()}};
  // Pictures of an earlier gallery of something else stay, and stay listed.
  if (fs::exists(folder / "manifest.json")) {
    for (const auto& [name, checksum] : ReadManifest(folder, kPortraitGalleryKind).checksums)
      if (fs::exists(folder / name)) manifest.checksums[name] = checksum;
  }
  for (const std::string& name : kPortraitPictures) manifest.checksums.erase(name);
  Manifest begun = manifest;
  begun.details[kUnfinishedFiles] = kPortraitPictures;
  WriteManifest(folder, begun);
  const auto num_pictures = int64_t(pictures.size());
  for (int64_t done = 0; done < num_pictures; ++done) {
    task.Report(done, num_pictures, "pictures");
    task.ThrowIfCancelled("stopped after {} of {} pictures in {}; the same command makes all of them", done,
                          num_pictures, folder.string());
    const GalleryPicture& picture = pictures[size_t(done)];
    render::WriteImage(folder / picture.name, picture.draw());
    manifest.checksums[picture.name] = Sha256OfFile(folder / picture.name);
  }
  WriteManifest(folder, manifest);
  task.Report(num_pictures, num_pictures, "pictures");
}

}  // namespace daumier::datasets

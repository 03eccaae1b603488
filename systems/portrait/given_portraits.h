#pragma once
#include "core/options.h"
#include "core/task.h"
#include "systems/portrait/landmark_detector.h"

#include <filesystem>
#include <string>
#include <vector>

/// A database of portraits from pictures of any origin: their faces are found, but not known.
namespace daumier::portrait {

struct GivenPortraitsOptions {
  std::string landmark_run = {};
  std::string licence = "unknown";
  double size = 0.5;
  double seen = 0.8;
  int quality = 95;
  LandmarkDetectorOptions detector{.least_confidence = 0.9};

  template <class V>
  void Visit(V&& visit) {
    visit("landmark_run", landmark_run, Text{},
          "Folder of a run that finds faces, landmarks and regions (daumier train, system landmarks).");
    visit("licence", licence, Text{}, "Licence of the pictures, copied to everything made of them.");
    visit("size", size, Range{0.2, 1}, "Longer side of the landmarks' box, as a share of the portrait.");
    visit("seen", seen, Range{0, 1}, "Least confidence of a landmark that counts as seen.");
    visit("quality", quality, Range{50, 100}, "JPEG quality of stored portraits.");
    visit("detector", detector, Table{}, "How faces are found, and how confident the run has to be of them.");
  }
};

/// Pictures in a folder and its sub-folders, relative to it, folder by folder in the order of their names. Files of the
/// system, and NAME_mask.png next to a picture NAME, are none.
/// @throws Error if it is no folder, or holds no picture.
std::vector<std::filesystem::path> PicturesBelow(const std::filesystem::path& folder);

struct DroppedPicture {
  std::string file;   ///< Relative to the folder of pictures.
  std::string cause;  ///< "no face", "a face of confidence 0.53, expected 0.90 or more", ...
};

/// What became of the pictures of a folder.
struct GivenPortraits {
  int num_pictures = 0, num_portraits = 0;
  std::vector<DroppedPicture> dropped = {};
};

/// pictures.json of a database that BuildGivenPortraits wrote. @throws Error if it is absent or malformed.
GivenPortraits ReadGivenPortraits(const std::filesystem::path& directory);

/// Writes a PortraitDatabase without known faces: a portrait of every face of a picture that the detector is confident
/// of, cropped so that the box of its landmarks has the same place in each (CropOfLandmarks). Next to a picture NAME, a
/// file NAME.pts, .txt or .json of 68 landmarks takes the place of the detector's, whatever its confidence, and
/// NAME_mask.png of classes that of the network's (ReadMask). A person is a sub-folder, or a picture that lies in none.
/// visibility: landmarks of a confidence of at least `seen` in the portrait. pictures.json lists the portraits of each
/// picture, or why it was dropped: unreadable, no face, not confident enough, bad landmarks or mask. A function of files,
/// network and options; resumes an interrupted build of the same.
/// @throws Error as PicturesBelow and BuildShards, and if all pictures are dropped, with the first causes: then nothing
/// is left.
GivenPortraits BuildGivenPortraits(const LandmarkDetector& detector, const Json& network,
                                   const std::filesystem::path& pictures, const GivenPortraitsOptions& options,
                                   const std::filesystem::path& directory, const Task& task = {});
/// The same with the network of options.landmark_run. @throws UsageError without one, Error as ReadLandmarkRunFolder and
/// LoadTrainingLibrary.
GivenPortraits BuildGivenPortraits(const std::filesystem::path& pictures, const GivenPortraitsOptions& options,
                                   const std::filesystem::path& directory, const Task& task = {});

}  // namespace daumier::portrait

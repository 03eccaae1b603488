#pragma once
#include "core/json.h"
#include "render/image.h"
#include "systems/portrait/landmark_detector.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daumier::portrait {

/// 68 landmarks of a picture from a file of any form that faces::OrderLandmarks orders, pixels: 68 x 2, NaN where the file
/// has none. @throws Error naming the file: as OrderLandmarks, or if a point has one number.
std::vector<float> ReadKnownLandmarks(const std::filesystem::path& file);
/// The same of a file that has all of them. @throws Error naming the file and the first that is absent.
std::vector<float> ReadLandmarks(const std::filesystem::path& file);
/// Whether landmarks (68 x 2) may be those of a picture. Returns a warning if some are outside of it, else nothing.
/// @throws Error naming the file, and the landmark if one is farther outside than the picture is large, or if the right eye
/// is on the left of the left one as in a mirrored picture.
std::string CheckLandmarks(const std::filesystem::path& file, std::span<const float> landmarks, int height, int width);
/// ReadLandmarks of the file of a picture NAME in a folder (LandmarkFileIn); absent if there is no such file.
std::optional<std::vector<float>> LandmarksInFolder(const std::filesystem::path& folder, const std::string& name);

/// The text of an iBUG .pts file; three decimals.
std::string LandmarksAsPts(std::span<const float> landmarks);

/// Classes of pixels from a grey picture of values 0 to 7 (PictureClass), of height x width. @throws Error naming the file if
/// it is no such picture.
render::Image ReadMask(const std::filesystem::path& file, int height, int width);

/// The classes of pixels by a file of any person's: values 0 to 7 as ReadMask, or black and white (0 and 255), where white
/// is the head: there `parsed` counts, background becomes skin; elsewhere is background. Grey, or RGB of equal channels; of
/// another size but the same shape, it is scaled to the nearest pixels. parsed: of that size, or absent.
/// @throws Error naming the file if it is neither.
render::Image ReadHeadMask(const std::filesystem::path& file, int height, int width,
                           const std::optional<render::Image>& parsed);

/// {box: [left, top, right, bottom], confidence, landmarks: [[x, y], ...], landmark_confidences, states: {is_face,
/// right_eye_closed, left_eye_closed, mouth_open}}, pixels rounded to 0.001.
Json DetectedFaceToJson(const DetectedFace& face);

}  // namespace daumier::portrait

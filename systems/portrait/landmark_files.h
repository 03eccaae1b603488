#pragma once
#include "core/json.h"
#include "render/image.h"
#include "systems/portrait/landmark_detector.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace daumier::portrait {

/// 68 landmarks of a picture from a file of any form that faces::ReadMarkedPoints reads (.pts, .txt, .json among them), pixels,
/// as stored: 68 x 2. @throws Error naming the file: as ReadMarkedPoints, another number of points, absent points.
std::vector<float> ReadLandmarks(const std::filesystem::path& file);

/// The text of an iBUG .pts file; three decimals.
std::string LandmarksAsPts(std::span<const float> landmarks);

/// Classes of pixels from a grey picture of values 0 to 7 (FaceClass), of height x width. @throws Error naming the file if
/// it is no such picture.
render::Image ReadMask(const std::filesystem::path& file, int height, int width);

/// {box: [left, top, right, bottom], confidence, landmarks: [[x, y], ...], landmark_confidences, states: {is_face,
/// right_eye_closed, left_eye_closed, mouth_open}}, pixels rounded to 0.001.
Json DetectedFaceToJson(const DetectedFace& face);

}  // namespace daumier::portrait

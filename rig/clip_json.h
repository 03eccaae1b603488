#pragma once
#include "rig/recording.h"

#include <string>
#include <string_view>

namespace daumier::rig {

/// Results of MediaPipe's FaceLandmarker as programs save them, from its JavaScript or Python interface: a list of
/// frames, an object that holds such a list (below "frames", "results", "data", "recording", "blendshapes",
/// "faceBlendshapes"), one frame, or a frame a line (JSON Lines). A frame is one of
/// - {"faceBlendshapes": [{"categories": [{"categoryName", "score"}, ...]}, ...]}, of which the first face is read;
/// - {"categories": [...]}, or the list of categories alone;
/// - {NAME: SCORE, ...}, also below "blendshapes", "weights" or "scores";
/// keys in camelCase or snake_case. It may have a time: "timestamp", "timestampMs", "time", "t", ... in seconds,
/// milliseconds or microseconds; or the list has "timestamps" or "fps" next to it; otherwise 30 frames a second. A
/// "facialTransformationMatrixes" with {"data": 16 numbers}, column by column, or 4 x 4 rows, turns the head. A frame
/// without a face is skipped.
/// @throws Error naming the file and the frame: not JSON, nothing that is a frame, a score that is no number.
Recording ParseClipJson(std::string_view text, const std::string& name);

}  // namespace daumier::rig

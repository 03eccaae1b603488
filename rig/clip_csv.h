#pragma once
#include "rig/recording.h"

#include <string>
#include <string_view>

namespace daumier::rig {

/// A table with a row a frame and a header that names the columns, in any order:
/// - weights, by every spelling of FindArkitName, also behind a dot ("blendShapes.JawOpen");
/// - a time in seconds, milliseconds or microseconds, or a timecode HH:MM:SS:FF.mmm, whose frames a second follow from
///   the largest FF; without one, 60 frames a second;
/// - HeadYaw, HeadPitch, HeadRoll, and these of LeftEye and RightEye, as the app Live Link Face writes them: pitch > 0
///   downwards, yaw > 0 to the head's own right.
/// Rows whose BlendShapeCount is 0, or whose weights are all empty, have no face and are skipped.
/// @throws Error naming file and line: no target among the columns, two columns of one target, a row of another number
/// of cells, a cell that is no number, or times that do not ascend.
Recording ParseClipCsv(std::string_view text, const std::string& name);

}  // namespace daumier::rig

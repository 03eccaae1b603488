#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace daumier::rig {

/// The port to which the app Live Link Face sends unless its user changes it.
inline constexpr int kLiveLinkPort = 11111;

/// A UDP packet of the app Live Link Face in its mode "Live Link (ARKit)", version 6; numbers are big endian:
///
///   uint8 version = 6
///   int32 n, n bytes of UTF-8: the device
///   int32 n, n bytes of UTF-8: the subject
///   int32 frame, float32 part of a frame, int32 rate numerator, int32 rate denominator
///   uint8 count = 61
///   61 float32: the weights of ArkitNames(), then yaw, pitch and roll of the head, the left and the right eye
///
/// Without a face a packet ends behind the subject. The rotations are not kept: gaze is among the weights.
struct LiveLinkPacket {
  std::string device, subject;
  /// Absent while the tracker sees no face.
  struct Frame {
    int32_t number = 0;
    float part = 0;             ///< Of a frame, 0 to 1.
    double rate = 0;            ///< Frames a second.
    Eigen::VectorXf weights{};  ///< 52, 0 to 1: what is beyond is clamped.
  };
  std::optional<Frame> frame;
};

/// @throws Error naming what is wrong: another version, a text longer than 1024 bytes or than the packet, another count, a
/// rate that is not positive, a number that is not finite, or bytes that are missing or left over.
LiveLinkPacket ParseLiveLinkPacket(std::string_view bytes);

}  // namespace daumier::rig

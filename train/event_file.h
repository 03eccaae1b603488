#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace daumier::train {

/// One number of a TensorBoard event file.
struct ScalarEvent {
  double wall_time = 0;  ///< Seconds since 1970.
  int64_t step = 0;
  std::string tag;
  float value = 0;
};

/// Appends to a TensorBoard event file. A record is: length (u64), masked crc32c of the length (u32), an Event message,
/// masked crc32c of the message (u32), little-endian; the message is protobuf: wall_time = 1 (double), step = 2
/// (int64), file_version = 3 (string, first record only), summary = 5 { value = 1 { tag = 1, simple_value = 2 (float) }
/// }.
class EventWriter {
 public:
  /// Starts the file if it is missing or empty. TensorBoard requires "tfevents" in the name. @throws Error if it cannot
  /// be written.
  explicit EventWriter(const std::filesystem::path& file);
  /// Written through at once, so that TensorBoard can display a running training.
  void Write(const ScalarEvent& event);

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

/// The events up to the first truncated or damaged record, where a killed writer stopped.
/// @throws Error if the file cannot be read or is no event file.
std::vector<ScalarEvent> ReadEvents(const std::filesystem::path& file);

}  // namespace daumier::train

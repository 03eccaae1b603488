#include "datasets/build/portrait_shard.h"

#include "core/error.h"
#include "core/safetensors.h"

#include <cmath>

namespace daumier::datasets {
namespace {

constexpr double kStepsPerCm = 1000;

void AddFiles(SafetensorsWriter& writer, const std::vector<PortraitRecord>& records, std::string PortraitRecord::*file,
              const std::string& bytes_name, const std::string& offsets_name) {
  std::vector<uint8_t> bytes;
  std::vector<int64_t> offsets = {0};
  for (const PortraitRecord& record : records) {
    const std::string& content = record.*file;
    bytes.insert(bytes.end(), content.begin(), content.end());
    offsets.push_back(static_cast<int64_t>(bytes.size()));
  }
  writer.Add<uint8_t>(bytes_name, {static_cast<int64_t>(bytes.size())}, bytes);
  writer.Add<int64_t>(offsets_name, {static_cast<int64_t>(offsets.size())}, offsets);
}

/// `row`: the shape of an image's part, behind the number of images.
template <class T, size_t N>
void AddRows(SafetensorsWriter& writer, const std::vector<PortraitRecord>& records, const std::string& name,
             std::array<T, N> PortraitRecord::*field, std::vector<int64_t> row) {
  std::vector<T> values;
  for (const PortraitRecord& record : records)
    values.insert(values.end(), (record.*field).begin(), (record.*field).end());
  row.insert(row.begin(), static_cast<int64_t>(records.size()));
  writer.Add<T>(name, row, values);
}

void AddNumbers(SafetensorsWriter& writer, const std::vector<PortraitRecord>& records, const std::string& name,
                int PortraitRecord::*field) {
  std::vector<int32_t> values;
  for (const PortraitRecord& record : records) values.push_back(record.*field);
  writer.Add<int32_t>(name, {static_cast<int64_t>(values.size())}, values);
}

void AddVertices(SafetensorsWriter& writer, const std::vector<PortraitRecord>& records) {
  const Eigen::Index num_vertices = records.front().vertices.rows();
  std::vector<uint8_t> bytes;
  bytes.reserve(records.size() * size_t(num_vertices) * 6);
  for (const PortraitRecord& record : records) {
    DAUMIER_CHECK(record.vertices.rows() == num_vertices, "portraits of {} and of {} vertices in one shard",
                  num_vertices, record.vertices.rows());
    for (const double coordinate : record.vertices.reshaped<Eigen::RowMajor>()) {
      const double steps = std::round(coordinate * kStepsPerCm);
      DAUMIER_CHECK(std::abs(steps) <= 32767, "a vertex at {} cm, portraits keep those within 32.767 cm", coordinate);
      const auto value = static_cast<uint16_t>(static_cast<int16_t>(steps));
      bytes.push_back(static_cast<uint8_t>(value & 0xff));
      bytes.push_back(static_cast<uint8_t>(value >> 8));
    }
  }
  if (num_vertices > 0)
    writer.Add<uint8_t>("vertices", {static_cast<int64_t>(records.size()), num_vertices, 3, 2}, bytes);
}

}  // namespace

std::string WritePortraitShard(const std::filesystem::path& file, const std::vector<PortraitRecord>& records,
                               const std::map<std::string, std::string>& metadata) {
  DAUMIER_CHECK(!records.empty(), "{}: a shard without portraits", file.string());
  SafetensorsWriter writer;
  for (const auto& [key, value] : metadata) writer.SetMetadata(key, value);
  writer.SetMetadata("kind", "portraits");
  AddFiles(writer, records, &PortraitRecord::picture, "pictures", "picture_offsets");
  AddFiles(writer, records, &PortraitRecord::mask, "masks", "mask_offsets");
  AddRows(writer, records, "landmarks", &PortraitRecord::landmarks, {PortraitSizes::kLandmarks, 2});
  AddRows(writer, records, "visibility", &PortraitRecord::visibility, {PortraitSizes::kLandmarks});
  AddRows(writer, records, "states", &PortraitRecord::states, {3});
  AddRows(writer, records, "expression", &PortraitRecord::expression, {PortraitSizes::kExpression});
  AddRows(writer, records, "albedo", &PortraitRecord::albedo, {PortraitSizes::kAlbedo});
  AddRows(writer, records, "light", &PortraitRecord::light, {PortraitSizes::kLight});
  AddRows(writer, records, "pose", &PortraitRecord::pose, {PortraitSizes::kPose});
  AddNumbers(writer, records, "faces", &PortraitRecord::face);
  AddNumbers(writer, records, "persons", &PortraitRecord::person);
  AddNumbers(writer, records, "styles", &PortraitRecord::style);
  AddNumbers(writer, records, "skin_tones", &PortraitRecord::skin_tone);
  std::vector<uint8_t> bald;
  for (const PortraitRecord& record : records) bald.push_back(record.is_bald);
  writer.Add<uint8_t>("bald", {static_cast<int64_t>(bald.size())}, bald);
  std::vector<float> eye_sizes;
  for (const PortraitRecord& record : records) eye_sizes.push_back(record.eye_size);
  writer.Add<float>("eye_sizes", {static_cast<int64_t>(eye_sizes.size())}, eye_sizes);
  AddVertices(writer, records);
  return writer.Write(file);
}

}  // namespace daumier::datasets

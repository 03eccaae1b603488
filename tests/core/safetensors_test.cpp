#include "core/safetensors.h"

#include "core/error.h"
#include "core/random.h"
#include "tests/support/corruption.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <optional>

namespace daumier {
namespace {

using ::testing::HasSubstr;
using testing::TempDir;

template <class T>
void Add(SafetensorsWriter& writer, const std::string& name, std::vector<int64_t> shape, const std::vector<T>& values) {
  writer.Add<T>(name, std::move(shape), std::span<const T>(values));
}

SafetensorsWriter ExampleWriter() {
  SafetensorsWriter writer;
  Add<uint8_t>(writer, "bytes", {3}, {1, 2, 255});
  Add<float>(writer, "floats", {2, 3}, {1, 2, 3, 4, 5, 6.5f});
  Add<double>(writer, "doubles", {1}, {0.1});
  Add<int32_t>(writer, "ints", {2, 1}, {-7, 8});
  Add<int64_t>(writer, "longs", {}, {int64_t{1} << 40});
  Add<int8_t>(writer, "small", {2}, {-128, 127});
  Add<int16_t>(writer, "short", {2}, {-32768, 32767});
  Add<Half>(writer, "halves", {2}, {HalfFromFloat(1.5f), HalfFromFloat(-65504)});
  Add<float>(writer, "nothing", {0, 3}, {});
  writer.SetMetadata("kind", "example");
  return writer;
}

/// A file with this header, padded to a multiple of 8, and a given number of bytes of data.
void WriteRaw(const std::filesystem::path& path, std::string header, size_t num_data_bytes) {
  header.append((8 - header.size() % 8) % 8, ' ');
  const uint64_t size = header.size();
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &size, 8);
  WriteFileAtomically(path, bytes + header + std::string(num_data_bytes, '\1'));
}

std::string OpenFailure(const std::filesystem::path& path) {
  try {
    SafetensorsFile file(path);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.string()));
    return error.what();
  }
  return "no error";
}

TEST(Safetensors, ReadUndoesWrite) {
  const TempDir dir;
  ExampleWriter().Write(dir / "a");
  const SafetensorsFile file(dir / "a");
  EXPECT_EQ(file.arrays().size(), 9u);
  EXPECT_THAT(file.at("bytes").As<uint8_t>(), ::testing::ElementsAre(1, 2, 255));
  EXPECT_THAT(file.at("floats").As<float>(), ::testing::ElementsAre(1, 2, 3, 4, 5, 6.5f));
  EXPECT_EQ(file.at("floats").shape, (std::vector<int64_t>{2, 3}));
  EXPECT_THAT(file.at("doubles").As<double>(), ::testing::ElementsAre(0.1));
  EXPECT_THAT(file.at("ints").As<int32_t>(), ::testing::ElementsAre(-7, 8));
  EXPECT_THAT(file.at("longs").As<int64_t>(), ::testing::ElementsAre(int64_t{1} << 40));
  EXPECT_TRUE(file.at("longs").shape.empty());
  EXPECT_THAT(file.at("small").As<int8_t>(), ::testing::ElementsAre(-128, 127));
  EXPECT_THAT(file.at("short").As<int16_t>(), ::testing::ElementsAre(-32768, 32767));
  EXPECT_EQ(FloatFromHalf(file.at("halves").As<Half>()[1]), -65504);
  EXPECT_TRUE(file.at("nothing").As<float>().empty());
  EXPECT_EQ(file.metadata().at("kind"), "example");
  EXPECT_EQ(file.metadata().at("format_version"), "1");
}

TEST(Safetensors, AnEmptyFileHoldsNoArrays) {
  const TempDir dir;
  SafetensorsWriter().Write(dir / "a");
  EXPECT_TRUE(SafetensorsFile(dir / "a").arrays().empty());
}

TEST(Safetensors, BytesAreThoseOfTheFormat) {
  const TempDir dir;
  SafetensorsWriter writer;
  Add<float>(writer, "x", {1}, {1.0f});
  writer.Write(dir / "a");
  const std::string bytes = ReadFile(dir / "a");
  const std::string header =
      R"({"__metadata__":{"format_version":"1"},"x":{"dtype":"F32","shape":[1],"data_offsets":[0,4]}})";
  EXPECT_EQ(bytes.substr(8, header.size()), header);
  EXPECT_EQ(static_cast<unsigned char>(bytes[0]),
            120);  // 128 bytes are the least multiple of 64 that holds the header.
  EXPECT_EQ(bytes.substr(128), std::string("\0\0\x80\x3f", 4));
  EXPECT_EQ(bytes.substr(8 + header.size(), 120 - header.size()), std::string(120 - header.size(), ' '));
}

TEST(Safetensors, ArraysLieWithoutHolesFromAMultipleOf64AndAligned) {
  const TempDir dir;
  ExampleWriter().Write(dir / "a");
  const SafetensorsFile file(dir / "a");
  const std::string bytes = ReadFile(dir / "a");
  size_t num_bytes = 0;
  const char* first = nullptr;
  for (const auto& [name, array] : file.arrays()) {
    const auto address = reinterpret_cast<uintptr_t>(array.data);
    EXPECT_EQ(address % ItemSize(array.dtype), 0u) << name;
    num_bytes += static_cast<size_t>(array.size()) * ItemSize(array.dtype);
    const auto* const data = static_cast<const char*>(array.data);
    if (first == nullptr || data < first) first = data;
  }
  EXPECT_EQ(reinterpret_cast<uintptr_t>(first) % 64, 0u);
  EXPECT_EQ((bytes.size() - num_bytes) % 64, 0u);
}

TEST(Safetensors, EqualContentGivesEqualBytesWhateverTheOrder) {
  const TempDir dir;
  SafetensorsWriter forward, backward;
  Add<float>(forward, "a", {1}, {1});
  Add<float>(forward, "b", {1}, {2});
  forward.SetMetadata("p", "1");
  forward.SetMetadata("q", "2");
  backward.SetMetadata("q", "2");
  backward.SetMetadata("p", "1");
  Add<float>(backward, "b", {1}, {2});
  Add<float>(backward, "a", {1}, {1});
  EXPECT_EQ(forward.Write(dir / "f"), backward.Write(dir / "b"));
  EXPECT_EQ(ReadFile(dir / "f"), ReadFile(dir / "b"));
}

TEST(Safetensors, WriteReturnsTheSha256OfTheFile) {
  const TempDir dir;
  const std::string checksum = ExampleWriter().Write(dir / "a");
  EXPECT_EQ(checksum, Sha256OfFile(dir / "a"));
}

TEST(Safetensors, CopiesShareTheMapping) {
  const TempDir dir;
  ExampleWriter().Write(dir / "a");
  std::optional<SafetensorsFile> file(std::in_place, dir / "a");
  const SafetensorsFile copy = *file;
  const void* const data = file->at("floats").data;
  file.reset();
  EXPECT_EQ(copy.at("floats").data, data);
  EXPECT_EQ(copy.at("floats").As<float>()[5], 6.5f);
}

TEST(Safetensors, AbsentArrayNamesThoseThatAreThere) {
  const TempDir dir;
  SafetensorsWriter writer;
  Add<float>(writer, "a", {1}, {1});
  Add<float>(writer, "b", {1}, {1});
  writer.Write(dir / "f");
  const SafetensorsFile file(dir / "f");
  EXPECT_FALSE(file.contains("c"));
  EXPECT_TRUE(file.contains("a"));
  try {
    file.at("c");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), (dir / "f").string() + " has no array 'c'; it has: a, b");
  }
}

TEST(Safetensors, AnotherElementTypeIsRefused) {
  const TempDir dir;
  ExampleWriter().Write(dir / "a");
  EXPECT_THROW(SafetensorsFile(dir / "a").at("floats").As<double>(), Error);
}

TEST(Safetensors, WriterRefusesWhatDoesNotFit) {
  SafetensorsWriter writer;
  Add<float>(writer, "a", {2}, {1, 2});
  EXPECT_THROW(Add<float>(writer, "a", {2}, {1, 2}), Error);
  EXPECT_THROW(Add<float>(writer, "b", {3}, {1, 2}), Error);
  EXPECT_THROW(Add<float>(writer, "c", {-1, -2}, {1, 2}), Error);
  EXPECT_THROW(Add<float>(writer, "__metadata__", {2}, {1, 2}), Error);
}

TEST(Safetensors, MissingFileIsNamed) {
  const TempDir dir;
  EXPECT_THAT(OpenFailure(dir / "absent"), HasSubstr("No such file"));
}

TEST(Safetensors, EveryTruncationIsRefused) {
  const TempDir dir;
  ExampleWriter().Write(dir / "a");
  const std::string bytes = ReadFile(dir / "a");
  const int num_refused = testing::CountRefusedTruncations(dir / "a", bytes, [&] { SafetensorsFile{dir / "a"}; });
  EXPECT_EQ(num_refused, static_cast<int>(bytes.size()));
}

TEST(Safetensors, SurvivesFlippedBytes) {
  const TempDir dir;
  ExampleWriter().Write(dir / "a");
  Rng rng(1);
  const int num_refused = testing::CountRefusedFlips(dir / "a", ReadFile(dir / "a"), 300, rng, [&] {
    const SafetensorsFile file(dir / "a");
    for (const auto& [name, array] : file.arrays()) {  // What is accepted lies inside of the file.
      Sha256({static_cast<const char*>(array.data), static_cast<size_t>(array.size()) * ItemSize(array.dtype)});
    }
  });
  EXPECT_GT(num_refused, 100);  // The others hit a name, a value of an array, or the padding.
}

TEST(Safetensors, CorruptHeadersAreRefused) {
  const TempDir dir;
  const auto failure = [&](const std::string& header, size_t num_data_bytes) {
    WriteRaw(dir / "a", header, num_data_bytes);
    return OpenFailure(dir / "a");
  };
  EXPECT_EQ(failure(R"({"x": {"dtype": "F32", "shape": [2], "data_offsets": [0, 8]}})", 8), "no error");
  EXPECT_THAT(failure("[]", 0), HasSubstr("malformed header"));
  EXPECT_THAT(failure("{", 0), HasSubstr("malformed header"));
  EXPECT_THAT(failure(R"({"x": 3})", 0), HasSubstr("array 'x': malformed entry"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F9", "shape": [2], "data_offsets": [0, 8]}})", 8),
              HasSubstr("unknown dtype 'F9'"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F32", "shape": [3], "data_offsets": [0, 8]}})", 8),
              HasSubstr("its shape needs 12"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F32", "shape": [-2], "data_offsets": [0, 8]}})", 8), HasSubstr("no size"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F32", "shape": [4611686018427387905, 4], "data_offsets": [0, 16]}})", 16),
              HasSubstr("impossible shape"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F32", "shape": [3], "data_offsets": [0, 12]}})", 8), HasSubstr("outside"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F32", "shape": [2], "data_offsets": [8, 0]}})", 8), HasSubstr("outside"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F32", "shape": [1], "data_offsets": [0, 4]}})", 8),
              HasSubstr("after the last"));
  EXPECT_THAT(failure(R"({"x": {"dtype": "F32", "shape": [1], "data_offsets": [4, 8]}})", 8), HasSubstr("unused"));
  EXPECT_THAT(failure(R"({"__metadata__": {"a": 3}})", 0), HasSubstr("metadata 'a' is no text"));
}

TEST(Safetensors, OverlappingArraysAreRefused) {
  const TempDir dir;
  WriteRaw(dir / "a",
           R"({"x": {"dtype": "U8", "shape": [4], "data_offsets": [0, 4]},)"
           R"( "y": {"dtype": "U8", "shape": [4], "data_offsets": [2, 6]}})",
           6);
  EXPECT_THAT(OpenFailure(dir / "a"), HasSubstr("array 'y' overlaps another"));
}

TEST(Safetensors, UnalignedArraysAreRefused) {
  const TempDir dir;
  WriteRaw(dir / "a",
           R"({"x": {"dtype": "U8", "shape": [1], "data_offsets": [0, 1]},)"
           R"( "y": {"dtype": "F32", "shape": [1], "data_offsets": [1, 5]}})",
           5);
  EXPECT_THAT(OpenFailure(dir / "a"), HasSubstr("array 'y': not aligned"));
}

TEST(Safetensors, UnsupportedVersionIsRefused) {
  const TempDir dir;
  SafetensorsWriter writer;
  writer.SetMetadata("format_version", "2");
  writer.Write(dir / "a");
  EXPECT_THAT(OpenFailure(dir / "a"), HasSubstr("format_version is '2', this program reads 1; a newer one"));
}

TEST(Safetensors, FilesOfOtherProgramsNeedNoVersion) {
  const TempDir dir;
  WriteRaw(dir / "a", R"({"x": {"dtype": "F32", "shape": [1], "data_offsets": [0, 4]}})", 4);
  EXPECT_TRUE(SafetensorsFile(dir / "a").metadata().empty());
}

}  // namespace
}  // namespace daumier

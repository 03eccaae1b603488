#include "faces/import/torch_file.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/support/temp_dir.h"
#include "tests/support/torch_checkpoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::faces {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::PickleText;
using testing::TempDir;
using testing::WriteQuickly;

/// Files of PyTorch itself, by tests/fuzz/make_torch_files.py.
fs::path ByPyTorch(const char* name) {
  return testing::SourceRoot() / "tests/fuzz/seeds/torch" / name;
}

/// A file with a pickle of {"a": tensor} and the storage "0".
void WriteTorchTensor(const fs::path& path, const std::string& tensor, const std::string& storage) {
  WriteQuickly(path, testing::ZipOf({{"x/data.pkl", PickleText::File("}" + PickleText::Text("a") + tensor + "s")},
                                     {"x/data/0", storage},
                                     {"x/byteorder", "little"}}));
}

std::string FloatBytes(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

TEST(ReadTorchState, FilesOfPyTorchInBothFormats) {
  for (const char* name : {"zip.pth", "older.pth"}) {
    EXPECT_TRUE(IsTorchFile(ByPyTorch(name)));
    const NamedArrays state = ReadTorchState(ByPyTorch(name));
    ASSERT_EQ(state.size(), 13u) << name;
    const auto values = [&](const char* tensor) { return state.at(tensor).values; };
    using Values = std::vector<float>;
    EXPECT_EQ(state.at("plain").shape, (std::vector<int64_t>{3, 4}));
    EXPECT_EQ(values("plain")[9], 9.0f / 8);
    EXPECT_EQ(state.at("transposed").shape, (std::vector<int64_t>{4, 3}));
    EXPECT_EQ(values("transposed"), (Values{0, 4, 8, 1, 5, 9, 2, 6, 10, 3, 7, 11}));
    EXPECT_EQ(values("part"), (Values{5, 6, 9, 10}));
    EXPECT_EQ(values("repeated"), Values(6, 0.5f));
    EXPECT_EQ(values("parameter"), (Values{1.5f, -2.5f}));
    EXPECT_EQ(values("float16"), (Values{0.25f, -65504.0f}));
    EXPECT_EQ(values("bfloat16"), (Values{0.5f, -3.0f}));
    EXPECT_EQ(values("float64"), (Values{0.1f, HUGE_VALF}));
    EXPECT_EQ(values("int64"), Values{7});
    EXPECT_TRUE(state.at("int64").shape.empty());
    EXPECT_EQ(values("int32"), Values{-7});
    EXPECT_EQ(values("uint8"), Values{255});
    EXPECT_EQ(values("bool"), (Values{1, 0}));
    EXPECT_TRUE(values("empty").empty());
  }
  EXPECT_EQ(ReadTorchState(ByPyTorch("protocol4.pth")).at("a").values[11], 11);
}

TEST(ReadTorchState, WritingUndoesReadingAlsoWithSizesOf64Bits) {
  const TempDir folder;
  const NamedArrays state = {{"a.weight", {{2, 3}, {1, 2, 3, 4, 5, 6}}}, {"b", {{1}, {-1}}}};
  for (const testing::ZipSizes sizes : {testing::ZipSizes::k32, testing::ZipSizes::k64}) {
    testing::WriteTorchState(folder / "state.pth", state, sizes);
    const NamedArrays read = ReadTorchState(folder / "state.pth");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read.at("a.weight").shape, state.at("a.weight").shape);
    EXPECT_EQ(read.at("a.weight").values, state.at("a.weight").values);
  }
}

TEST(ReadTorchState, ChoosesTheStateAmongDictionaries) {
  const TempDir folder;
  const std::string tensor = PickleText::Tensor("FloatStorage", "0", 1, 0, {1}, {1});
  const auto dictionary = [&](const std::string& key, const std::string& value) {
    return "}" + PickleText::Text(key) + value + "s";
  };
  const auto read = [&](const std::string& value) {
    WriteQuickly(folder / "a.pth",
                 testing::ZipOf({{"a/data.pkl", PickleText::File(value)}, {"a/data/0", FloatBytes({4})}}));
    return ReadTorchState(folder / "a.pth");
  };
  const auto two = [&](const std::string& first, const std::string& second) {
    return "}(" + PickleText::Text(first) + dictionary("x", tensor) + PickleText::Text(second) +
           dictionary("y", tensor) + "u";
  };
  EXPECT_TRUE(read(two("ema", "model")).contains("y"));
  EXPECT_TRUE(read(two("state_dict", "other")).contains("x"));
  EXPECT_TRUE(read(dictionary("weights", dictionary("module.x", tensor))).contains("x"));
  EXPECT_TRUE(
      read("}(" + PickleText::Text("module.x") + tensor + PickleText::Text("y") + tensor + "u").contains("module.x"))
      << "not all names have it";
  ExpectError([&] { read(two("first", "second")); }, "several dictionaries of tensors: first, second");
  ExpectError([&] { read(dictionary("epoch", "K\x01")); }, "there are no tensors by name");
  ExpectError([&] { read("K\x01"); }, "there are no tensors by name");
}

TEST(ReadTorchState, RefusesTensorsOutsideOfTheirStorage) {
  const TempDir folder;
  const auto refused = [&](const std::vector<int64_t>& shape, const std::vector<int64_t>& strides, int64_t offset,
                           int64_t size, const std::string& part) {
    WriteTorchTensor(folder / "a.pth", PickleText::Tensor("FloatStorage", "0", size, offset, shape, strides),
                     FloatBytes({1, 2, 3, 4, 5, 6}));
    ExpectError([&] { ReadTorchState(folder / "a.pth"); }, part);
  };
  refused({2, 3}, {3, 1}, 1, 6, "'a' of shape (2, 3) lies outside of its storage of 6 elements");
  refused({2}, {6}, 0, 6, "lies outside");
  refused({2}, {-1}, 3, 6, "lies outside");
  refused({-2}, {1}, 0, 6, "lies outside");
  refused({2, 3}, {1}, 0, 6, "lies outside");
  refused({2}, {1}, -1, 6, "lies outside");
  refused({1 << 30, 1 << 30, 1 << 30}, {0, 0, 0}, 0, 6, "lies outside");
  refused({1 << 30}, {0}, 0, 6, "more elements than the file has bytes");
  refused({7}, {1}, 0, 7, "the storage of 'a' has 24 bytes, expected 28");
  refused({5}, {1}, 0, 5, "the storage of 'a' has 24 bytes, expected 20");
}

TEST(ReadTorchState, NamesWhatIsNoState) {
  const TempDir folder;
  const auto refused = [&](const std::string& bytes, const std::string& part) {
    WriteQuickly(folder / "a.pth", bytes);
    ExpectError([&] { ReadTorchState(folder / "a.pth"); }, part);
  };
  const std::string module = PickleText::File(PickleText::Name("modules", "DeformNet") + ")\x81}b");
  refused(testing::ZipOf({{"a/data.pkl", module}}), "the pickle names 'modules.DeformNet'");
  refused(testing::ZipOf({{"a/data.pkl", module}}), "torch.save(dict(state), \"state.pth\")");
  refused(testing::ZipOf({{"a/data.pkl", module}, {"a/constants.pkl", ""}}), "this is TorchScript");
  refused(testing::ZipOf({{"a/other", "x"}}), "there is no data.pkl");
  refused(testing::ZipOf({{"a/byteorder", "big"}, {"a/data.pkl", module}}), "big-endian");
  refused(module, "this is no file of PyTorch");
  refused("", "this is no file of PyTorch");
  ExpectError([&] { ReadTorchState(folder / "absent.pth"); }, "absent.pth: there is no such file");
  WriteQuickly(folder / "b.pth",
               testing::ZipOf(
                   {{"b/data.pkl", PickleText::File("}" + PickleText::Text("a") +
                                                    PickleText::Tensor("FloatStorage", "0", 1, 0, {1}, {1}) + "s")}}));
  ExpectError([&] { ReadTorchState(folder / "b.pth"); }, "there are no elements of 'a'");
}

TEST(ReadTorchState, DamagedFilesGiveErrors) {
  const TempDir folder;
  for (const char* name : {"zip.pth", "older.pth"}) {
    const std::string bytes = ReadFile(ByPyTorch(name));
    Rng rng(7);
    const fs::path path = folder / name;
    const auto read = [&] { ReadTorchState(path); };
    EXPECT_GT(testing::CountRefusedFlips(path, bytes, 200, rng, read), 50) << name;
    WriteQuickly(path, std::string_view(bytes).substr(0, bytes.size() / 2));
    ExpectError(read, "truncated");
    // An archive without its directory at the end is read entry by entry.
    const size_t end = std::min(bytes.size(), bytes.find("PK\x01\x02"));
    EXPECT_GE(testing::CountRefusedTruncations(path, bytes, read), int(end)) << name;
  }
}

}  // namespace
}  // namespace daumier::faces

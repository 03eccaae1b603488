#include "faces/import/mat_file.h"

#include "core/files.h"
#include "tests/faces/import/foreign_files.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::BytesOf;
using testing::ExpectError;
using testing::MatCompressed;
using testing::MatFile;
using testing::MatVariable;

class MatFileTest : public ::testing::Test {
 protected:
  NumberArrays Read(const std::string& bytes, const std::set<std::string>& wanted) {
    testing::WriteQuickly(path_, bytes);
    return ReadMatFile(path_, wanted);
  }
  void ExpectRefused(const std::string& bytes, const std::string& part) {
    ExpectError([&] { Read(bytes, {"a"}); }, part);
  }

  testing::TempDir folder_;
  std::filesystem::path path_ = folder_ / "m.mat";
};

/// [[0, 1, 2], [3, 4, 5]] column by column.
const std::vector<float> kSixByColumns = {0, 3, 1, 4, 2, 5};

TEST_F(MatFileTest, PlainAndCompressedVariablesAreRead) {
  const std::string variable = MatVariable("shapePC", {2, 3}, 7, BytesOf(kSixByColumns), 7);
  for (const std::string& bytes : {MatFile(variable), MatFile(MatCompressed(variable))}) {
    const NumberArrays arrays = Read(bytes, {"shapePC"});
    ASSERT_EQ(arrays.size(), 1u);
    EXPECT_EQ(arrays.at("shapePC").shape(), (std::vector<int64_t>{2, 3}));
    for (int k = 0; k < 6; ++k) EXPECT_EQ(arrays.at("shapePC")[k], k);
  }
}

TEST_F(MatFileTest, SmallElementsAndPackedTypesAreRead) {
  // A name of two bytes and doubles that MATLAB stores as two bytes lie inside their tags.
  const NumberArrays arrays = Read(MatFile(MatVariable("tl", {1, 2}, 2, BytesOf<uint8_t>({7, 9}))), {"tl"});
  EXPECT_EQ(arrays.at("tl")[0], 7);
  EXPECT_EQ(arrays.at("tl")[1], 9);
}

TEST_F(MatFileTest, OtherVariablesAreSkipped) {
  const std::string text = MatVariable("text", {1, 2}, 4, BytesOf<uint16_t>({'h', 'i'}), 4);
  const std::string six = MatVariable("six", {2, 3}, 7, BytesOf(kSixByColumns), 7);
  EXPECT_EQ(Read(MatFile(text + MatCompressed(text) + six), {"six"}).at("six")[5], 5);
  ExpectError([&] { Read(MatFile(text), {"text"}); }, "m.mat: text is no real, full matrix of numbers");
}

TEST_F(MatFileTest, AMissingVariableIsNamedWithThoseThatThereAre) {
  const std::string six = MatVariable("faces", {2, 3}, 7, BytesOf(kSixByColumns), 7);
  const std::string bytes = MatFile(six + MatCompressed(MatVariable("w_shape", {2, 3}, 7, BytesOf(kSixByColumns), 7)));
  ExpectError(
      [&] {
        Read(bytes, {"tl", "shapeMU"});
      },
      "m.mat: has no variable shapeMU (found the variables faces, w_shape; expected shapeMU, tl)");
  ExpectRefused(MatFile(""), "found the variables none");
  std::string many;
  for (int i = 10; i < 50; ++i) many += MatVariable(fmt::format("v\n{}", i), {2, 3}, 7, BytesOf(kSixByColumns), 7);
  ExpectRefused(MatFile(many), "v?28, v?29, 20 more;");
}

// HDF5 behind 512 bytes of a header of text, as MATLAB's -v7.3 writes it.
TEST_F(MatFileTest, OfVersion73TheVariablesAreNamed) {
  {
    testing::Hdf5Writer writer(path_);
    writer.Add("shapeMU", {3}, std::vector<float>{1, 2, 3});
    writer.Add("other", {1}, std::vector<int>{1});
  }
  std::string header = "MATLAB 7.3 MAT-file, Platform: GLNXA64";
  header.resize(512, ' ');
  const std::string hdf5 = ReadFile(path_);
  ExpectRefused(header + hdf5,
                "found HDF5 with the variables other, shapeMU; expected version 5 with a). Save it again "
                "in MATLAB with -v7");
  ExpectRefused(header + hdf5.substr(0, 100), "damaged MATLAB 7.3 file");
}

TEST_F(MatFileTest, WrongFilesAndKindsAreRefused) {
  ExpectRefused("no MATLAB file at all", "is no MATLAB 5 file");
  ExpectRefused("MATLAB 5.0 MAT-file, Pla", "truncated: 24 bytes");
  std::string big = MatFile("");
  std::swap(big[126], big[127]);
  ExpectRefused(big, "big-endian");
  constexpr uint32_t kComplex = 0x806, kSparse = 5, kCell = 1;
  for (const uint32_t kind : {kComplex, kSparse, kCell})
    ExpectRefused(MatFile(MatVariable("a", {2, 3}, 7, BytesOf(kSixByColumns), kind)), "no real, full matrix");
}

TEST_F(MatFileTest, HostileSizesAreRefused) {
  ExpectRefused(MatFile(MatVariable("a", {2, 4}, 7, BytesOf(kSixByColumns), 7)), "24 bytes, its shape (2, 4) needs 32");
  ExpectRefused(MatFile(MatVariable("a", {-2, -3}, 7, BytesOf(kSixByColumns), 7)), "impossible shape");
  ExpectRefused(MatFile(MatVariable("a", {2147483647, 2147483647, 2147483647}, 7, BytesOf(kSixByColumns), 7)),
                "impossible");
  ExpectRefused(MatFile(MatVariable("a", {2, 3}, 99, BytesOf(kSixByColumns), 7)), "unknown type 99");
  // A compressed variable that claims 4 GB.
  ExpectRefused(MatFile(MatCompressed(BytesOf<uint32_t>({14, 0xfffffff0}))), "in");
}

TEST_F(MatFileTest, TruncatedAndDamagedFilesAreRefused) {
  const std::string variable = MatVariable("a", {2, 3}, 7, BytesOf(kSixByColumns), 7);
  for (const std::string& bytes : {MatFile(variable), MatFile(MatCompressed(variable))}) {
    const auto read = [&] { ArrayOf(ReadMatFile(path_, {"a"}), "a", "m.mat"); };
    EXPECT_EQ(testing::CountRefusedTruncations(path_, bytes, read), static_cast<int>(bytes.size()));
    Rng rng(1);
    testing::CountRefusedFlips(path_, bytes, 1000, rng, read);
  }
}

}  // namespace
}  // namespace daumier::faces

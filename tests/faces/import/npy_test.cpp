#include "faces/import/npy.h"

#include "tests/faces/import/foreign_files.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using testing::BytesOf;
using testing::ExpectError;
using testing::Npy;
using testing::TempDir;

const std::string kSix = BytesOf<float>({0, 1, 2, 3, 4, 5});

TEST(Npy, VersionsAndOrdersAreRead) {
  for (const char version : {1, 2, 3}) {
    const NumberArray array = ParseNpy(Npy("<f4", "2, 3", kSix, false, version), "a");
    EXPECT_EQ(array.shape(), (std::vector<int64_t>{2, 3}));
    EXPECT_EQ(array[4], 4);
  }
  EXPECT_EQ(ParseNpy(Npy("<f4", "2, 3", kSix, true), "a")[1], 2);
  EXPECT_EQ(ParseNpy(Npy("<i8", "1,", BytesOf(int64_t{7})), "a")[0], 7);
  EXPECT_EQ(ParseNpy(Npy("|u1", "", BytesOf(uint8_t{7})), "a")[0], 7);
}

TEST(Npy, HostileHeadersAreRefused) {
  const auto refused = [](const std::string& bytes, const std::string& part) {
    ExpectError([&] { ParseNpy(bytes, "m.npz: a"); }, part);
  };
  refused("PK no numpy at all", "m.npz: a: not a .npy array");
  refused(Npy("|O", "1,", "x"), "holds Python objects");
  refused(Npy(">f4", "1,", "1234"), "big-endian");
  refused(Npy("<U4", "1,", std::string(16, ' ')), "'<U4' are not read");
  refused(Npy("<c8", "1,", std::string(8, ' ')), "'<c8' are not read");
  refused(Npy("<f4", "2, 3", kSix, false, 4), "version 4 is not known");
  refused(Npy("<f4", "7", kSix), "24 bytes, its shape (7) needs 28");
  refused(Npy("<f4", "-6", kSix), "impossible shape");
  refused(Npy("<f4", "4611686018427387904, 4", kSix), "impossible shape");
  refused(Npy("<f4", "99999999999999999999", kSix), "malformed .npy header");
  refused(Npy("<f4", "2; 3", kSix), "malformed .npy header");
  std::string longer = Npy("<f4", "2, 3", kSix);
  longer[9] = '\x7f';
  refused(longer, "a header of");
  for (const std::string text :
       {"{", "{}", "{'shape': (1,)}", "{'descr': '<f4'}", "{'descr': [('a', '<f4')]}", "{'a': 1}"})
    EXPECT_THROW(
        ParseNpy("\x93NUMPY\x01" + std::string(1, '\0') + BytesOf(static_cast<uint16_t>(text.size())) + text, "a"),
        Error)
        << text;
}

TEST(Npy, EveryTruncationIsRefused) {
  const std::string bytes = Npy("<f4", "2, 3", kSix);
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(ParseNpy(std::string_view(bytes).substr(0, size), "a"), Error) << size;
}

TEST(Npz, WantedArraysAreRead) {
  const TempDir folder;
  testing::WriteNpz(folder / "m.npz", {{"f", Npy("<f4", "2, 3", kSix)}, {"other", Npy("|O", "1,", "x")}});
  const NumberArrays arrays = ReadNpz(folder / "m.npz", {"f", "missing"});
  ASSERT_EQ(arrays.size(), 1u);
  EXPECT_EQ(arrays.at("f")[5], 5);
  EXPECT_EQ(arrays.at("f").name(), (folder / "m.npz").string() + ": f");
  ExpectError([&] { ReadNpz(folder / "m.npz", {"other"}); }, "m.npz: other: holds Python objects");
}

TEST(Npz, DamagedFilesAreRefusedOrLackTheArray) {
  const TempDir folder;
  const auto path = folder / "m.npz";
  testing::WriteNpz(path, {{"f", Npy("<f4", "2, 3", kSix)}});
  const std::string bytes = ReadFile(path);
  const auto read = [&] { ArrayOf(ReadNpz(path, {"f"}), "f", "m.npz"); };
  const int num_refused = testing::CountRefusedTruncations(path, bytes, read);
  // Behind the array only the archive's own directory is cut.
  EXPECT_GT(num_refused, static_cast<int>(bytes.find("PK\x01\x02")) - 30);
  Rng rng(1);
  testing::CountRefusedFlips(path, bytes, 500, rng, read);
}

}  // namespace
}  // namespace daumier::faces

#include "core/npy.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

TEST(Npy, IsReadAsItWasWritten) {
  const TempDir folder;
  WriteNpy(folder / "a.npy", {2, 3, {1, 2, 3, 4, 5, -0.5f}});
  const NpyTable table = ReadNpy(folder / "a.npy");
  EXPECT_EQ(table.rows, 2);
  EXPECT_EQ(table.columns, 3);
  EXPECT_EQ(table.numbers, (std::vector<float>{1, 2, 3, 4, 5, -0.5f}));
}

TEST(Npy, HasTheLayoutOfNumPy) {
  const std::string bytes = EncodeNpy({1, 1, {1}});
  EXPECT_EQ(bytes.size(), 128 + 4) << "the data begin at a multiple of 64";
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(bytes.substr(10, 55), "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1");
  EXPECT_EQ(bytes[127], '\n');
  EXPECT_EQ(bytes.substr(128), std::string("\0\0\x80\x3f", 4));
}

/// What numpy.save writes of numpy.array([[1.5, 2]]).
TEST(Npy, ReadsDoubles) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2), }";
  header.resize(117, ' ');
  header += '\n';
  const std::string bytes =
      std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + std::string("\0\0\0\0\0\0\xf8\x3f\0\0\0\0\0\0\0\x40", 16);
  EXPECT_EQ(DecodeNpy(bytes, "a.npy").numbers, (std::vector<float>{1.5f, 2}));
}

TEST(Npy, SaysWhatIsWrong) {
  const std::string bytes = EncodeNpy({1, 2, {1, 2}});
  ExpectError([] { DecodeNpy("PK", "a.npy"); }, "a.npy: no .npy file");
  ExpectError([&] { DecodeNpy(bytes.substr(0, bytes.size() - 1), "a.npy"); }, "7 bytes of numbers");
  ExpectError([&] { DecodeNpy(bytes.substr(0, 20), "a.npy"); }, "truncated in its header");
  std::string integers = bytes;
  integers.replace(integers.find("<f4"), 3, "<i4");
  ExpectError([&] { DecodeNpy(integers, "a.npy"); }, "expected two axes of '<f4' or '<f8'");
  ExpectError([] { EncodeNpy({2, 2, {1}}); }, "a table of 2 x 2 has 1 numbers");
}

}  // namespace
}  // namespace daumier::testing

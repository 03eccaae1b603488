#include "geometry/ply_rows.h"

#include "tests/geometry/ply_bytes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::geometry {
namespace {

using testing::ExpectError;
using testing::kPlyFormats;
using testing::PlyBytes;

/// The rows behind a header, with the first element begun.
struct Rows {
  explicit Rows(const std::string& bytes)
      : header(ParsePlyHeader(bytes, "a.ply")),
        rows(std::string_view(bytes).substr(header.num_bytes), header.format, "a.ply") {
    rows.Begin(header.elements.at(0));
    rows.NextRow();
  }
  const PlyProperty& property(size_t i) const { return header.elements[0].properties.at(i); }

  PlyHeader header;
  PlyRows rows;
};

template <class T>
void ExpectExtremesAreExact(const std::string& type) {
  using Limits = std::numeric_limits<T>;
  for (const PlyFormat format : kPlyFormats) {
    PlyBytes file(format, "element e 1\nproperty " + type + " a\nproperty " + type + " b\nproperty " + type + " c\n");
    file.Add(Limits::lowest()).Add(Limits::max()).Add(T(7));
    Rows read(file.bytes());
    EXPECT_EQ(read.rows.Read(read.property(0)), double(Limits::lowest())) << type;
    EXPECT_EQ(read.rows.Read(read.property(1)), double(Limits::max())) << type;
    EXPECT_EQ(read.rows.Read(read.property(2)), 7.0) << type;
  }
}

TEST(PlyRows, EveryTypeIsExactInEveryFormat) {
  ExpectExtremesAreExact<int8_t>("char");
  ExpectExtremesAreExact<uint8_t>("uchar");
  ExpectExtremesAreExact<int16_t>("short");
  ExpectExtremesAreExact<uint16_t>("ushort");
  ExpectExtremesAreExact<int32_t>("int");
  ExpectExtremesAreExact<uint32_t>("uint");
  ExpectExtremesAreExact<float>("float");
  ExpectExtremesAreExact<double>("double");
}

TEST(PlyRows, ReadsBigEndianBytesWorkedOutByHand) {
  const std::string header =
      "ply\nformat binary_big_endian 1.0\nelement e 1\nproperty ushort a\nproperty float b\nend_header\n";
  const std::string bytes = header + std::string("\x01\x02\xC0\x20\x00\x00", 6);
  Rows read(bytes);
  EXPECT_EQ(read.rows.Read(read.property(0)), 258.0);
  EXPECT_EQ(read.rows.Read(read.property(1)), -2.5);
}

TEST(PlyRows, ReadsAndSkipsLists) {
  for (const PlyFormat format : kPlyFormats) {
    PlyBytes file(format, "element e 1\nproperty list ushort short a\nproperty list char double b\nproperty int c\n");
    file.Add(uint16_t(2)).Add(int16_t(-5)).Add(int16_t(6)).Add(int8_t(0)).Add(int32_t(42));
    Rows read(file.bytes());
    std::vector<double> values;
    read.rows.ReadList(read.property(0), values);
    EXPECT_EQ(values, (std::vector<double>{-5, 6}));
    read.rows.Skip(read.property(1));
    EXPECT_EQ(read.rows.ReadIndex(read.property(2), 0, 43, "c"), 42);
    Rows again(file.bytes());
    again.rows.Skip(again.property(0));
    again.rows.ReadList(again.property(1), values);
    EXPECT_TRUE(values.empty());
  }
}

TEST(PlyRows, CountsThatTheFileCannotHoldAreRefusedBeforeAnythingIsAllocated) {
  for (const PlyFormat format : kPlyFormats) {
    ExpectError([&] { Rows(PlyBytes(format, "element e 18446744073709551615\nproperty double a\n").bytes()); },
                "truncated PLY file (found 0 bytes for element e, expected 18446744073709551615 rows");
    PlyBytes file(format, "element e 1\nproperty list uint double a\n");
    file.Add(uint32_t(4'000'000'000)).Add(1.0);
    Rows read(file.bytes());
    std::vector<double> values;
    ExpectError([&] { read.rows.ReadList(read.property(0), values); }, "a.ply: row 1 of element e: a is damaged");
    PlyBytes negative(format, "element e 1\nproperty list int uchar a\n");
    negative.Add(int32_t(-1));
    Rows negative_list(negative.bytes());
    ExpectError([&] { negative_list.rows.Skip(negative_list.property(0)); }, "found a list of -1 numbers");
  }
}

TEST(PlyRows, TheEndOfTheFileAndWhatIsNoNumberAreNamed) {
  const std::string two = "ply\nformat ascii 1.0\nelement e 1\nproperty float a\nproperty float b\nend_header\n";
  const auto read_both = [](const std::string& bytes) {
    Rows read(bytes);
    read.rows.Read(read.property(0));
    return read.rows.Read(read.property(1));
  };
  EXPECT_EQ(read_both(two + "1\r\n\t+2.5"), 2.5);
  EXPECT_TRUE(std::isnan(read_both(two + "1 -nan")));
  ExpectError([&] { read_both(two + "1  \n"); },
              "row 1 of element e: truncated PLY file (found its end, expected b of 1 rows)");
  ExpectError([&] { read_both(two + "1 2,5"); }, "b is malformed (found '2,5', expected a number)");
  ExpectError([&] { read_both(two + "1 +"); }, "b is malformed");
  PlyBytes lists(PlyFormat::kLittleEndian, "element e 1\nproperty list uchar int a\nproperty int b\n");
  lists.Add(uint8_t(1)).Add(int32_t(3)).Add(int16_t(1));
  Rows read(lists.bytes());
  read.rows.Skip(read.property(0));
  ExpectError([&] { read.rows.Read(read.property(1)); }, "truncated PLY file (found 2 bytes, expected 4 for b)");
}

TEST(PlyRows, AnIndexIsAWholeNumberInRange) {
  Rows read("ply\nformat ascii 1.0\nelement e 1\nproperty float a\nend_header\n1");
  EXPECT_EQ(ToIndex(3, 0, 4, "a corner", read.rows), 3);
  for (const double value : {-1.0, 4.0, 0.5, std::nan(""), 1e300, -1e300}) {
    ExpectError([&] { ToIndex(value, 0, 4, "a corner", read.rows); }, "expected a whole number from 0 to 3");
  }
}

}  // namespace
}  // namespace daumier::geometry

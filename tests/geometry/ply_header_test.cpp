#include "geometry/ply_header.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

const std::string kHeader =
    "ply\nformat binary_big_endian 1.0\ncomment made by hand\nobj_info 3 scans\nelement vertex 12\nproperty float x\n"
    "property double  y\n\nelement face 5\nproperty list uint8 int32 vertex_indices\nend_header\n";

TEST(PlyHeader, HoldsFormatElementsPropertiesAndItsLength) {
  const PlyHeader header = ParsePlyHeader(kHeader + "data", "text");
  EXPECT_EQ(header.format, PlyFormat::kBigEndian);
  EXPECT_EQ(header.num_bytes, kHeader.size());
  ASSERT_EQ(header.elements.size(), 2u);
  EXPECT_EQ(header.elements[0].name, "vertex");
  EXPECT_EQ(header.elements[0].count, 12u);
  EXPECT_EQ(header.elements[0].Find("y"), 1u);
  EXPECT_FALSE(header.elements[0].Find("z"));
  EXPECT_EQ(header.elements[0].properties[1].type, PlyType::kFloat64);
  const PlyProperty& list = header.elements[1].properties.at(0);
  EXPECT_EQ(list.count_type, PlyType::kUint8);
  EXPECT_EQ(list.type, PlyType::kInt32);
  EXPECT_EQ(list.name, "vertex_indices");
}

// A binary file whose first number begins with the byte of LF: a CR before it may be the whole line end.
TEST(PlyHeader, LinesEndAsTheFirstOne) {
  for (const std::string line_end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : kHeader) text += c == '\n' ? line_end : std::string(1, c);
    EXPECT_EQ(ParsePlyHeader(text + "\n\r", "text").num_bytes, text.size()) << line_end.size();
  }
  EXPECT_EQ(ParsePlyHeader("ply\nformat ascii 1.0\r\nend_header\r\n1", "text").num_bytes, 34u);
}

TEST(PlyHeader, SizesAreThoseOfTheFormat) {
  const std::string types[][3] = {{"char", "int8", "1"},     {"uchar", "uint8", "1"},   {"short", "int16", "2"},
                                  {"ushort", "uint16", "2"}, {"int", "int32", "4"},     {"uint", "uint32", "4"},
                                  {"float", "float32", "4"}, {"double", "float64", "8"}};
  for (const auto& [old_name, new_name, size] : types) {
    const PlyHeader header = ParsePlyHeader(
        "ply\nformat ascii 1.0\nelement e 1\nproperty " + old_name + " a\nproperty " + new_name + " b\nend_header\n",
        "t");
    const auto& properties = header.elements[0].properties;
    EXPECT_EQ(properties[0].type, properties[1].type) << old_name;
    EXPECT_EQ(SizeOf(properties[0].type), std::stoul(size)) << old_name;
  }
}

TEST(PlyHeader, RefusesWhatIsWrongAndSaysWhatItFound) {
  const auto refuses = [](const std::string& text, const std::string& part) {
    ExpectError([&] { ParsePlyHeader(text, "a.ply"); }, "a.ply: ");
    ExpectError([&] { ParsePlyHeader(text, "a.ply"); }, part);
  };
  const std::string begin = "ply\nformat ascii 1.0\n";
  refuses("", "not a PLY file (found '', expected 'ply'");
  refuses("solid cube\n", "not a PLY file (found 'solid cube'");
  refuses("plyer\n", "not a PLY file");
  refuses("ply", "not a PLY file");
  refuses(begin, "no end_header");
  refuses("ply\nend_header\n", "no line 'format'");
  refuses("ply\nformat binary 1.0\nend_header\n", "found 'format binary 1.0'");
  refuses("ply\nformat ascii 2.0\nend_header\n", "found 'format ascii 2.0'");
  refuses(begin + "elements 3\n", "found 'elements 3'");
  refuses(begin + "element vertex\n", "expected element NAME COUNT");
  refuses(begin + "element vertex -3\n", "a count of 0 or more");
  refuses(begin + "element vertex 99999999999999999999999\n", "a count of 0 or more");
  refuses(begin + "element vertex 3\nelement vertex 3\n", "expected every element once");
  refuses(begin + "property float x\n", "behind an element");
  refuses(begin + "element vertex 3\nproperty half x\n", "expected a type");
  refuses(begin + "element vertex 3\nproperty list int x\n", "property list TYPE TYPE NAME");
  refuses(begin + "element vertex 3\n\x01\x02 bytes\n", "found '?? bytes'");
}

}  // namespace
}  // namespace daumier::geometry

#include "faces/marked_points.h"

#include "core/error.h"
#include "core/files.h"
#include "faces/marked_documents.h"
#include "faces/marked_rows.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Vector3;
using testing::ExpectError;

class MarkedPointsTest : public ::testing::Test {
 protected:
  std::filesystem::path Write(const std::string& text) const {
    WriteFileAtomically(folder_ / "points", text);
    return folder_ / "points";
  }
  const testing::TempDir folder_;
};

TEST_F(MarkedPointsTest, TheContentNamesTheForm) {
  for (const char* text :
       {"\xEF\xBB\xBF 1 2 3\n4 5 6\n", "\n[[1, 2, 3], [4, 5, 6]]", "{\"a\": [1, 2, 3], \"b\": [4, 5, 6]}",
        "{\n1 2 3\n4 5 6\n}\n", "[[1. 2. 3.]\n [4. 5. 6.]]", "LM3=2\n1 2 3\n4 5 6\nID=a\n",
        "Version 1.0\n2\nS000 1 2 3\nS001 4 5 6\n",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
        "1 2 3\n4 5 6\n",
        " <PickedPoints><point x='1' y='2' z='3'/><point x='4' y='5' z='6'/></PickedPoints>"}) {
    const MarkedPoints marked = ReadMarkedPoints(Write(text));
    ASSERT_EQ(marked.points.size(), 2u) << text;
    EXPECT_EQ(marked.points[1], Vector3(4, 5, 6)) << text;
    EXPECT_EQ(marked.file, folder_ / "points");
  }
}

TEST_F(MarkedPointsTest, ZeroIsAbsentOnlyIfStated) {
  const auto path = Write("0 0 0\n0 1 0\n0 0 0\n");
  EXPECT_TRUE(ReadMarkedPoints(path).points[0]);
  const MarkedPoints marked = ReadMarkedPoints(path, ZeroPoints::kAbsent);
  EXPECT_FALSE(marked.points[0]);
  EXPECT_TRUE(marked.points[1]);
}

TEST_F(MarkedPointsTest, RefusesWhatHoldsNoPoints) {
  ExpectError([&] { ReadMarkedPoints(folder_ / "absent"); }, "absent");
  ExpectError([&] { ReadMarkedPoints(Write("")); }, "points: holds no point");
  ExpectError([&] { ReadMarkedPoints(Write("[]")); }, "points: holds no point");
  ExpectError([&] { ReadMarkedPoints(Write("{}")); }, "points: holds no point");
  ExpectError([&] { ReadMarkedPoints(Write("null")); }, "all 1 are absent");
  ExpectError([&] { ReadMarkedPoints(Write("\"\"\"\n")); }, "a double quote is not closed");
}

TEST(MarkedPoints, AnyBytesAreReadOrRefused) {
  for (unsigned seed = 0; seed < 600; ++seed) {
    std::string bytes(seed % 97 + 1, ' ');
    unsigned state = seed * 7919u + 1;
    for (char& c : bytes) {
      state = state * 1664525u + 1013904223u;
      c = "0123456789 .,;-\n\t#:{}[]<>\"xe="[(state >> 16) % 30];
    }
    for (const auto parse : {ParseMarkedRows, ParseMarkedJson, ParseMarkedXml}) {
      try {
        parse(bytes, "a");
      } catch (const Error&) {  // Any other exception fails the test.
      }
    }
  }
}

}  // namespace
}  // namespace daumier::faces

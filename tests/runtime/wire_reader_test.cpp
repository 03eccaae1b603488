#include "runtime/wire_reader.h"

#include "tests/runtime/onnx_bytes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::runtime {
namespace {

TEST(WireReader, ReadsFieldsInTheirOrder) {
  const std::string bytes = IntegerField(1, 300) + BytesField(2, "text") + IntegerField(1000, -1) +
                            std::string("\x1d\x00\x00\x80\x3f", 5);  // Field 3, the float 1.
  WireReader reader(bytes);
  ASSERT_TRUE(reader.Next());
  EXPECT_EQ(reader.field(), 1);
  EXPECT_EQ(reader.Integer(), 300);
  ASSERT_TRUE(reader.Next());
  EXPECT_EQ(reader.Bytes(), "text");
  testing::ExpectError([&] { reader.Integer(); }, "field 2 has the wire type 2, expected 0");
  ASSERT_TRUE(reader.Next());
  EXPECT_EQ(reader.field(), 1000);
  EXPECT_EQ(reader.Integer(), -1);
  ASSERT_TRUE(reader.Next());
  EXPECT_EQ(reader.Real(), 1);
  EXPECT_FALSE(reader.Next());
}

TEST(WireReader, ReadsRepeatedIntegersPackedOrNot) {
  const auto read = [](const std::string& bytes) {
    std::vector<int64_t> integers;
    WireReader reader(bytes);
    while (reader.Next()) reader.Integers([&](int64_t value) { integers.push_back(value); });
    return integers;
  };
  const std::vector<int64_t> expected = {1, 200, -5};
  EXPECT_EQ(read(IntegerField(8, 1) + IntegerField(8, 200) + IntegerField(8, -5)), expected);
  EXPECT_EQ(read(BytesField(8, Varint(1) + Varint(200) + Varint(uint64_t(-5)))), expected);
}

TEST(WireReader, RefusesWhatIsCutOffOrMalformed) {
  const auto read = [](const std::string& bytes) {
    WireReader reader(bytes);
    while (reader.Next()) {
    }
  };
  testing::ExpectError([&] { read(BytesField(2, "text").substr(0, 4)); }, "the file ends within a field of 4 bytes");
  testing::ExpectError([&] { read("\x08\x80"); }, "the file ends within a number");
  testing::ExpectError([&] { read("\x08" + std::string(10, '\xff')); }, "more than 64 bits");
  testing::ExpectError([&] { read(std::string(1, '\0')); }, "a field has the number 0");
  testing::ExpectError([&] { read("\x0b"); }, "field 1 has the wire type 3");
  testing::ExpectError([&] { read(Varint(1 << 3 | 2) + Varint(uint64_t(-1))); }, "the file ends within a field");
  testing::ExpectError([] { WireReader("", 17); }, "nested more than 16 deep");
}

}  // namespace
}  // namespace daumier::runtime

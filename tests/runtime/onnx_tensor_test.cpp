#include "runtime/onnx_tensor.h"

#include "tests/runtime/onnx_bytes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::runtime {
namespace {

/// bytes: the fields of TensorProto.
GraphTensor ReadTensor(const std::string& bytes) {
  return TensorReader(".").Read(StoredTensorOf(WireReader(bytes)));
}

TEST(OnnxTensor, RealNumbersBecomeFloats) {
  const std::vector<float> reals = {1.5f, -2};
  EXPECT_EQ(ReadTensor(OnnxTensor("w", {2}, reals)).numbers, reals);
  EXPECT_EQ(ReadTensor(RawTensor<double>("w", {2}, kFloat64, {1.5, -2})).numbers, reals);
  EXPECT_EQ(ReadTensor(RawTensor<Half>("w", {2}, kFloat16, {HalfFromFloat(1.5f), HalfFromFloat(-2)})).numbers, reals);
  EXPECT_EQ(ReadTensor(RawTensor<uint16_t>("w", {2}, kBfloat16, {0x3fc0, 0xc000})).numbers, reals);
  EXPECT_TRUE(IsRealType(kBfloat16));
  EXPECT_FALSE(IsRealType(kUint8));
}

TEST(OnnxTensor, WholeNumbersAndBooleansBecomeIntegers) {
  const std::vector<int64_t> whole = {3, 250};
  EXPECT_EQ(ReadTensor(RawTensor<uint8_t>("w", {2}, kUint8, {3, 250})).integers, whole);
  EXPECT_EQ(ReadTensor(RawTensor<uint16_t>("w", {2}, kUint16, {3, 250})).integers, whole);
  EXPECT_EQ(ReadTensor(RawTensor<int32_t>("w", {2}, kInt32, {3, 250})).integers, whole);
  EXPECT_EQ(ReadTensor(RawTensor<uint32_t>("w", {2}, kUint32, {3, 250})).integers, whole);
  EXPECT_EQ(ReadTensor(IntegersTensor("w", whole)).integers, whole);
  EXPECT_EQ(ReadTensor(RawTensor<int8_t>("w", {1}, kInt8, {-3})).integers, std::vector<int64_t>{-3});
  EXPECT_EQ(ReadTensor(RawTensor<int16_t>("w", {1}, kInt16, {-3})).integers, std::vector<int64_t>{-3});
  EXPECT_EQ(ReadTensor(RawTensor<uint8_t>("w", {2}, kBool, {0, 1})).integers, (std::vector<int64_t>{0, 1}));
}

TEST(OnnxTensor, NumbersMayBeListed) {
  const std::vector<float> reals = {1.5f, -2};
  const std::vector<int64_t> whole = {3, 250};
  const std::string head = IntegerField(1, 2) + BytesField(8, "w");
  const std::string floats(reinterpret_cast<const char*>(reals.data()), 2 * sizeof(float));
  EXPECT_EQ(ReadTensor(head + IntegerField(2, kFloat32) + BytesField(4, floats)).numbers, reals);
  EXPECT_EQ(ReadTensor(head + IntegerField(2, kInt32) + IntegerField(5, 3) + IntegerField(5, 250)).integers, whole);
  EXPECT_EQ(ReadTensor(head + IntegerField(2, kInt64) + BytesField(7, Varint(3) + Varint(250))).integers, whole);
  EXPECT_EQ(ReadTensor(head + IntegerField(2, kFloat16) + IntegerField(5, HalfFromFloat(1.5f).bits) +
                       IntegerField(5, HalfFromFloat(-2).bits))
                .numbers,
            reals);
}

TEST(OnnxTensor, BytesThatDoNotFillTheShapeAreRefused) {
  const auto refused = [](const std::string& bytes, const std::string& part) {
    testing::ExpectError([&] { ReadTensor(bytes); }, part);
  };
  refused(RawTensor<double>("w", {3}, kFloat64, {1}), "the tensor 'w' has 8 bytes, expected 24 for (3)");
  refused(RawTensor<double>("w", {1}, 14, {1}), "the element type 14, which is no number");
  refused(IntegerField(1, 2) + IntegerField(2, kFloat32) + BytesField(8, "w"), "has 0 bytes, expected 8");
  refused(IntegerField(2, kString) + BytesField(8, "w") + BytesField(6, "a"), "has data in field 6");
}

}  // namespace
}  // namespace daumier::runtime

#include "faces/import/torch_tensors.h"

#include "tests/support/expect_error.h"
#include "tests/support/torch_checkpoint.h"

#include <gtest/gtest.h>

/// Files as a whole are in torch_file_test.cpp.
namespace daumier::faces {
namespace {

using testing::PickleText;

std::map<std::string, StoredTensor> TensorsOfValue(const std::string& tensor) {
  const std::string bytes = PickleText::File("}" + PickleText::Text("a") + tensor + "s");
  return TensorsOf(ReadPickle(bytes, "a.pth", TorchNames()), "a.pth");
}

TEST(TorchTensors, AViewIsItsStorageOffsetShapeAndStrides) {
  const StoredTensor tensor = TensorsOfValue(PickleText::Tensor("HalfStorage", "7", 12, 5, {2, 2}, {4, 1})).at("a");
  EXPECT_EQ(tensor.type, StoredTensor::Type::kF16);
  EXPECT_EQ(tensor.storage, "7");
  EXPECT_EQ(tensor.storage_bytes(), 24);
  EXPECT_EQ(tensor.offset, 5);
  EXPECT_EQ(tensor.size(), 4);
}

TEST(TorchTensors, ElementsAreGatheredInRowMajorOrder) {
  const std::string storage = {0, 1, 2, 3, 4, -1};
  StoredTensor tensor{StoredTensor::Type::kI8, "0", 6, 1, {2, 2}, {1, 2}};
  EXPECT_EQ(Elements(tensor, storage).values, (std::vector<float>{1, 3, 2, 4}));
  tensor.shape = {};
  tensor.strides = {};
  tensor.offset = 5;
  EXPECT_EQ(Elements(tensor, storage).values, std::vector<float>{-1});
  tensor.type = StoredTensor::Type::kU8;
  EXPECT_EQ(Elements(tensor, storage).values, std::vector<float>{255});
  testing::ExpectError([&] { Elements(tensor, "abc"); }, "a storage of 3 bytes, expected 6");
}

TEST(TorchTensors, EveryStorageOfAPickleIsCounted) {
  const std::string bytes =
      PickleText::File("}(" + PickleText::Text("model") + "}" + PickleText::Text("a") +
                       PickleText::Tensor("DoubleStorage", "0", 3, 0, {3}, {1}) + "s" + PickleText::Text("step") +
                       PickleText::Tensor("LongStorage", "1", 2, 0, {}, {}) + "u");
  const Pickle pickle = ReadPickle(bytes, "a.pth", TorchNames());
  EXPECT_EQ(StorageBytes(pickle, "a.pth"), (std::map<std::string, int64_t>{{"0", 24}, {"1", 16}}));
}

TEST(TorchTensors, RefusesWhatIsNoStorage) {
  const auto refused = [](const std::string& tensor, const std::string& part) {
    testing::ExpectError([&] { TensorsOfValue(tensor); }, part);
  };
  const std::string make = PickleText::Name("torch._utils", "_rebuild_tensor_v2");
  refused(make + PickleText::Tuple("K\x01K\x02K\x03K\x04") + "R", "'a' has no storage");
  refused(make + ")R", "'a' has no storage");
  refused(PickleText::Tensor("FloatStorage", "0", -4, 0, {1}, {1}), "the storage of 'a' has -4 elements");
  refused(PickleText::Tensor("ComplexFloatStorage", "0", 4, 0, {1}, {1}), "'torch.ComplexFloatStorage'");
}

}  // namespace
}  // namespace daumier::faces

#include "core/device.h"

#include "core/error.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

TEST(Device, NamesAreReadBack) {
  for (const char* name : {"cpu", "cuda:0", "cuda:3"}) EXPECT_EQ(DeviceName(ParseDevice(name)), name);
  EXPECT_EQ(ParseDevice("cuda"), (Device{Device::Kind::kCuda, 0}));
}

TEST(Device, OtherTextsAreRefused) {
  for (const char* text : {"", "gpu", "cuda:", "cuda:x", "cuda:-1", "cuda:1x", "CPU"})
    EXPECT_THROW(ParseDevice(text), UsageError) << text;
}

}  // namespace
}  // namespace daumier

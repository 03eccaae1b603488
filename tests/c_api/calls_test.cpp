#include "c_api/calls.h"

#include "core/log.h"

#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace daumier::c_api {
namespace {

TEST(CCall, ReturnsAStatusForWhateverIsThrown) {
  EXPECT_EQ(Call([] {}), DAUMIER_OK);
  EXPECT_EQ(Call([] { throw UsageError("a"); }), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "a");
  EXPECT_EQ(Call([] { throw Error("b"); }), DAUMIER_FAILED);
  EXPECT_STREQ(daumier_last_error(), "b");
  EXPECT_EQ(Call([] { throw std::bad_alloc(); }), DAUMIER_FAILED);
  EXPECT_EQ(Call([] { throw 5; }), DAUMIER_FAILED);
  EXPECT_STREQ(daumier_last_error(), "an unknown error");
  EXPECT_EQ(Call([] {}), DAUMIER_OK);
  EXPECT_STREQ(daumier_last_error(), "an unknown error");  // Of the last call that failed.
}

TEST(CCall, EachThreadHasItsOwnError) {
  Fail(DAUMIER_FAILED, "outer");
  std::vector<std::string> seen(8);
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&seen, i] {
      EXPECT_STREQ(daumier_last_error(), "");
      Fail(DAUMIER_FAILED, std::to_string(i).c_str());
      std::this_thread::yield();
      seen[size_t(i)] = daumier_last_error();
    });
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < 8; ++i) EXPECT_EQ(seen[size_t(i)], std::to_string(i));
  EXPECT_STREQ(daumier_last_error(), "outer");
}

TEST(CCall, BuffersHaveTheirSizeAndFiniteNumbers) {
  const std::vector<float> two = {1, 2, 3, 4, 5, 6};
  const geometry::Points points = ReadPoints(two.data(), 6, 2, "xyz");
  EXPECT_EQ(points(1, 0), 4);
  std::vector<float> back(6);
  WritePoints(points, back.data(), 6, "xyz");
  EXPECT_EQ(back, two);
  EXPECT_EQ(Call([&] { ReadPoints(two.data(), 5, 2, "xyz"); }), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "xyz has 5 elements (expected 6)");
  EXPECT_EQ(Call([&] { WritePoints(points, nullptr, 6, "xyz"); }), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "xyz is NULL");
  back[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Call([&] { ReadPoints(back.data(), 6, 2, "moves"); }), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "moves[4] is nan (expected 10000 at most, in cm)");
  back[4] = -2e4f;
  EXPECT_EQ(Call([&] { ReadPoints(back.data(), 6, 2, "moves"); }), DAUMIER_MISUSED);
  EXPECT_EQ(Call([&] { WritePoints(geometry::Points(0, 3), nullptr, 0, "xyz"); }), DAUMIER_OK);
  std::vector<int32_t> corners(3);
  WriteTriangles((geometry::Triangles(1, 3) << 7, 8, 9).finished(), corners.data(), 3);
  EXPECT_EQ(corners, (std::vector<int32_t>{7, 8, 9}));
}

TEST(CLibrary, HasAVersionAndIsSilentUntilItIsSetToSpeak) {
  EXPECT_STREQ(daumier_version(), DAUMIER_VERSION);
  EXPECT_EQ(log::GetLevel(), log::Level::kOff);
  EXPECT_EQ(daumier_set_log_level(DAUMIER_LOG_WARNING), DAUMIER_OK);
  EXPECT_EQ(log::GetLevel(), log::Level::kWarning);
  EXPECT_EQ(daumier_set_log_level(daumier_log_level(77)), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "the log level 77 does not exist");
  EXPECT_EQ(daumier_set_log_level(DAUMIER_LOG_OFF), DAUMIER_OK);
}

}  // namespace
}  // namespace daumier::c_api

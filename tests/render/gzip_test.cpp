#include "render/gzip.h"

#include "core/error.h"
#include "tests/render/gzipped.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExpectError;
using testing::Gzipped;

TEST(Gzip, RoundTripKeepsAllBytes) {
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i * i >> 3);
  EXPECT_TRUE(IsGzip(Gzipped(bytes)));
  EXPECT_FALSE(IsGzip("<svg"));
  EXPECT_FALSE(IsGzip("\x1f"));
  EXPECT_EQ(Gunzip(Gzipped(bytes), bytes.size()), bytes);
  EXPECT_EQ(Gunzip(Gzipped(""), 0), "");
}

TEST(Gzip, MembersFollowEachOtherAndTheRestIsIgnored) {
  EXPECT_EQ(Gunzip(Gzipped("one ") + Gzipped("two") + std::string(20, '\0'), 100), "one two");
}

TEST(Gzip, RefusesWhatIsTruncatedDamagedOrTooLarge) {
  const std::string bytes = Gzipped("some text that is long enough");
  for (size_t size = 2; size < bytes.size(); ++size)
    ExpectError([&] { Gunzip(std::string_view(bytes).substr(0, size), 1000); }, "damaged or truncated");
  std::string flipped = bytes;
  flipped[bytes.size() - 6] ^= 1;  // Of the checksum.
  ExpectError([&] { Gunzip(flipped, 1000); }, "damaged or truncated");
  ExpectError([&] { Gunzip(Gzipped(std::string(3 << 20, 'a')), 2 << 20); }, "more than 2 MB");
}

}  // namespace
}  // namespace daumier::render

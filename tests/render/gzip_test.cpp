#include "render/gzip.h"

#include "tests/render/compressed.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(Gunzip, UndoesTheCompressionOfAllMembers) {
  const std::string text = "some text, some text, some text";
  EXPECT_EQ(Gunzip(testing::Gzipped(text), 1000), text);
  EXPECT_EQ(Gunzip(testing::Gzipped(text) + testing::Gzipped("more") + "rest", 1000), text + "more");
  EXPECT_TRUE(IsGzip(testing::Gzipped("")));
  EXPECT_FALSE(IsGzip("<svg"));
}

TEST(Gunzip, RefusesDamagedDataAndContentThatIsTooLarge) {
  const std::string compressed = testing::Gzipped(std::string(100000, 'a'));
  EXPECT_EQ(Gunzip(compressed, 100000).size(), 100000U);
  testing::ExpectError([&] { Gunzip(compressed, 99999); }, "hold more than");
  for (size_t size = 2; size < compressed.size(); ++size)
    testing::ExpectError([&] { Gunzip(std::string_view(compressed).substr(0, size), 1000000); }, "truncated");
}

}  // namespace
}  // namespace daumier::render

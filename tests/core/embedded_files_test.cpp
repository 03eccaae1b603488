// cmake/embed.cmake on the files of tests/core/embedded/.
#include "core/files.h"
#include "embedded/embedded_bytes.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier {
namespace {

using testing::EmbeddedFiles;
using ::testing::HasSubstr;

TEST(EmbeddedFiles, AreThoseOnDiskByteForByte) {
  int num_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::SourceRoot() / "tests/core/embedded")) {
    ++num_files;
    ASSERT_TRUE(EmbeddedFiles().contains(entry.path().stem().string())) << entry.path();
    EXPECT_EQ(EmbeddedFiles().at(entry.path().stem().string()), ReadFile(entry.path())) << entry.path();
  }
  EXPECT_EQ(EmbeddedFiles().size(), num_files);
}

TEST(EmbeddedFiles, KeepWhatTextBasedEmbeddingLoses) {
  const std::string hostile(EmbeddedFiles().at("hostile"));
  for (const std::string part :
       {"@word@", "${PROJECT_NAME}", "$<CONFIG>", ")embedded\"", "\\n", "list;of;items", "\r\n"})
    EXPECT_THAT(hostile, HasSubstr(part));
  EXPECT_THAT(hostile, HasSubstr(std::string("nul:\0:after", 11)));
  EXPECT_EQ(hostile.back(), '\r');
}

TEST(EmbeddedFiles, MayBeEmpty) {
  EXPECT_TRUE(EmbeddedFiles().at("empty").empty());
}

TEST(EmbeddedFiles, HoldEveryValueOfAByteAndHaveAnyStem) {
  const std::string_view bytes = EmbeddedFiles().at("two-words");
  ASSERT_EQ(bytes.size(), 256u);
  for (int value = 0; value < 256; ++value) EXPECT_EQ(static_cast<unsigned char>(bytes[value]), value);
}

}  // namespace
}  // namespace daumier

#include "core/licence_text.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

size_t CountOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(LicenceNotices, HaveTheWholeTextOfTheMitLicence) {
  const std::string text = LicenceNotices({{{"name", "Faces"}, {"licence", "MIT, (c) 2020 A University"}}});
  EXPECT_NE(text.find("Faces:"), std::string::npos);
  EXPECT_NE(text.find("Copyright (c) 2020 A University\n"), std::string::npos);
  EXPECT_NE(text.find("The above copyright notice and this permission notice shall be included"), std::string::npos);
  EXPECT_NE(text.find("THE SOFTWARE IS PROVIDED \"AS IS\""), std::string::npos);
}

TEST(LicenceNotices, OtherLicencesAreALine) {
  EXPECT_EQ(LicenceNotices({{{"name", "MakeHuman"}, {"licence", "CC0-1.0"}}}), "MakeHuman: CC0-1.0.\n\n");
  EXPECT_EQ(LicenceNotices({{{"name", "Meshes"}}}), "Meshes: unknown.\n\n");
}

TEST(LicenceNotices, ASourceIsListedOnce) {
  const Json faces = {{"name", "Faces"}, {"licence", "MIT, (c) 2020 A"}};
  Json other = faces;
  other["checksum"] = "another state of the same source";
  EXPECT_EQ(CountOf(LicenceNotices(Json::array({faces, faces, other})), "MIT License"), 1U);
  EXPECT_EQ(LicenceNotices(Json::array()), "");
}

}  // namespace
}  // namespace daumier

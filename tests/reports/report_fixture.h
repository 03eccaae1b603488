#pragma once
#include "core/random.h"
#include "render/draw.h"
#include "reports/report.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

/// What the tests of reports share.
namespace daumier::reports {

/// A report on faces that are the synthetic one and its wider likeness.
inline ReportData SyntheticReport() {
  const faces::FaceTemplate face = testing::SyntheticFace();
  ReportData data;
  data.title = "Sketch to face: synthetic, test split";
  data.summary = "Two faces of one person.";
  data.surface = {face.triangles, face.closing_triangles, face.num_eye_closing_triangles};
  data.mean_face = face.neutral;
  geometry::Points wider = face.neutral;
  wider.col(0) *= 1.05;
  const Eigen::VectorXd error_mm = 10.0 * (wider - face.neutral).rowwise().norm();
  render::Image sketch(256, 256, 1);
  render::FillRectangle(sketch, 60, 60, 6, 136, {20, 20, 20});
  data.samples = {{"median: 1.50 mm", sketch, face.neutral, wider, error_mm},
                  {"worst: 3.00 mm", {}, wider, face.neutral, error_mm}};
  data.samples[1].error_mm.head(200).setConstant(std::numeric_limits<double>::quiet_NaN());
  data.mean_error_mm = error_mm;
  Rng rng(7);
  for (int i = 0; i < 200; ++i) data.face_errors_mm.push_back(2.0 * std::exp(0.35 * rng.Normal()));
  data.tables = {{"Errors", {"method", "mm"}, {{"network", "2.12"}, {"mean face", "4.75"}}}};
  data.facts = {{"seed", "7"}, {"split", "random (12 training faces)"}};
  return data;
}

/// Number of occurrences of a part in a text.
inline int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// Expects that each tag is closed in the order in which tags were opened, that attributes are in quotes, and that
/// all is in one element.
inline void ExpectWellFormed(const std::string& xml) {
  std::vector<std::string> open;
  int num_roots = 0;
  for (size_t begin = xml.find('<'); begin != std::string::npos; begin = xml.find('<', begin + 1)) {
    const size_t end = xml.find('>', begin);
    ASSERT_NE(end, std::string::npos) << "a tag has no end";
    const std::string tag = xml.substr(begin + 1, end - begin - 1);
    ASSERT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
    ASSERT_EQ(Count(tag, "="), Count(tag, "=\"")) << tag;
    if (tag.front() == '/') {
      ASSERT_FALSE(open.empty()) << tag;
      ASSERT_EQ(tag.substr(1), open.back());
      open.pop_back();
    } else {
      num_roots += open.empty() ? 1 : 0;
      if (tag.back() != '/') open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(num_roots, 1);
}

}  // namespace daumier::reports

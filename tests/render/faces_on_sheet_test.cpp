#include "render/faces_on_sheet.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

namespace daumier::render {
namespace {

Stroke Oval(double cx, double cy, double rx, double ry) {
  Stroke stroke;
  for (int i = 0; i <= 40; ++i) {
    const double angle = 0.05 * std::numbers::pi * i;
    stroke.points.push_back({float(cx + rx * std::cos(angle)), float(cy + ry * std::sin(angle))});
  }
  return stroke;
}
Stroke Dash(float x1, float y1, float x2, float y2) {
  return {0, {{x1, y1}, {x2, y2}}};
}

/// Outline, eyes, nose and mouth of a face of this height.
void AddFace(std::vector<Stroke>& strokes, double cx, double cy, double height) {
  const double h = height / 2;
  strokes.push_back(Oval(cx, cy, 0.75 * h, h));
  for (const double side : {-1, 1}) strokes.push_back(Oval(cx + side * 0.3 * h, cy - 0.2 * h, 0.14 * h, 0.07 * h));
  strokes.push_back(Dash(float(cx), float(cy - 0.2 * h), float(cx - 0.1 * h), float(cy + 0.2 * h)));
  strokes.push_back(Oval(cx, cy + 0.5 * h, 0.3 * h, 0.1 * h));
}
Drawing Sheet(const std::vector<Stroke>& strokes) {
  return {1000, 600, strokes};
}

TEST(FacesOnSheet, TwoFacesAreTwoDrawingsFromLeftToRight) {
  std::vector<Stroke> strokes;
  AddFace(strokes, 700, 300, 300);
  AddFace(strokes, 250, 300, 260);
  const auto faces = FacesOnSheet(Sheet(strokes));
  ASSERT_EQ(faces.size(), 2U);
  for (const Drawing& face : faces) {
    EXPECT_EQ(face.width, 1000);
    EXPECT_EQ(face.strokes.size(), 5U);
  }
  EXPECT_LT(faces[0].strokes[0].points[0][0], 500);
  EXPECT_EQ(&LargestFace(faces), &faces[1]);
}

TEST(FacesOnSheet, FourFacesInRowsComeColumnByColumn) {
  std::vector<Stroke> strokes;
  for (const double x : {700, 200})
    for (const double y : {440, 140}) AddFace(strokes, x, y, 200);
  const auto faces = FacesOnSheet(Sheet(strokes));
  ASSERT_EQ(faces.size(), 4U);
  const auto first = [&](size_t i) { return faces[i].strokes[0].points[0]; };
  EXPECT_LT(first(0)[0], 500);
  EXPECT_LT(first(0)[1], 300);
  EXPECT_LT(first(1)[0], 500);
  EXPECT_GT(first(1)[1], 300);
  EXPECT_GT(first(2)[0], 500);
  EXPECT_LT(first(2)[1], 300);
}

TEST(FacesOnSheet, WhatElseIsOnTheSheetBelongsToTheNearestFace) {
  std::vector<Stroke> strokes;
  AddFace(strokes, 200, 300, 300);
  AddFace(strokes, 750, 300, 300);
  strokes.push_back(Dash(190, 60, 210, 62));    // A bow above the left head.
  strokes.push_back(Dash(760, 560, 800, 561));  // A signature below the right one.
  const auto faces = FacesOnSheet(Sheet(strokes));
  ASSERT_EQ(faces.size(), 2U);
  EXPECT_EQ(faces[0].strokes.back().points, strokes[10].points);
  EXPECT_EQ(faces[1].strokes.back().points, strokes[11].points);
}

TEST(FacesOnSheet, OneFaceStaysWhole) {
  std::vector<Stroke> face;
  AddFace(face, 500, 250, 300);
  auto with = [&](std::vector<Stroke> more) {
    more.insert(more.end(), face.begin(), face.end());
    return FacesOnSheet(Sheet(more)).size();
  };
  EXPECT_EQ(with({}), 1U);
  EXPECT_EQ(with({Dash(300, 500, 480, 460), Dash(700, 500, 520, 460)}), 1U) << "shoulders";
  EXPECT_EQ(with({Oval(330, 120, 60, 60), Oval(670, 120, 60, 60)}), 1U) << "hair in two bunches";
  EXPECT_EQ(with({Oval(340, 260, 20, 40), Oval(660, 260, 20, 40)}), 1U) << "ears";
  EXPECT_EQ(
      with({Oval(200, 250, 60, 60), Dash(180, 250, 220, 250), Dash(180, 240, 220, 240), Dash(180, 230, 220, 260)}), 1U)
      << "a small figure";

  // Eyes, nose and mouth alone: eyes of several strokes are no faces.
  std::vector<Stroke> features;
  for (const float x : {400.0F, 600.0F}) {
    features.push_back(Oval(x, 200, 40, 20));
    features.push_back(Oval(x, 200, 15, 15));
    features.push_back(Oval(x, 200, 6, 6));
    features.push_back(Dash(x - 40, 150, x + 40, 150));
  }
  features.push_back(Dash(500, 200, 480, 300));
  features.push_back(Dash(480, 300, 520, 300));
  features.push_back(Oval(500, 380, 70, 20));
  EXPECT_EQ(FacesOnSheet(Sheet(features)).size(), 1U);
}

/// Letters like N of a height side by side.
void AddText(std::vector<Stroke>& strokes, float left, float top, float height, int count) {
  for (int i = 0; i < count; ++i) {
    const float x = left + float(i) * height;
    strokes.push_back({0, {{x, top + height}, {x, top}, {x + 0.7F * height, top + height}, {x + 0.7F * height, top}}});
  }
}

TEST(FacesOnSheet, LetteringAboveOrBelowAFaceIsLeftOut) {
  std::vector<Stroke> face;
  AddFace(face, 500, 270, 300);  // From 120 to 420.
  const auto num_left_out = [&](const std::vector<Stroke>& more) {
    std::vector<Stroke> strokes = more;
    strokes.insert(strokes.end(), face.begin(), face.end());
    const auto faces = FacesOnSheet(Sheet(strokes));
    EXPECT_EQ(faces.size(), 1U);
    return NumLeftOut(Sheet(strokes), faces);
  };
  std::vector<Stroke> title, caption, large, aside, near, hair;
  AddText(title, 400, 5, 30, 8);
  AddText(caption, 350, 480, 40, 6);
  AddText(large, 300, 470, 100, 4);
  AddText(aside, 700, 250, 20, 6);
  AddText(near, 450, 430, 20, 5);
  AddText(hair, 420, 70, 30, 5);
  EXPECT_EQ(num_left_out(title), 8U);
  EXPECT_EQ(num_left_out(caption), 6U);
  EXPECT_EQ(num_left_out(large), 0U);
  EXPECT_EQ(num_left_out(aside), 0U);
  EXPECT_EQ(num_left_out(near), 0U) << "a beard";
  EXPECT_EQ(num_left_out(hair), 0U);
  Stroke signature;
  for (int i = 0; i < 12; ++i) signature.points.push_back({700.0F + float(10 * i), i % 2 == 0 ? 520.0F : 550.0F});
  EXPECT_EQ(num_left_out({signature}), 1U);
  EXPECT_EQ(num_left_out({Dash(300, 500, 480, 480), Dash(700, 500, 520, 480)}), 0U) << "shoulders";
  EXPECT_EQ(num_left_out({Oval(330, 470, 20, 20), Oval(670, 470, 20, 20)}), 0U) << "earrings";
  std::vector<Stroke> collar = caption;
  collar.push_back(Dash(200, 590, 800, 590));
  EXPECT_EQ(num_left_out(collar), 0U) << "buttons above a hem";
}

TEST(FacesOnSheet, OfFeaturesAloneNothingIsLeftOut) {
  // Eyes, nose and a mouth of short strokes.
  std::vector<Stroke> strokes = {Oval(400, 200, 40, 20), Oval(600, 200, 40, 20), Dash(500, 200, 490, 280)};
  for (const float x : {430.0F, 470.0F, 510.0F, 550.0F}) strokes.push_back(Dash(x, 350, x + 25, 352));
  const auto faces = FacesOnSheet(Sheet(strokes));
  EXPECT_EQ(faces.size(), 1U);
  EXPECT_EQ(NumLeftOut(Sheet(strokes), faces), 0U);
}

TEST(FacesOnSheet, ASmallFaceBesideALargeOneIsASecond) {
  std::vector<Stroke> strokes;
  AddFace(strokes, 300, 300, 400);
  AddFace(strokes, 800, 400, 180);
  EXPECT_EQ(FacesOnSheet(Sheet(strokes)).size(), 2U);
}

TEST(FacesOnSheet, FacesThatTouchOrShareALineAreOneDrawing) {
  std::vector<Stroke> strokes;
  AddFace(strokes, 300, 300, 300);
  AddFace(strokes, 540, 300, 300);  // 15 apart.
  EXPECT_EQ(FacesOnSheet(Sheet(strokes)).size(), 1U);
  strokes.clear();
  AddFace(strokes, 200, 300, 300);
  AddFace(strokes, 800, 300, 300);
  strokes.push_back(Dash(0, 460, 1000, 460));
  EXPECT_EQ(FacesOnSheet(Sheet(strokes)).size(), 1U);
}

TEST(FacesOnSheet, TakesDrawingsWithoutStrokesAndOfThousands) {
  EXPECT_EQ(FacesOnSheet(Sheet({})).size(), 1U);
  EXPECT_EQ(FacesOnSheet(Sheet({{0, {}}, {0, {{5, 5}}}})).size(), 1U);
  std::vector<Stroke> scribble;
  for (int i = 0; i < 2500; ++i) {
    AddFace(scribble, 250 + i % 7, 300 + i % 11, 300);
    AddFace(scribble, 750 + i % 5, 300 + i % 3, 300);
  }
  EXPECT_EQ(FacesOnSheet(Sheet(scribble)).size(), 2U);
  testing::ExpectError([] { LargestFace({}); }, "there is no face");
}

}  // namespace
}  // namespace daumier::render

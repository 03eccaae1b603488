#include "c_api/daumier.h"
#include "c_api/places.h"
#include "core/error.h"
#include "core/json.h"
#include "render/draw.h"
#include "render/read_drawing.h"
#include "tests/support/from_threads.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace daumier::c_api {
namespace {

/// A drawing as the C library takes it.
struct CDrawing {
  std::vector<float> points;
  std::vector<int32_t> sizes;
  daumier_strokes strokes{};
};

CDrawing ToC(const render::Drawing& drawing) {
  CDrawing c;
  for (const render::Stroke& stroke : drawing.strokes) {
    c.sizes.push_back(int32_t(stroke.points.size()));
    for (const std::array<float, 2>& point : stroke.points) c.points.insert(c.points.end(), point.begin(), point.end());
  }
  c.strokes = {c.points.data(), c.sizes.data(), int32_t(c.sizes.size()), float(drawing.width), float(drawing.height)};
  return c;
}

render::Drawing Girl() {
  return render::ReadDrawings("docs/examples/drawings/girl.svg").front();
}

const daumier_predictor* SketchPredictor() {
  static daumier_predictor* const predictor = [] {
    daumier_predictor* opened = nullptr;
    EXPECT_EQ(daumier_predictor_open("sketch-ict", &opened), DAUMIER_OK) << daumier_last_error();
    return opened;
  }();
  return predictor;
}

std::vector<float> VerticesOf(const daumier_face* face) {
  std::vector<float> xyz(3 * daumier_face_num_vertices(face));
  EXPECT_EQ(daumier_face_vertices(face, xyz.data(), xyz.size()), DAUMIER_OK) << daumier_last_error();
  return xyz;
}

std::vector<float> FaceOf(const CDrawing& drawing) {
  daumier_face* face = nullptr;
  EXPECT_EQ(daumier_predict_strokes(SketchPredictor(), &drawing.strokes, &face), DAUMIER_OK) << daumier_last_error();
  const std::vector<float> xyz = VerticesOf(face);
  daumier_face_free(face);
  return xyz;
}

TEST(CPrediction, FacesOfStrokesAreThoseOfThePredictor) {
  const auto system = std::ranges::find(Predictors(), "sketch", &systems::System::name);
  const auto predictor =
      system->open(FolderNamed("sketch-ict"), Device{}, system->resolve_prediction(Json::object(), ""));
  std::vector<systems::Input> inputs = {Girl()};
  const systems::FaceResult expected = predictor->Predict(inputs).front();
  const CDrawing drawing = ToC(Girl());
  daumier_face* face = nullptr;
  ASSERT_EQ(daumier_predict_strokes(SketchPredictor(), &drawing.strokes, &face), DAUMIER_OK) << daumier_last_error();
  const std::vector<float> xyz = VerticesOf(face);
  ASSERT_EQ(xyz.size(), 3 * size_t(expected.vertices.rows()));
  for (size_t i = 0; i < xyz.size(); ++i)
    ASSERT_EQ(xyz[i], float(expected.vertices(Eigen::Index(i / 3), Eigen::Index(i % 3)))) << i;

  std::vector<int32_t> corners(3 * daumier_face_num_triangles(face));
  ASSERT_EQ(daumier_face_triangles(face, corners.data(), corners.size()), DAUMIER_OK);
  EXPECT_EQ(corners[4], expected.face_template->triangles(1, 1));
  EXPECT_LT(size_t(*std::ranges::max_element(corners)), daumier_face_num_vertices(face));

  std::vector<float> landmarks(3 * 68);
  ASSERT_EQ(daumier_face_landmarks(face, landmarks.data(), landmarks.size()), DAUMIER_OK);
  EXPECT_EQ(landmarks[3 * 30 + 2], float(expected.landmarks(30, 2)));

  EXPECT_EQ(Json::parse(daumier_face_record(face)), expected.record);
  EXPECT_EQ(daumier_face_num_warnings(face), expected.warnings.size());
  EXPECT_EQ(daumier_face_warning(face, expected.warnings.size()), nullptr);
  EXPECT_EQ(daumier_face_vertices(face, landmarks.data(), landmarks.size()), DAUMIER_MISUSED);
  daumier_face_free(face);
}

TEST(CPrediction, OnePredictorServesSeveralThreads) {
  const CDrawing drawing = ToC(Girl());
  testing::ExpectTheSameFromThreads(1, [&] { return FaceOf(drawing); });
}

TEST(CPrediction, DrawingsMayBePicturesOfAnyChannelsAndRowLength) {
  const render::Image grey = [] {
    render::Drawing drawing = Girl();
    const float scale = render::kSketchCanvas / float(std::max(drawing.width, drawing.height));
    for (render::Stroke& stroke : drawing.strokes)
      for (auto& point : stroke.points) point = {point[0] * scale, point[1] * scale};
    return render::RasteriseStrokes(drawing.strokes, 512);
  }();
  std::vector<std::vector<float>> faces;
  for (const int channels : {1, 3, 4}) {
    const size_t row_bytes = size_t(grey.width) * size_t(channels) + 5;
    std::vector<uint8_t> pixels(row_bytes * size_t(grey.height), 77);
    for (int row = 0; row < grey.height; ++row)
      for (int column = 0; column < grey.width; ++column)
        for (int c = 0; c < channels; ++c) {  // RGBA: black, as opaque as the line is dark.
          uint8_t value = grey.at(row, column);
          if (channels == 4) value = c == 3 ? uint8_t(255 - value) : uint8_t(0);
          pixels[size_t(row) * row_bytes + size_t(column * channels + c)] = value;
        }
    daumier_face* face = nullptr;
    ASSERT_EQ(
        daumier_predict_pixels(SketchPredictor(), pixels.data(), grey.width, grey.height, channels, row_bytes, &face),
        DAUMIER_OK)
        << daumier_last_error();
    faces.push_back(VerticesOf(face));
    daumier_face_free(face);
  }
  EXPECT_GT(faces[0].size(), 30'000u);
  EXPECT_EQ(faces[0], faces[1]);
  EXPECT_EQ(faces[0], faces[2]);
}

TEST(CPrediction, AFaceOutlivesItsPredictor) {
  const render::Image portrait = render::ToRgb(render::ReadImage("docs/examples/portraits/boy.jpg"));
  daumier_predictor* predictor = nullptr;
  ASSERT_EQ(daumier_predictor_open("portrait", &predictor), DAUMIER_OK) << daumier_last_error();
  daumier_face* face = nullptr;
  ASSERT_EQ(daumier_predict_pixels(predictor, portrait.pixels.data(), portrait.width, portrait.height, 3,
                                   size_t(portrait.width) * 3, &face),
            DAUMIER_OK)
      << daumier_last_error();
  daumier_predictor_free(predictor);
  const std::vector<float> xyz = VerticesOf(face);
  EXPECT_TRUE(std::ranges::all_of(xyz, [](float value) { return std::isfinite(value) && std::abs(value) < 40; }));
  daumier_face_free(face);
}

TEST(CPrediction, FilesAreReadAsThePredictorReadsThem) {
  daumier_face* face = nullptr;
  ASSERT_EQ(daumier_predict_file(SketchPredictor(), "docs/examples/drawings/girl.svg", &face), DAUMIER_OK)
      << daumier_last_error();
  EXPECT_EQ(VerticesOf(face), FaceOf(ToC(Girl())));
  daumier_face_free(face);
  face = nullptr;
  EXPECT_EQ(daumier_predict_file(SketchPredictor(), "missing.svg", &face), DAUMIER_FAILED);
  EXPECT_NE(std::string(daumier_last_error()).find("missing.svg"), std::string::npos) << daumier_last_error();
  const testing::TempDir directory;
  ASSERT_EQ(mkfifo((directory / "pipe.svg").c_str(), 0600), 0);
  EXPECT_EQ(daumier_predict_file(SketchPredictor(), (directory / "pipe.svg").c_str(), &face), DAUMIER_FAILED);
  EXPECT_NE(std::string(daumier_last_error()).find("pipe.svg: not a file"), std::string::npos) << daumier_last_error();
  EXPECT_EQ(daumier_predict_file(SketchPredictor(), nullptr, &face), DAUMIER_MISUSED);
  EXPECT_EQ(face, nullptr);
}

TEST(CPrediction, WrongArgumentsAreMisuseAndWriteNothing) {
  CDrawing drawing = ToC(Girl());
  daumier_face* face = nullptr;
  const auto expect_misuse = [&](const daumier_strokes& strokes, const std::string& message) {
    EXPECT_EQ(daumier_predict_strokes(SketchPredictor(), &strokes, &face), DAUMIER_MISUSED);
    EXPECT_EQ(daumier_last_error(), message);
    EXPECT_EQ(face, nullptr);
  };
  daumier_strokes strokes = drawing.strokes;
  strokes.num_strokes = 0;
  expect_misuse(strokes, "strokes has 0 strokes (expected 1 or more)");
  strokes = drawing.strokes;
  strokes.width = -1;
  expect_misuse(strokes, "the sheet is -1 x " + fmt::format("{}", strokes.height) + " (expected positive numbers)");
  strokes = drawing.strokes;
  strokes.points = nullptr;
  expect_misuse(strokes, "strokes.points is NULL");
  drawing.sizes[1] = 0;
  expect_misuse(drawing.strokes, "strokes.sizes[1] is 0 (expected 1 or more)");
  drawing = ToC(Girl());
  drawing.points[2] = std::numeric_limits<float>::infinity();
  expect_misuse(drawing.strokes, "point 1 of stroke 0 is not finite");

  const std::vector<uint8_t> pixels(300, 255);
  EXPECT_EQ(daumier_predict_pixels(SketchPredictor(), pixels.data(), 10, 10, 2, 20, &face), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "the picture has 2 channels (expected 1, 3 or 4)");
  EXPECT_EQ(daumier_predict_pixels(SketchPredictor(), pixels.data(), 10, 10, 3, 29, &face), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "a row has 29 bytes (expected 30 or more)");
  EXPECT_EQ(daumier_predict_pixels(SketchPredictor(), pixels.data(), 10, 10, 3, SIZE_MAX / 2, &face), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_predict_pixels(SketchPredictor(), pixels.data(), 0, 10, 3, 30, &face), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_predict_pixels(SketchPredictor(), nullptr, 10, 10, 3, 30, &face), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_predict_pixels(nullptr, pixels.data(), 10, 10, 3, 30, &face), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "predictor is NULL");
  EXPECT_EQ(daumier_predict_pixels(SketchPredictor(), pixels.data(), 10, 10, 3, 30, nullptr), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_predict_pixels(SketchPredictor(), pixels.data(), 10, 10, 3, 30, &face),
            DAUMIER_FAILED);  // White paper.
  EXPECT_EQ(face, nullptr);
}

TEST(CPrediction, NetworksOfPicturesReadNoStrokes) {
  daumier_predictor* predictor = nullptr;
  ASSERT_EQ(daumier_predictor_open("portrait", &predictor), DAUMIER_OK) << daumier_last_error();
  const CDrawing drawing = ToC(Girl());
  daumier_face* face = nullptr;
  EXPECT_EQ(daumier_predict_strokes(predictor, &drawing.strokes, &face), DAUMIER_MISUSED);
  EXPECT_STREQ(daumier_last_error(), "the network of the task 'portrait' reads no strokes");
  daumier_predictor_free(predictor);
}

TEST(CPrediction, WeightsWithoutAPredictorAreRefused) {
  daumier_predictor* predictor = nullptr;
  EXPECT_EQ(daumier_predictor_open("no-such-weights", &predictor), DAUMIER_MISUSED);
  EXPECT_EQ(daumier_predictor_open("face-ict", &predictor), DAUMIER_MISUSED);
  EXPECT_NE(std::string(daumier_last_error()).find("the task 'face model' predicts nothing"), std::string::npos)
      << daumier_last_error();
  EXPECT_EQ(daumier_predictor_open("docs", &predictor), DAUMIER_MISUSED);
  EXPECT_EQ(predictor, nullptr);
  daumier_predictor_free(nullptr);
  daumier_face_free(nullptr);
  EXPECT_EQ(daumier_face_num_vertices(nullptr), 0u);
  EXPECT_EQ(daumier_face_num_triangles(nullptr), 0u);
  EXPECT_EQ(daumier_face_record(nullptr), nullptr);
  EXPECT_EQ(daumier_face_warning(nullptr, 0), nullptr);
}

}  // namespace
}  // namespace daumier::c_api

#include "rig/clip_json.h"

#include "rig/arkit_names.h"
#include "tests/support/expect_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace daumier::rig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

int JsonTarget(const std::string& name) {
  return FindArkitName(name).value();
}

constexpr const char* kCategories =
    R"([{"index":0,"score":0.9,"categoryName":"_neutral","displayName":""},
        {"index":25,"score":0.5,"categoryName":"jawOpen","displayName":""}])";

std::string With(std::string form, const std::string& categories = kCategories) {
  form.replace(form.find('$'), 1, categories);
  return form;
}

TEST(ClipJson, ReadsTheFormsThatProgramsSave) {
  for (const char* form : {
           R"([{"faceBlendshapes":[{"categories":$}],"faceLandmarks":[]}])",  // Results of the JavaScript interface.
           R"({"faceBlendshapes":[{"categories":$}]})",                       // One of them.
           R"([{"categories":$}])",                                           // faceBlendshapes[0] of each.
           R"([$])",                                                          // Their categories.
           R"($)",                                                            // Those of one.
           R"([[{"categories":$}]])",                                         // faceBlendshapes of each.
           R"({"frames":[{"time":0,"blendshapes":$}]})", R"({"faceBlendshapes":[$]})",
           R"([{"face_blendshapes":[$]}])",  // Of the Python interface.
       }) {
    const Recording recording = ParseClipJson(With(form), "a.json");
    ASSERT_EQ(recording.num_frames(), 1) << form;
    EXPECT_EQ(recording.weights(0, JsonTarget("jawOpen")), 0.5f) << form;
    EXPECT_EQ(recording.weights.sum(), 0.5f) << form;
    EXPECT_THAT(recording.warnings, Contains(HasSubstr("51 of 52 targets are missing")));
    EXPECT_THAT(recording.warnings, Not(Contains(HasSubstr("unknown"))));
  }
  const Recording snake =
      ParseClipJson(R"([{"face_blendshapes":[[{"category_name":"jawOpen","score":0.5}]]}])", "a.json");
  EXPECT_EQ(snake.weights(0, JsonTarget("jawOpen")), 0.5f);
}

TEST(ClipJson, ReadsPlainWeights) {
  for (const char* text :
       {R"([{"jawOpen":0.5,"t":0},{"jawOpen":1,"eyeBlink_L":0.25,"t":0.5}])",
        R"({"fps":2,"frames":[{"weights":{"JawOpen":0.5}},{"weights":{"jawOpen":1,"eyeBlinkLeft":0.25}}]})",
        "{\"time_ms\":0,\"jawOpen\":0.5}\n{\"time_ms\":500,\"jawOpen\":1,\"eyeBlinkLeft\":0.25}\n"}) {
    const Recording recording = ParseClipJson(text, "a.json");
    ASSERT_EQ(recording.num_frames(), 2) << text;
    EXPECT_EQ(recording.seconds[1], 0.5) << text;
    EXPECT_EQ(recording.weights(0, JsonTarget("jawOpen")), 0.5f) << text;
    EXPECT_EQ(recording.weights(1, JsonTarget("eyeBlinkLeft")), 0.25f) << text;
    EXPECT_EQ(recording.weights(0, JsonTarget("eyeBlinkLeft")), 0.0f) << text;
  }
}

TEST(ClipJson, TakesTimesFromFramesOrFromNextToThem) {
  const auto last = [](const std::string& text) { return ParseClipJson(text, "a.json").seconds.back(); };
  EXPECT_NEAR(last(R"([{"jawOpen":0,"timestamp":1000},{"jawOpen":0,"timestamp":1040}])"), 0.04, 1e-12);
  EXPECT_NEAR(last(R"([{"jawOpen":0,"timestampMs":0},{"jawOpen":0,"timestampMs":0.5}])"), 0.0005, 1e-12);
  EXPECT_NEAR(last(R"({"timestamps":[0,40000],"frames":[{"jawOpen":0},{"jawOpen":0}]})"), 0.04, 1e-12);
  EXPECT_NEAR(last(R"([{"jawOpen":0},{"jawOpen":0}])"), 1.0 / 30, 1e-12);
  EXPECT_THAT(ParseClipJson(R"([{"jawOpen":0,"t":1},{"jawOpen":0}])", "a.json").warnings,
              Contains("frame 2 states no time: 30 frames a second are assumed"));
}

TEST(ClipJson, SkipsFramesWithoutAFaceAndReadsTheFirstOfSeveral) {
  const Recording recording = ParseClipJson(
      With(
          R"([{"faceBlendshapes":[]},null,{"faceBlendshapes":[{"categories":$},{"categories":[{"categoryName":"jawOpen","score":1}]}]}])"),
      "a.json");
  ASSERT_EQ(recording.num_frames(), 1);
  EXPECT_EQ(recording.weights(0, JsonTarget("jawOpen")), 0.5f);
  EXPECT_THAT(recording.warnings, Contains("2 frames without a face are skipped"));
  EXPECT_THAT(recording.warnings, Contains("1 frame has several faces, of which the first is read"));
}

/// A turn of 0.3 to the head's left, R_y, with a scale of 1.1 and a translation, in each form of a matrix.
TEST(ClipJson, TurnsTheHeadByTheMatrix) {
  const double c = 1.1 * std::cos(0.3), s = 1.1 * std::sin(0.3);
  const std::string columns = fmt::format("[{},0,{},0, 0,1.1,0,0, {},0,{},0, 1,2,-40,1]", c, -s, s, c);
  const std::string rows = fmt::format("[[{},0,{},1],[0,1.1,0,2],[{},0,{},-40],[0,0,0,1]]", c, s, -s, c);
  const std::string keyed = fmt::format(
      R"({{"0":{},"1":0,"2":{},"3":0,"4":0,"5":1.1,"6":0,"7":0,"8":{},"9":0,"10":{},"11":0,"12":1,"13":2,"14":-40,"15":1}})",
      c, -s, s, c);
  for (const std::string& matrix : {R"({"rows":4,"columns":4,"data":)" + columns + "}", columns, rows, keyed}) {
    const Recording recording =
        ParseClipJson(fmt::format(R"([{{"jawOpen":0,"facialTransformationMatrixes":[{}]}}])", matrix), "a.json");
    ASSERT_EQ(recording.head.rows(), 1) << matrix;
    EXPECT_TRUE(recording.head.isApprox(Eigen::RowVector3f(0, 0.3f, 0), 1e-5f)) << matrix << recording.head;
  }
}

TEST(ClipJson, ErrorsNameTheFrame) {
  const auto expect = [](const std::string& text, const std::string& part) {
    testing::ExpectError([&] { ParseClipJson(text, "a.json"); }, part);
  };
  expect("[{\"jawOpen\": 0},", "a.json: not JSON");
  expect("[]", "a.json: contains no frame");
  expect(R"([{"jawOpen":0},{"jawOpen":"wide"}])", "a.json: frame 2: jawOpen is \"wide\" (expected a number");
  expect("[1, 2]", "a.json: frame 1: is 1 (expected categories");
  expect(R"([{"categories":[{"categoryName":"jawOpen","score":1},{"a":1}]}])", "frame 1: {\"a\":1} is no category");
  expect(R"([{"faceBlendshapes":[]}])", "contains no weight of an ARKit target");
  expect(R"([{"a":1}])", "found a)");
}

}  // namespace
}  // namespace daumier::rig

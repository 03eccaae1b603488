#include "render/inkml.h"

#include "core/log.h"
#include "core/random.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExpectError;
using InkPoints = std::vector<std::array<float, 2>>;

std::string InkFile(const std::string& content) {
  return "<?xml version=\"1.0\"?>\n<ink xmlns=\"http://www.w3.org/2003/InkML\">\n" + content + "</ink>\n";
}

class InkMlTest : public ::testing::Test {
 protected:
  Drawing Read(const std::string& bytes) {
    testing::WriteQuickly(path_, bytes);
    return ReadInkMl(path_);
  }

  testing::TempDir folder_;
  std::filesystem::path path_ = folder_ / "page.inkml";
};

TEST_F(InkMlTest, ReadsTracesYDownFromTheirBoundingBox) {
  const std::string text = InkFile("<trace>10 -5, 30 45</trace><trace>20 0, 20 20</trace>");
  EXPECT_TRUE(IsInkMl(text));
  const Drawing drawing = Read(text);
  EXPECT_EQ(drawing.width, 20);
  EXPECT_EQ(drawing.height, 50);
  ASSERT_EQ(drawing.strokes.size(), 2U);
  EXPECT_EQ(drawing.strokes[0].points, (InkPoints{{0, 0}, {20, 50}}));
  EXPECT_EQ(drawing.strokes[1].points, (InkPoints{{10, 5}, {10, 25}}));
}

TEST_F(InkMlTest, ReadsGroupsAndPrefixedNames) {
  const Drawing drawing = Read(
      "<inkml:ink xmlns:inkml=\"http://www.w3.org/2003/InkML\"><inkml:traceGroup><inkml:trace>0 0,1 1</inkml:trace>"
      "<inkml:traceGroup><inkml:trace>2 2</inkml:trace></inkml:traceGroup></inkml:traceGroup></inkml:ink>");
  EXPECT_EQ(drawing.strokes.size(), 2U);
}

// As writers of office programs state it: the format belongs to the source of a context.
TEST_F(InkMlTest, TakesTheChannelsOfTheContext) {
  const std::string definitions = R"(<definitions>
  <context xml:id="ctx0"><inkSource xml:id="src0"><traceFormat>
    <channel name="F" type="integer"/><channel name="Y" type="integer"/><channel name="X" type="integer"/>
  </traceFormat></inkSource></context>
  <trace id="defined">0 0,1 1</trace></definitions>)";
  const Drawing drawing = Read(InkFile(definitions + "<trace contextRef=\"#ctx0\">99 1 2, 98 3 5</trace>"));
  ASSERT_EQ(drawing.strokes.size(), 1U) << "traces of definitions are not drawn";
  EXPECT_EQ(drawing.strokes[0].points, (InkPoints{{0, 0}, {3, 2}}));
  // In a stream a context holds from where it is.
  const Drawing stream =
      Read(InkFile("<context><traceFormat><channel name=\"Y\" orientation=\"-ve\"/><channel name=\"X\"/>"
                   "</traceFormat></context><trace>1 2, 3 5</trace>"));
  EXPECT_EQ(stream.strokes[0].points, (InkPoints{{0, 2}, {3, 0}}));
}

TEST_F(InkMlTest, LeavesOutErasersWhiteInkAndHighlighters) {
  testing::AllowWarnings();
  const auto brush = [](const std::string& id, const std::string& name, const std::string& value) {
    return "<brush xml:id=\"" + id + "\"><brushProperty name=\"" + name + "\" value=\"" + value + "\"/></brush>";
  };
  const std::string definitions = "<definitions>" + brush("pen", "color", "#102030") +
                                  brush("white", "color", "#FFFFFF") + brush("marker", "rasterOp", "maskPen") +
                                  brush("clear", "transparency", "200") + brush("rubber", "tip", "eraser") +
                                  "</definitions>";
  std::string traces = "<trace type=\"penUp\">0 0,9 9</trace>";
  for (const char* id : {"pen", "white", "marker", "clear", "rubber"})
    traces += std::string("<trace brushRef=\"#") + id + "\">0 0,1 1</trace>";
  traces +=
      "<traceGroup brushRef=\"#rubber\"><trace>0 0,1 1</trace><trace brushRef=\"#pen\">0 0,1 1</trace></traceGroup>";
  const int before = log::NumWarnings();
  EXPECT_EQ(Read(InkFile(definitions + traces)).strokes.size(), 2U);
  EXPECT_EQ(log::NumWarnings(), before + 1) << "of the highlighter alone";
}

TEST_F(InkMlTest, ErrorsNameFileAndCause) {
  ExpectError([&] { Read(InkFile("")); }, "page.inkml: the file holds no traces of a pen");
  ExpectError([&] { Read(InkFile("<trace>1 x</trace>")); }, "page.inkml: 'x' is not a value of a trace");
  ExpectError([&] { Read("<svg/>"); }, "page.inkml: the outermost element is <svg>, expected <ink>");
  ExpectError([&] { Read("<ink><trace>"); }, "page.inkml: not XML, or truncated");
  ExpectError([&] { Read(InkFile("<traceFormat><channel name=\"X\"/></traceFormat>")); }, "no channel Y");
  ExpectError([&] { Read(InkFile("<context xml:id=\"a\" contextRef=\"#a\"/><trace contextRef=\"#a\">0 0</trace>")); },
              "in a circle");
  std::string deep;
  for (int i = 0; i < 300; ++i) deep += "<traceGroup>";
  for (int i = 0; i < 300; ++i) deep += "</traceGroup>";
  ExpectError([&] { Read(InkFile(deep)); }, "deep");
  EXPECT_FALSE(IsInkMl("<svg/>"));
}

TEST_F(InkMlTest, SurvivesDamagedFiles) {
  const std::string bytes =
      InkFile("<brush xml:id=\"b\"/><traceGroup brushRef=\"#b\"><trace>1 2,'3'4</trace></traceGroup>");
  const auto read = [&] { ReadInkMl(path_); };
  EXPECT_GT(testing::CountRefusedTruncations(path_, bytes, read), static_cast<int>(bytes.size()) - 3);
  Rng rng(3);
  testing::CountRefusedFlips(path_, bytes, 500, rng, read);
}

}  // namespace
}  // namespace daumier::render

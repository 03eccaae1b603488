#include "render/xournal.h"

#include "core/log.h"
#include "core/random.h"
#include "tests/render/gzipped.h"
#include "tests/support/corruption.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using testing::ExpectError;
using XournalPoints = std::vector<std::array<float, 2>>;

/// As Xournal++ 1.2 writes documents: ruled paper, a width a point where the pen has pressure.
std::string Document(const std::string& pages) {
  return R"(<?xml version="1.0" standalone="no"?>
<xournal creator="xournalpp 1.2.2" fileversion="4">
<title>Xournal++ document - see https://github.com/xournalpp/xournalpp</title>
<preview>iVBORw0KGgo=</preview>
)" + pages +
         "</xournal>\n";
}
std::string Page(const std::string& elements) {
  return R"(<page width="595.27" height="841.89">
<background type="solid" color="#ffffffff" style="ruled"/>
<layer>)" +
         elements + "</layer>\n</page>\n";
}
const std::string kPenStroke =
    R"(<stroke tool="pen" ts="0" fn="" color="#000000ff" width="1.41 0.92 1.05" capStyle="round">10.5 20 30 40.25 50 60</stroke>)";

class XournalTest : public ::testing::Test {
 protected:
  Drawing Read(const std::string& bytes) {
    testing::WriteQuickly(path_, bytes);
    return ReadXournal(path_);
  }

  testing::TempDir folder_;
  std::filesystem::path path_ = folder_ / "notes.xopp";
};

TEST_F(XournalTest, ReadsPenStrokesCompressedOrNot) {
  const std::string text =
      Document(Page(kPenStroke + "<stroke tool=\"pen\" color=\"blue\" width=\"2\">1 2 3 4</stroke>"));
  for (const std::string& bytes : {text, testing::Gzipped(text)}) {
    EXPECT_TRUE(IsXournal(bytes));
    const Drawing drawing = Read(bytes);
    EXPECT_EQ(drawing.width, 595.27);
    EXPECT_EQ(drawing.height, 841.89);
    ASSERT_EQ(drawing.strokes.size(), 2U);
    EXPECT_EQ(drawing.strokes[0].points, (XournalPoints{{10.5F, 20}, {30, 40.25F}, {50, 60}}));
    EXPECT_EQ(drawing.strokes[1].points, (XournalPoints{{1, 2}, {3, 4}}));
  }
}

TEST_F(XournalTest, LeavesOutWhatIsNoInk) {
  const std::string eraser = "<stroke tool=\"eraser\" color=\"#000000ff\" width=\"9\">1 1 2 2</stroke>",
                    white = "<stroke tool=\"pen\" color=\"#FFFFFFFF\" width=\"9\">1 1 2 2</stroke>",
                    named = "<stroke tool=\"pen\" color=\"white\" width=\"9\">1 1 2 2</stroke>",
                    empty = "<stroke tool=\"pen\" color=\"#000000ff\" width=\"9\"></stroke>";
  EXPECT_EQ(Read(Document(Page(eraser + white + named + empty + kPenStroke))).strokes.size(), 1U);
  // White ink on black paper is ink, black ink is not.
  const std::string dark = "<page width=\"9\" height=\"9\"><background type=\"solid\" color=\"#000000ff\"/><layer>" +
                           white + kPenStroke + "</layer></page>";
  EXPECT_EQ(Read(Document(dark)).strokes.at(0).points, (XournalPoints{{1, 1}, {2, 2}}));
}

TEST_F(XournalTest, ReadsAllLayersOfTheFirstPageWithInk) {
  const std::string layers =
      "<page width=\"9\" height=\"9\"><layer>" + kPenStroke + "</layer><layer>" + kPenStroke + "</layer></page>";
  EXPECT_EQ(Read(Document(Page("") + layers)).strokes.size(), 2U);
  testing::AllowWarnings();
  const int before = log::NumWarnings();
  EXPECT_EQ(Read(Document(Page("") + layers + Page(kPenStroke))).strokes.size(), 2U);
  EXPECT_EQ(log::NumWarnings(), before + 1) << "two pages have strokes";
}

TEST_F(XournalTest, WarnsOfTextsPicturesAndHighlighters) {
  testing::AllowWarnings();
  const int before = log::NumWarnings();
  const Drawing drawing =
      Read(Document(Page("<text font=\"Sans\" size=\"12\" x=\"1\" y=\"1\" color=\"#000000ff\">a</text>"
                         "<image left=\"0\" top=\"0\" right=\"1\" bottom=\"1\">iVBORw0KGgo=</image>"
                         "<stroke tool=\"highlighter\" color=\"#ffff007f\" width=\"8\">1 1 2 2</stroke>" +
                         kPenStroke)));
  EXPECT_EQ(drawing.strokes.size(), 1U);
  EXPECT_EQ(log::NumWarnings(), before + 1);
}

TEST_F(XournalTest, ErrorsNameFileAndCause) {
  ExpectError([&] { Read(Document(Page(""))); }, "notes.xopp: none of its 1 pages has strokes of a pen");
  ExpectError([&] { Read(Document("")); }, "none of its 0 pages");
  ExpectError([&] { Read("<svg/>"); }, "notes.xopp: the outermost element is <svg>, expected <xournal>");
  ExpectError([&] { Read(Document(Page("<stroke tool=\"pen\">1 2 3</stroke>"))); },
              "notes.xopp: a <stroke> has 3 numbers");
  ExpectError([&] { Read(Document(Page("<stroke tool=\"pen\">1 x</stroke>"))); }, "'x' is not a finite number");
  ExpectError([&] { Read("<xournal><page>"); }, "notes.xopp: not XML, or truncated");
  ExpectError([&] { ReadXournal(folder_ / "absent.xopp"); }, "absent.xopp");
  EXPECT_FALSE(IsXournal("<svg/>"));
  EXPECT_FALSE(IsXournal("\x1f\x8b damaged"));
}

TEST_F(XournalTest, SurvivesDamagedFiles) {
  const std::string bytes = testing::Gzipped(Document(Page(kPenStroke)));
  const auto read = [&] { ReadXournal(path_); };
  EXPECT_EQ(testing::CountRefusedTruncations(path_, bytes, read), static_cast<int>(bytes.size()));
  Rng rng(3);
  EXPECT_GT(testing::CountRefusedFlips(path_, bytes, 300, rng, read), 200);
}

}  // namespace
}  // namespace daumier::render

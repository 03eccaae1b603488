#include "render/foreign_formats.h"

#include "core/random.h"
#include "tests/render/oriented_pictures.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

using namespace std::string_literals;

std::string FileOfBoxes(const std::string& brands) {
  return testing::BigEndian(uint32_t(8 + brands.size()), 4) + "ftyp" + brands;
}
std::string ZipWith(const std::string& entry) {
  return "PK\3\4\x14\0\0\0\0\0"s + std::string(20, '\0') + entry;
}

TEST(RefuseForeignFormat, NamesTheFormatAndTheWayOut) {
  struct Case {
    std::string bytes, what, way_out;
  };
  const std::vector<Case> cases = {
      {FileOfBoxes("heic\0\0\0\0mif1heic"s), "a HEIC picture", "heif-convert"},
      {FileOfBoxes("mif1\0\0\0\0mif1heic"s), "a HEIC picture", "PNG"},
      {FileOfBoxes("avif\0\0\0\0avifmif1"s), "an AVIF picture", "avifdec"},
      {FileOfBoxes("mif1\0\0\0\0mif1avif"s), "an AVIF picture", "avifdec"},
      {FileOfBoxes("isom\0\0\2\0isommp41"s), "a movie", "ffmpeg"},
      {FileOfBoxes("qt  \0\0\0\0qt  "s), "a movie", "ffmpeg"},
      {"%PDF-1.7\n%....", "a PDF", "pdftocairo -svg"},
      {"# Blender\nmtllib a.mtl\no Head\nv 1 2 3\n", "a mesh", "daumier draw"},
      {"v -0.5 2 3\r\nv 1 2 3\r\n", "a mesh", "daumier draw"},
      {"ply\nformat ascii 1.0\n", "a mesh", "daumier draw"},
      {"solid head\nfacet normal 0 0 1\n", "a mesh", "daumier draw"},
      {"glTF\2\0\0\0"s, "a mesh", "daumier draw"},
      {"%PDF-1.6\n<< /AIPrivateData1 7 0 R >>", "an Illustrator drawing", "SVG"},
      {"%!PS-Adobe-3.0 EPSF-3.0\n%%Creator: Adobe Illustrator", "PostScript", "inkscape"},
      {"%!PS-Adobe-3.0\n%%Creator: Adobe Illustrator(R) 8", "an Illustrator drawing", "SVG"},
      {"\xC5\xD0\xD3\xC6 ...", "PostScript", "inkscape"},
      {"8BPS\0\1"s, "a Photoshop picture", "PNG"},
      {"GIF89a\1\0\1\0"s, "a GIF", "magick"},
      {"RIFF\x20\0\0\0WEBPVP8X\x0A\0\0\0\2\0\0\0"s, "an animated WebP", "PNG"},
      {"\0\0\0\x0CJXL \r\n\x87\n"s, "a JPEG XL picture", "djxl"},
      {"{\n  \"type\": \"excalidraw\",\n  \"version\": 2, \"elements\": []}", "an Excalidraw drawing", "Export image"},
      {"\xEF\xBB\xBF{\"tldrawFileFormatVersion\":1}", "a tldraw drawing", "SVG"},
      {"<mxfile host=\"app.diagrams.net\">", "a draw.io diagram", "SVG"},
      {"fig-kiwi\x0F"s, "a Figma document", "Export"},
      {ZipWith("canvas.fig"), "a Figma document", "SVG"},
      {ZipWith("document.json...pages/7A.json"), "a document of Sketch", "SVG"},
      {ZipWith("Document.archive"), "a Procreate drawing", "PNG"},
      {ZipWith("mimetypeapplication/x-krita"), "a Krita picture", "PNG"},
      {ZipWith("word/document.xml"), "an office document", "pdftocairo"},
      {ZipWith("mimetypeapplication/vnd.oasis.opendocument.graphics"), "an office document", "SVG"},
      {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1 ", "an office document", "SVG"},
      {ZipWith("face.svg"), "a ZIP archive", "Unpack"},
      {"<!DOCTYPE html><html><body>", "a web page", "Download"},
      {"\0\x05\x16\x07\0\2\0\0Mac OS X"s, "a companion file of macOS", "._"},
      {"\xD7\xCD\xC6\x9A\0\0"s, "a Windows metafile", "inkscape"},
  };
  for (const auto& [bytes, what, way_out] : cases) {
    testing::ExpectError([&bytes = bytes] { RefuseForeignFormat(bytes, "face.x"); }, "face.x: this is " + what);
    testing::ExpectError([&bytes = bytes] { RefuseForeignFormat(bytes, "face.x"); }, way_out);
  }
}

TEST(RefuseForeignFormat, AcceptsWhatIsReadAndWhatIsUnknown) {
  for (const char* extension : {".png", ".jpg", ".webp", ".bmp", ".tiff"})
    EXPECT_NO_THROW(RefuseForeignFormat(testing::Encoded(extension, testing::SixBlocks()), extension));
  for (const std::string& text :
       {""s, "<svg xmlns=\"http://www.w3.org/2000/svg\"><desc>%PDF-1.4</desc></svg>"s, "{\"drawing\":[[[0],[0]]]}"s,
        "<ink/>"s, "some text"s, "v for victory"s, "o\n"s, "<"s, "PK"s, "RIFF"s, "\0\0"s})
    EXPECT_NO_THROW(RefuseForeignFormat(text, "file"));
}

TEST(RefuseForeignFormat, TakesAnyBytes) {
  Rng rng(2);
  for (int i = 0; i < 3000; ++i) {
    std::string bytes = i % 3 == 0 ? FileOfBoxes("heic") : i % 3 == 1 ? "RIFF\x20\0\0\0WEBPVP8X\x0A"s : ZipWith("a");
    bytes.resize(rng.Below(bytes.size() + 1));
    if (!bytes.empty()) bytes[rng.Below(bytes.size())] = char(rng.Below(256));
    try {
      RefuseForeignFormat(bytes, "file");
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace daumier::render

#include "render/foreign_formats.h"

#include "core/error.h"
#include "render/jpeg.h"

#include <algorithm>
#include <array>
#include <optional>

namespace daumier::render {
namespace {

using namespace std::string_view_literals;

struct ForeignFormat {
  std::string_view what, way_out;
};

/// A format whose files hold a text at a place.
struct Signature {
  size_t at;
  std::string_view text;
  ForeignFormat format;
};

constexpr std::string_view kPaint = "Export it as PNG in the program that wrote it";
constexpr ForeignFormat kHeic{
    "a HEIC picture (HEIF)",
    "Export it as PNG or JPEG: heif-convert IN.heic OUT.png, or on an iPhone 'Most Compatible' "
    "under Settings, Camera, Formats"},
    kAvif{"an AVIF picture", "Convert it to PNG: avifdec IN.avif OUT.png"},
    kRawPhoto{"a raw photograph of a camera", "Export it as JPEG or PNG"},
    kMovie{"a movie", "Export one of its frames as PNG: ffmpeg -i IN -frames:v 1 OUT.png"},
    kPdf{"a PDF",
         "Convert a page of lines to SVG: pdftocairo -svg IN.pdf OUT.svg; of a scan to PNG: pdftoppm -png -r 200 "
         "IN.pdf OUT"},
    kIllustrator{"an Illustrator drawing", "Save it as SVG (File, Save As, SVG)"},
    kPostScript{"PostScript (EPS)",
                "Convert it to SVG: inkscape IN.eps --export-filename=OUT.svg, or export SVG where it was made"},
    kPhotoshop{"a Photoshop picture", "Export it as PNG (File, Export, Quick Export as PNG)"},
    kGif{"a GIF", "Convert its first frame to PNG: magick 'IN.gif[0]' OUT.png"},
    kAnimatedWebp{"an animated WebP", "Export one of its frames as PNG: magick 'IN.webp[0]' OUT.png"},
    kJpegXl{"a JPEG XL picture", "Convert it to PNG: djxl IN.jxl OUT.png"},
    kExcalidraw{"an Excalidraw drawing", "Export it as SVG or PNG (menu, Export image), without background"},
    kTldraw{"a tldraw drawing", "Export it as SVG or PNG (menu, Export as)"},
    kFigma{"a Figma document", "Export the frame as SVG or PNG (Export, in the right sidebar)"},
    kSketch{"a document of Sketch", "Export the artboard as SVG or PNG (Make Exportable)"},
    kProcreate{"a Procreate drawing", "Share it as PNG (Actions, Share, PNG)"},
    kOffice{"an office document",
            "Save the drawing in it as SVG or PNG (right click, Save as Picture), or export the page "
            "as PDF and convert that: pdftocairo -svg IN.pdf OUT.svg"},
    kMesh{"a mesh", "Name a drawing of a face; `daumier draw IN --out OUT.svg` makes one of an OBJ or PLY mesh"},
    kZip{"a ZIP archive", "Unpack it first and name the drawings in it"},
    kMetafile{"a Windows metafile (WMF or EMF)", "Convert it to SVG: inkscape IN --export-filename=OUT.svg"};

constexpr std::array kSignatures{
    Signature{0, "GIF87a", kGif},
    Signature{0, "glTF", kMesh},
    Signature{0, "Kaydara FBX Binary", kMesh},
    Signature{0, "ply\n", kMesh},
    Signature{0, "ply\r\n", kMesh},
    Signature{0, "GIF89a", kGif},
    Signature{0, "8BPS", kPhotoshop},
    Signature{0, "%!PS"sv, kPostScript},
    Signature{0, "\xC5\xD0\xD3\xC6"sv, kPostScript},
    Signature{0, "\0\0\0\x0CJXL "sv, kJpegXl},
    Signature{0, "\xFF\x0A"sv, kJpegXl},
    Signature{0, "\0\0\0\x0CjP  "sv, {"a JPEG 2000 picture", "Convert it to PNG: opj_decompress -i IN.jp2 -o OUT.png"}},
    Signature{0, "fig-kiwi", kFigma},
    Signature{0, "fig-jam.", kFigma},
    Signature{0, "gimp xcf", {"a GIMP picture", "Export it as PNG (File, Export As)"}},
    Signature{0, "CSFCHUNK", {"a Clip Studio picture", "Export it as PNG (File, Export single layer)"}},
    Signature{0, "\0\xFFKA"sv, {"an Affinity document", "Export it as SVG or PNG (File, Export)"}},
    Signature{8, "CDR", {"a CorelDRAW document", "Export it as SVG (File, Export)"}},
    Signature{0, "\xD7\xCD\xC6\x9A"sv, kMetafile},
    Signature{40, " EMF", kMetafile},
    Signature{0, "\0\0\1\0"sv, {"an icon (ICO)", "Convert it to PNG: icotool -x IN.ico"}},
    Signature{0, "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv, kOffice},
    Signature{0, "{\\rtf", kOffice},
    Signature{0,
              "\xE4\x52\x5C\x7B\x8C\xD8\xA7\x4D"sv,
              {"a OneNote section",
               "Export the page as PDF, then: pdftocairo -svg "
               "IN.pdf OUT.svg"}},
    Signature{0,
              "\0\x05\x16\x07"sv,
              {"a companion file of macOS (AppleDouble)", "Name the file without '._' before its name"}},
    Signature{0, "SQLite format 3", {"a database", kPaint}},
    Signature{0, "\x1A\x45\xDF\xA3"sv, kMovie},
};

/// Archives by the name of an entry, or by the content of the entry "mimetype".
constexpr std::array kArchives{
    Signature{0, "canvas.fig", kFigma},
    Signature{0, "Document.archive", kProcreate},
    Signature{0, "word/document", kOffice},
    Signature{0, "ppt/presentation", kOffice},
    Signature{0, "xl/workbook", kOffice},
    Signature{0, "application/vnd.oasis.opendocument", kOffice},
    Signature{0, "application/x-krita", {"a Krita picture", "Export it as PNG (File, Export)"}},
    Signature{0, "image/openraster", {"an OpenRaster picture", kPaint}},
    Signature{0,
              "Index/Document.iwa",
              {"a document of Keynote, Pages or Numbers",
               "Export it as PDF, then: pdftocairo -svg "
               "IN.pdf OUT.svg"}},
    Signature{0, "pages/", kSketch},
};

bool Holds(std::string_view bytes, std::string_view text) {
  return bytes.find(text) != std::string_view::npos;
}

/// Of a file of boxes [ISO/IEC 14496-12] by its brand.
std::optional<ForeignFormat> FormatOfBoxes(std::string_view bytes) {
  if (bytes.substr(0, 8).substr(std::min<size_t>(bytes.size(), 4)) != "ftyp" || bytes.size() < 12) return std::nullopt;
  const size_t size = std::min<size_t>(static_cast<unsigned char>(bytes[3]), bytes.size());
  const std::string_view brands = bytes.substr(8, std::max<size_t>(size, 12) - 8), brand = brands.substr(0, 4);
  if (brand == "avif" || brand == "avis" || (brand == "mif1" && Holds(brands, "avif"))) return kAvif;
  if (brand == "crx ") return kRawPhoto;
  for (const std::string_view heif : {"hei", "hev", "mif", "msf"})
    if (brand.starts_with(heif)) return kHeic;
  return kMovie;
}

std::optional<ForeignFormat> FormatOfArchive(std::string_view bytes) {
  if (!bytes.starts_with("PK\3\4") && !bytes.starts_with("PK\5\6")) return std::nullopt;
  for (const Signature& archive : kArchives)
    if (Holds(bytes, archive.text)) return archive.format;
  return kZip;
}

/// Whether text is a Wavefront OBJ file, or an STL file, by its first lines.
bool IsMeshText(std::string_view text) {
  if (text.starts_with("solid") && Holds(text, "facet normal")) return true;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const auto begins_with = [&](std::string_view word) {
      return line.starts_with(word) && line.size() > word.size() &&
             (line[word.size()] == ' ' || line[word.size()] == '\t');
    };
    const auto any_of = [&](auto... words) { return (begins_with(words) || ...); };
    if (any_of("v", "vt", "vn", "f")) {
      const size_t value = line.find_first_not_of(" \t", 2);
      return value != std::string_view::npos &&
             std::string_view("+-.0123456789").find(line[value]) != std::string_view::npos;
    }
    const bool says_nothing = line.find_first_not_of(" \t\r") == std::string_view::npos || line.starts_with('#');
    if (!says_nothing && !any_of("mtllib", "usemtl", "o", "g", "s")) return false;
  }
  return false;
}

/// Of text that begins as one of these formats does, after white space and a byte order mark.
std::optional<ForeignFormat> FormatOfText(std::string_view bytes) {
  constexpr size_t kHead = 4096;
  std::string_view text = bytes.substr(0, kHead);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (IsMeshText(text)) return kMesh;
  if (text.starts_with("{")) {
    if (Holds(text, "\"excalidraw")) return kExcalidraw;
    if (Holds(text, "\"tldraw")) return kTldraw;
  }
  if (text.starts_with("<")) {
    const std::string_view element = text.substr(0, 512);
    if (Holds(element, "<mxfile") || Holds(element, "<mxGraphModel"))
      return ForeignFormat{"a draw.io diagram", "Export it as SVG (File, Export as, SVG)"};
    for (const std::string_view page : {"<!DOCTYPE html", "<!doctype html", "<html", "<HTML"})
      if (element.starts_with(page))
        return ForeignFormat{"a web page", "Download the drawing itself, as SVG or PNG, not the page that shows it"};
  }
  return std::nullopt;
}

std::optional<ForeignFormat> FormatOf(std::string_view bytes) {
  constexpr size_t kPdfHead = 1024;
  const std::string_view head = bytes.substr(0, kPdfHead);
  const bool may_be_pdf = !bytes.starts_with("<") && !bytes.starts_with("\x89PNG") && !IsJpeg(bytes);
  if (may_be_pdf && Holds(head, "%PDF-")) {
    // Illustrator's own files are PDF with its data inside.
    return Holds(bytes, "/AIPrivateData") || Holds(bytes, "/AIMetaData") ? kIllustrator : kPdf;
  }
  if (Holds(head, "%!PS") && Holds(head, "Adobe Illustrator") && !Holds(head, "EPSF")) return kIllustrator;
  for (const Signature& signature : kSignatures)
    if (signature.at < bytes.size() && bytes.substr(signature.at).starts_with(signature.text)) return signature.format;
  constexpr size_t kWebpFlags = 20;
  if (bytes.starts_with("RIFF") && bytes.size() > kWebpFlags && bytes.substr(8, 8) == "WEBPVP8X" &&
      (static_cast<unsigned char>(bytes[kWebpFlags]) & 2) != 0)
    return kAnimatedWebp;
  if (const auto format = FormatOfBoxes(bytes)) return format;
  if (const auto format = FormatOfArchive(bytes)) return format;
  return FormatOfText(bytes);
}

}  // namespace

void RefuseForeignFormat(std::string_view bytes, const std::string& name) {
  const auto format = FormatOf(bytes);
  DAUMIER_CHECK(
      !format, "{}: this is {} (expected SVG, Xournal++, InkML, Quick, Draw! ndjson, PNG, JPEG, WebP, BMP or TIFF). {}",
      name, format->what, format->way_out);
}

}  // namespace daumier::render

#pragma once
#include "render/drawing.h"

#include <filesystem>
#include <string_view>

namespace daumier::render {

/// Whether bytes are a Xournal++ document: XML whose outermost element is <xournal>, compressed by gzip or not.
bool IsXournal(std::string_view bytes);

/// The pen strokes of a page of a Xournal++ (.xopp) or Xournal (.xoj) document, of all its layers, in points of the
/// page. Of several pages the first with pen strokes is read; a warning says which if others have some as well. The
/// paper's lines and the picture or PDF behind the page are no ink. Left out, with a warning where there are any: texts,
/// pictures, strokes of the highlighter. Left out silently: strokes of the eraser and in the colour of the paper. Widths
/// of strokes are not read. All strokes are of kind 0.
/// @throws Error naming the file and the cause: damaged or truncated, not XML, no such document, larger than 256 MB, a
/// stroke that is no list of pairs of finite numbers, no strokes.
Drawing ReadXournal(const std::filesystem::path& path);

}  // namespace daumier::render

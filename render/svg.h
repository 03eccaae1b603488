#pragma once
#include "render/drawing.h"
#include "render/weighted_strokes.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::render {

/// Strokes on the canvas of kSketchCanvas as an SVG, atomic: a <path> a stroke, its class the name of its kind, black,
/// 1.5 wide, with round ends. ReadSvg with the same names gives the same strokes, every float exact; strokes without
/// points are left out, a stroke whose points all coincide comes back as one point, and what ReadSvg takes for a frame,
/// or leaves out far from the canvas, does not come back.
/// @throws Error naming the file if it cannot be written, a kind has no name, a name holds white space, or a coordinate
/// is not finite.
void WriteSvg(const std::filesystem::path& path, const std::vector<Stroke>& strokes,
              const std::vector<std::string>& kind_names);
/// The same with widths: a <path> for each of PartsByWidth. ReadSvg gives the parts, without their widths.
/// @throws Error as WriteSvg and PartsByWidth.
void WriteWeightedSvg(const std::filesystem::path& path, const std::vector<WeightedStroke>& strokes,
                      const std::vector<std::string>& kind_names);

/// The lines that a viewer of an SVG sees [SVG 1.1; SVG 2], plain or gzip: of path, polyline, polygon, line, rect,
/// circle and ellipse, in the pixels of width and height (else those of the viewBox, else as far as the strokes reach).
/// Curves are flattened to a tenth of a pixel of a 256 canvas. A stroke's kind is the place of the first word of its
/// class, or else of its groups' classes, that kind_names holds; 0 where there is none.
///   structure  groups, <use>, <symbol>, nested <svg>, <switch>, clip paths, any prefix, entities of a DOCTYPE
///              (render/svg_scene.h, render/svg_document.h)
///   style      attributes, style sheets (render/svg_css.h), style attributes and their cascade (render/svg_style.h)
///   ink        strokes, and outlines of areas without stroke, of another colour than what lies below, where nothing
///              hides them; neither the sheet nor its frame (render/svg_ink.h)
/// A path is read up to its first error. What is left out or only approximated is a warning that names its place: text,
/// pictures, masks, patterns, filters, markers, foreign objects, elements with errors.
/// @throws Error naming the file, and where it applies element and line: not XML, truncated, not an SVG, a <use> that
/// contains itself, more than a drawing can have, no strokes (with the first cause).
Drawing ReadSvg(const std::filesystem::path& path, const std::vector<std::string>& kind_names = {});

}  // namespace daumier::render

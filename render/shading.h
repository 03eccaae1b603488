#pragma once
#include "geometry/mesh.h"
#include "render/camera.h"
#include "render/image.h"

#include <array>
#include <memory>
#include <vector>

namespace daumier::render {

/// What is drawn: a surface, and triangles between its vertices that close its holes and have colours of their own.
struct RenderInput {
  geometry::TriangleMesh surface;
  std::vector<Rgb> vertex_colours = {};        ///< V, or empty: all of the style's clay.
  geometry::Triangles closing_triangles = {};  ///< N x 3, vertices of the surface.
  std::vector<Rgb> closing_colours = {};       ///< N.
  std::vector<float> closing_gloss =
      {};  ///< N, from 0 to 1, or empty: none. Strength of a small, sharp highlight: wet.
  /// Surface and closing triangles bound a solid, so that those seen from inside are left out: such are only seen where
  /// the solid pierces itself.
  bool is_solid = false;
  std::shared_ptr<const Image> texture = {};  ///< RGB, of the surface, which then has UV, in place of vertex_colours.
};

/// The linear light of each channel of an sRGB colour, from 0 to 1 [IEC 61966-2-1].
std::array<float, 3> LinearLight(const Rgb& colour);

struct ShadingStyle {
  Rgb clay = {206, 190, 176};
  Rgb background = {246, 244, 240};
  double flatness = 0.0;  ///< 0: lit; 1: every pixel has just its colour, which a heat map needs in part.
  int supersampling = 3;  ///< Samples a pixel and axis.
};

/// A picture of camera.height x camera.width, RGB. Smooth normals [Max 1999]; a warm key light from the upper left in
/// front of the picture, a cool fill from the right, a rim from behind and a sky above, all fixed to the camera, so
/// that every view is lit alike. Light is added up and averaged over samples in linear colour. Triangles seen from
/// inside are lit half as much.
/// A texture is interpolated bilinearly in linear colour.
/// @throws Error if there is not one colour a vertex, or one colour, or one gloss, a closing triangle; if the texture is
/// not RGB, or the surface has no UV for it; or as Rasterise and CheckUv.
Image RenderMesh(const RenderInput& input, const Camera& camera, const ShadingStyle& style = {});

}  // namespace daumier::render

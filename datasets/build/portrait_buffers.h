#pragma once
#include "datasets/build/portrait_light.h"
#include "faces/appearance/portrait_head.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/styles/picture_buffers.h"

namespace daumier::datasets {

/// What the camera sees of a head, rasterised once: colours, smooth normals (those of triangles weighted by area) turned to the viewer, light on
/// them (LightOn at vertices, interpolated, at least 0), depth, classes and parts. `supersampling` pixels of the buffers a pixel and axis of the camera. No lines.
/// @throws Error as render::Rasterise.
render::PictureBuffers DrawBuffers(const faces::PortraitHead& head, const render::Camera& camera,
                                   const SphericalLight& light, int supersampling);

/// The class that most samples of a pixel have, the lowest one at a tie: grey, of the picture's size.
render::Image MaskOf(const render::PictureBuffers& buffers);

/// 1 for each point (P x 3, cm, in the frame of the camera's world) that the camera sees: inside of the picture, and
/// nothing that is nearer by more than `tolerance` cm covers its pixel and all its neighbours. Depths are those of the
/// buffers of that camera.
std::vector<uint8_t> SeenPoints(const render::PictureBuffers& buffers, const render::Camera& camera,
                                const geometry::Points& points, double tolerance);

}  // namespace daumier::datasets

#pragma once
#include "raster/antialias.h"
#include "raster/interpolate.h"
#include "raster/rasterise.h"
#include "tests/raster/small_mesh.h"

#include <vector>

namespace daumier::raster {

/// Rasterise, Interpolate and Antialias one after the other, and back: what ColourPicture does in one.
struct PartsChain {
  const MeshTopology& topology;
  int height, width, channels;
  Facing facing = Facing::kFront;
  AntialiasOptions options = {};

  Raster<double> raster = {};
  CrossingMemory<double> memory = {};
  std::vector<Crossing<double>> crossings = {};
  std::vector<double> picture = {}, edge_values = {}, antialiased = {};

  /// `slopes`: of the crossings, which have no gradient; those of the edges if empty.
  void Forward(const std::vector<double>& positions, const std::vector<double>& colours,
               const std::vector<double>& slopes = {}) {
    Rasterise(topology, positions.data(), height, width, facing, raster);
    FindCrossings(topology, raster, facing, options, memory, crossings);
    for (size_t i = 0; i < slopes.size() && i < crossings.size(); ++i) crossings[i].slope = slopes[i];
    picture.assign(raster.num_pixels() * channels, 0), antialiased = picture;
    edge_values.assign(crossings.size() * channels, 0);
    Interpolate(topology, raster, channels, colours.data(), picture.data());
    InterpolateCrossings(crossings, channels, colours.data(), edge_values.data());
    Antialias(crossings, raster.num_pixels(), channels, picture.data(), edge_values.data(), antialiased.data());
  }

  void Backward(const std::vector<double>& colours, const std::vector<double>& weights,
                std::vector<double>& by_positions, std::vector<double>& by_colours) {
    std::vector<double> by_picture(picture.size()), by_edges(edge_values.size()),
        by_barycentrics(2 * raster.num_pixels());
    by_positions.assign(4 * size_t(topology.num_vertices), 0);
    by_colours.assign(colours.size(), 0);
    AntialiasBackward(crossings, raster, channels, picture.data(), edge_values.data(), weights.data(),
                      by_picture.data(), by_edges.data(), by_positions.data());
    InterpolateCrossingsBackward(crossings, raster, channels, colours.data(), by_edges.data(), by_colours.data(),
                                 by_positions.data());
    InterpolateBackward(topology, raster, channels, colours.data(), by_picture.data(), by_colours.data(),
                        by_barycentrics.data());
    RasteriseBackward(topology, raster, by_barycentrics.data(), by_positions.data());
  }

  std::vector<double> Slopes() const {
    std::vector<double> slopes;
    for (const auto& crossing : crossings) slopes.push_back(crossing.slope);
    return slopes;
  }
};

}  // namespace daumier::raster

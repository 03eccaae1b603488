#pragma once
#include "geometry/mesh.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace daumier::faces {

/// Frames of medical programs: x to the patient's left and y to the back (LPS), or x right and y to the front (RAS).
enum class PatientFrame { kLps, kRas };

/// Points that a person or a program marked on a mesh or in a picture, in the order of their file.
struct MarkedPoints {
  std::filesystem::path file;  ///< For messages.
  int dimension = 3;  ///< Numbers of a point: 3 on a mesh, 2 in a picture, 1: a vertex, or numbers without rows.
  std::vector<std::optional<geometry::Vector3>> points = {};  ///< No value: absent. Numbers beyond `dimension` are 0.
  std::vector<std::string> labels = {};                       ///< One a point, or none: names or numbers.
  std::optional<PatientFrame> frame = {};                     ///< Where the file names one; points are as stored.
};

enum class ZeroPoints {
  kPlaces,  ///< 0 0 0 is a place, 0 a vertex.
  kAbsent,  ///< They mean that there is no point.
};

/// Reads points by content, whatever the file's name:
///   text in rows   `x y z`, `x y` or a vertex, separated by blanks, commas, semicolons or tabulators; with or without
///                  a count, a header, numbers or names of the points; comments behind #, // or ;
///   iBUG .pts      `version: 1`, `n_points: 68`, braces
///   IDAV Landmark  .pts: `Version 1.0`, the count, `S000 x y z`
///   TPS            `LM3=68` or `LM=68`, the points, `ID=` and the like; SCALE is not applied
///   printed arrays of NumPy, PyTorch and Python; rows in brackets
///   PLY            the vertices, ASCII or binary
///   3D Slicer      .fcsv and .mrk.json; a markup that is not defined is absent
///   MeshLab        .pp; active="0" is absent
///   dlib           the parts of the one box of an imglab XML
///   JSON           lists of numbers, of points or of objects with coordinates; an object of named points; a list below
///                  `landmarks` or `points`
/// nan, null, an empty cell or - for a coordinate: the point is absent.
/// @throws Error naming file, line or entry, and the repair: unreadable, binary, decimal commas, rows of different
/// lengths with names, another count than the file states, no point that is there, text where a number is expected, no point.
MarkedPoints ReadMarkedPoints(const std::filesystem::path& path, ZeroPoints zero = ZeroPoints::kPlaces);

}  // namespace daumier::faces

#pragma once
#include "faces/face_database.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace daumier::datasets {

/// A face between two faces of a database: the share of the way from parent a to parent b in identity (person and
/// level) and in expression.
struct Interpolation {
  faces::FaceId a, b;
  float identity_share, expression_share;
};

/// Persons `first` .. `first + size - 1`.
struct Family {
  int first, size;
};

/// Persons 0 .. num_persons - 1 cut into families of family_size; what is left over belongs to the last one.
/// @throws UsageError if there are fewer persons than a family has.
std::vector<Family> MakeFamilies(int num_persons, int family_size);

/// Interpolation `index` of a database, from Stream(seed, "interpolation", index): two different persons of a random
/// family, each with a random level and expression, and two uniform shares.
Interpolation DrawInterpolation(const std::vector<Family>& families, int num_levels, int num_expressions, uint64_t seed,
                                int index);

/// 3V: the bilinear interpolation of the four faces that the identities and the expressions of both parents make,
///   (1-s)(1-t) F(a, e_a) + (1-s) t F(a, e_b) + s (1-t) F(b, e_a) + s t F(b, e_b),
/// s the share of identity, t that of expression. For a bilinear model this is the face of u and v interpolated by s
/// and t [Han et al. 2017, section 4.4]; no model is needed, and so none can have seen other persons.
/// Reads the person shards in `directory`. @throws Error as SafetensorsFile.
std::vector<float> Interpolate(const std::filesystem::path& directory, const Interpolation& interpolation);

/// Writes interpolated faces of the database in `directory` as a shard (docs/formats.md): `vertices` (K, V, 3),
/// `parents` (K, 2) int32 face indices, `shares` (K, 2) of identity and expression. Returns its checksum.
std::string WriteInterpolatedShard(const std::filesystem::path& file, const std::filesystem::path& directory,
                                   const std::vector<Interpolation>& interpolations);

/// How face `face` of a database was interpolated, read from its shard. @throws Error if the face is one of the grid or
/// there is no such face.
Interpolation ReadInterpolation(const faces::FaceDatabase& database, int face);

}  // namespace daumier::datasets

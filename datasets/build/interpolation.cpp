#include "datasets/build/interpolation.h"

#include "core/error.h"
#include "core/random.h"
#include "core/safetensors.h"

#include <algorithm>
#include <span>

namespace daumier::datasets {
namespace {

/// The faces of one person on disk, (levels, expressions, V, 3).
class PersonShard {
 public:
  PersonShard(const std::filesystem::path& directory, int person)
      : file_(directory / faces::PersonShardName(person)), vertices_(file_.at("vertices")) {}

  int64_t num_levels() const { return vertices_.shape[0]; }
  int64_t num_expressions() const { return vertices_.shape[1]; }
  int64_t num_vertices() const { return vertices_.shape[2]; }
  std::span<const float> face(int level, int expression) const {
    const size_t size = 3 * size_t(num_vertices());
    return vertices_.As<float>().subspan((level * num_expressions() + expression) * size, size);
  }

 private:
  SafetensorsFile file_;
  const ArrayView& vertices_;
};

}  // namespace

std::vector<Family> MakeFamilies(int num_persons, int family_size) {
  if (num_persons < family_size)
    throw UsageError(
        fmt::format("{} persons make no family of {} to interpolate in; raise num_persons or lower "
                    "family_size",
                    num_persons, family_size));
  std::vector<Family> families(num_persons / family_size);
  for (size_t f = 0; f < families.size(); ++f) families[f] = {static_cast<int>(f) * family_size, family_size};
  families.back().size = num_persons - families.back().first;
  return families;
}

Interpolation DrawInterpolation(const std::vector<Family>& families, int num_levels, int num_expressions, uint64_t seed,
                                int index) {
  Rng rng = Stream(seed, "interpolation", index);
  const auto below = [&](size_t count) { return static_cast<int>(rng.Below(count)); };
  const Family family = families[below(families.size())];
  const int first = below(family.size);
  const int second = (first + 1 + below(family.size - 1)) % family.size;
  const auto draw = [&](int member) {
    faces::FaceId id{.person = family.first + member, .level = below(num_levels), .expression = 0};
    id.expression = below(num_expressions);
    return id;
  };
  Interpolation result{};
  result.a = draw(first);
  result.b = draw(second);
  result.identity_share = static_cast<float>(rng.Uniform());
  result.expression_share = static_cast<float>(rng.Uniform());
  return result;
}

std::vector<float> Interpolate(const std::filesystem::path& directory, const Interpolation& interpolation) {
  const auto& [a, b, s, t] = interpolation;
  const PersonShard shard_a(directory, a.person), shard_b(directory, b.person);
  const auto aa = shard_a.face(a.level, a.expression), ab = shard_a.face(a.level, b.expression);
  const auto ba = shard_b.face(b.level, a.expression), bb = shard_b.face(b.level, b.expression);
  std::vector<float> vertices(aa.size());
  for (size_t i = 0; i < vertices.size(); ++i)
    vertices[i] = (1 - s) * ((1 - t) * aa[i] + t * ab[i]) + s * ((1 - t) * ba[i] + t * bb[i]);
  return vertices;
}

std::string WriteInterpolatedShard(const std::filesystem::path& file, const std::filesystem::path& directory,
                                   const std::vector<Interpolation>& interpolations) {
  std::vector<float> vertices, shares;
  std::vector<int32_t> parents;
  const PersonShard any(directory, 0);
  const auto index = [&](const faces::FaceId& id) {
    return static_cast<int32_t>((id.person * any.num_levels() + id.level) * any.num_expressions() + id.expression);
  };
  for (const Interpolation& interpolation : interpolations) {
    const std::vector<float> face = Interpolate(directory, interpolation);
    vertices.insert(vertices.end(), face.begin(), face.end());
    parents.insert(parents.end(), {index(interpolation.a), index(interpolation.b)});
    shares.insert(shares.end(), {interpolation.identity_share, interpolation.expression_share});
  }
  const auto count = static_cast<int64_t>(interpolations.size());
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "faces");
  writer.Add<float>("vertices", {count, any.num_vertices(), 3}, vertices);
  writer.Add<int32_t>("parents", {count, 2}, parents);
  writer.Add<float>("shares", {count, 2}, shares);
  return writer.Write(file);
}

Interpolation ReadInterpolation(const faces::FaceDatabase& database, int face) {
  DAUMIER_CHECK(face >= database.num_grid_faces() && face < database.num_faces(),
                "face {} of a database of {} faces was not interpolated", face, database.num_faces());
  const int per_shard = database.num_levels() * database.num_expressions();
  const SafetensorsFile shard(database.directory() / faces::FaceShardName(database.num_persons(), face / per_shard));
  const auto parents = shard.at("parents").As<int32_t>();
  const auto shares = shard.at("shares").As<float>();
  const size_t row = 2 * size_t(face % per_shard);
  return {database.id(parents[row]), database.id(parents[row + 1]), shares[row], shares[row + 1]};
}

}  // namespace daumier::datasets

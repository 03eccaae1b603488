#include "datasets/build/points.h"

#include "core/safetensors.h"
#include "datasets/build/face_attributes.h"
#include "datasets/build/sharded_build.h"
#include "faces/face_database.h"
#include "faces/model_frame.h"
#include "faces/open_mouth.h"
#include "geometry/surface_samples.h"

#include <algorithm>
#include <vector>

namespace daumier::datasets {
namespace {

/// The samples of the faces from `first_face` on as arrays of a shard (docs/formats.md).
std::string WritePointsShard(const std::filesystem::path& file, const faces::FaceDatabase& database,
                             const PointsOptions& options, int first_face, int num_faces) {
  std::vector<int32_t> triangles;
  std::vector<float> weights;
  for (int face = first_face; face < first_face + num_faces; ++face) {
    Rng rng = Stream(options.seed, "surface samples", uint64_t(face));
    const geometry::SurfaceSamples samples =
        geometry::SampleSurface({database.points(face), database.face_template().triangles}, options.num_samples, rng);
    triangles.insert(triangles.end(), samples.triangles.begin(), samples.triangles.end());
    weights.insert(weights.end(), samples.weights.begin(), samples.weights.end());
  }
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "points");
  writer.Add<int32_t>("triangles", {num_faces, options.num_samples}, triangles);
  writer.Add<float>("weights", {num_faces, options.num_samples, 2}, weights);
  return writer.Write(file);
}

/// The template with its mouth open in the model frame. Returns the file's checksum.
std::string WriteOpenTemplate(const std::filesystem::path& file, const faces::FaceTemplate& face_template,
                              const faces::ModelFrame& frame, double mouth_gap) {
  using RowsOfFloat = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const RowsOfFloat vertices = frame.FromCm(faces::OpenMouth(face_template, mouth_gap / frame.scale)).cast<float>();
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "points template");
  writer.Add<float>("vertices", {vertices.rows(), 3}, {vertices.data(), size_t(vertices.size())});
  return writer.Write(file);
}

std::string WriteAttributes(const std::filesystem::path& file, const AttributeTable& table) {
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "attributes");
  writer.Add<float>("attributes", {table.values.rows(), table.values.cols()},
                    {table.values.data(), size_t(table.values.size())});
  return writer.Write(file);
}

}  // namespace

void BuildPoints(const PointsOptions& options, const std::filesystem::path& directory, const Task& task) {
  const faces::FaceDatabase database(options.faces);
  const faces::FaceTemplate& face_template = database.face_template();
  const faces::ModelFrame frame = faces::HeadFrame(face_template, options.head_height);
  const int per_shard = database.num_levels() * database.num_expressions();

  ShardedBuild build;
  build.manifest.kind = "points";
  build.manifest.verb = "dataset points";
  build.manifest.config = ToJson(options);
  build.manifest.config.erase("faces");
  build.manifest.seed = options.seed;
  build.manifest.sources = database.manifest().sources;
  build.manifest.counts = {{"persons", database.num_persons()},
                           {"faces", database.num_faces()},
                           {"faces_per_shard", per_shard},
                           {"vertices", database.num_vertices()},
                           {"samples", options.num_samples}};
  build.manifest.details = {{"faces_data_hash", DataHash(options.faces)},
                            {"model_from_cm", faces::ModelFrameToJson(frame)},
                            {"attributes", FaceAttributeNames(database)}};
  build.num_units = database.num_faces();
  build.num_shards = (database.num_faces() + per_shard - 1) / per_shard;
  build.unit = "faces";
  build.units_per_shard = per_shard;
  build.shard_name = [num_persons = database.num_persons()](int shard) {
    return faces::FaceShardName(num_persons, shard);
  };
  build.write_shard = [&](int shard, const std::filesystem::path& file) {
    const int first = shard * per_shard;
    return WritePointsShard(file, database, options, first, std::min(per_shard, database.num_faces() - first));
  };
  build.write_rest = [&](const std::filesystem::path& folder) {
    auto checksums = faces::WriteFaceTemplate(folder, face_template);
    checksums["points_template.safetensors"] =
        WriteOpenTemplate(folder / "points_template.safetensors", face_template, frame, options.mouth_gap);
    checksums["attributes.safetensors"] = WriteAttributes(folder / "attributes.safetensors", FaceAttributes(database));
    return checksums;
  };
  BuildShards(directory, build, task);
}

}  // namespace daumier::datasets

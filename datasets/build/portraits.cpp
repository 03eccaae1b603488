#include "datasets/build/portraits.h"

#include "core/error.h"
#include "core/files.h"
#include "datasets/build/sharded_build.h"
#include "faces/controls/face_controls.h"
#include "faces/face_database.h"

#include <algorithm>
#include <map>

namespace daumier::datasets {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastBigEye = 0.8, kGreatestBigEye = 2.6;

/// The portraits of a person: first, and one past the last.
struct PortraitRange {
  int begin, end;
};

struct PortraitPlan {
  const PortraitsOptions& options;
  const faces::FaceDatabase& database;
  const PortraitExpressions& expressions;
  const PortraitMaker& maker;
  const faces::FaceControls& controls;
  int num_persons;  ///< Portrayed: the first ones.

  PortraitRange RangeOf(int person) const {
    const int64_t count = options.num_images;
    return {static_cast<int>(count * person / num_persons), static_cast<int>(count * (person + 1) / num_persons)};
  }
  int LevelOf(int image, int person) const { return (image - RangeOf(person).begin + person) % database.num_levels(); }
};

/// The value of the control eye_size of a face; 0: as it is.
float DrawEyeSize(const PortraitsOptions& options, int face) {
  Rng rng = Stream(options.seed, "big eyes", static_cast<uint64_t>(face));
  const bool is_big = rng.Uniform() < options.big_eyes;
  const double value = rng.Uniform(kLeastBigEye, kGreatestBigEye);
  return is_big ? static_cast<float>(value) : 0.0f;
}

geometry::Points EnlargedEyes(const faces::FaceControls& controls, const geometry::Points& face, float eye_size) {
  if (eye_size == 0) return face;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(controls.num_values());
  for (int k = 0; k < controls.num_values(); ++k)
    if (controls.value_names()[size_t(k)].starts_with("eye_size")) values[k] = eye_size;
  return controls.Apply(face, values);
}

/// Relative to the folder of the database.
fs::path BuffersName(int image) {
  return fmt::format("buffers/{:06}.exr", image);
}

std::string WritePersonPortraits(const fs::path& directory, const fs::path& file, const PortraitPlan& plan,
                                 int person) {
  const PortraitRange range = plan.RangeOf(person);
  std::map<int, PortraitExpressions::Face> faces;
  std::vector<PortraitRecord> records;
  for (int image = range.begin; image < range.end; ++image) {
    const int level = plan.LevelOf(image, person);
    const int index = plan.database.index({person, level, 0});
    const float eye_size = DrawEyeSize(plan.options, index);
    auto face = faces.find(level);
    if (face == faces.end()) {
      const geometry::Points neutral = EnlargedEyes(plan.controls, plan.database.points(index), eye_size);
      face = faces.emplace(level, plan.expressions.FaceOf(person, level, neutral)).first;
    }
    Rng rng = Stream(plan.options.seed, "portrait", static_cast<uint64_t>(image));
    const Eigen::VectorXf weights = plan.expressions.Draw(rng);
    render::FloatImage buffers;
    PortraitRecord record =
        plan.maker.MakeWithBuffers(face->second(weights), rng, plan.options.buffers ? &buffers : nullptr);
    if (plan.options.buffers) WriteFileAtomically(directory / BuffersName(image), render::EncodeExr(buffers));
    std::copy(weights.begin(), weights.end(), record.expression.begin());
    record.face = index;
    record.eye_size = eye_size;
    record.person = person;
    if (!plan.options.vertices) record.vertices.resize(0, 3);
    records.push_back(std::move(record));
  }
  return WritePortraitShard(file, records);
}

void Build(const std::optional<faces::FaceModel>& model, const PortraitsOptions& options, const fs::path& directory,
           const Task& task) {
  const faces::FaceDatabase database(options.faces);
  const PortraitExpressions expressions(database, model);
  const PortraitMaker maker(database.face_template(), options.pictures);
  const faces::FaceControls controls(database.face_template());
  const PortraitPlan plan{options, database, expressions,
                          maker,   controls, std::min(database.num_persons(), options.num_images)};

  ShardedBuild build;
  build.manifest.kind = "portraits";
  build.manifest.verb = "dataset portraits";
  build.manifest.config = ToJson(options);
  build.manifest.config.erase("faces");
  for (const char* path : {"path", "annotation", "template_mesh"}) build.manifest.config.at("source").erase(path);
  build.manifest.seed = options.seed;
  build.manifest.sources = database.manifest().sources;
  build.manifest.counts = {{"images", options.num_images},
                           {"shards", plan.num_persons},
                           {"persons", plan.num_persons},
                           {"levels", database.num_levels()},
                           {"vertices", database.num_vertices()}};
  const geometry::Vector3& centre = maker.centre();
  build.manifest.details = {{"faces_data_hash", DataHash(options.faces)},
                            {"size", maker.optics().size},
                            {"focal", maker.optics().focal},
                            {"distance", maker.optics().distance},
                            {"centre", {centre.x(), centre.y(), centre.z()}},
                            {"vertices", options.vertices},
                            {"expressions", expressions.names()},
                            {"styles", PortraitMaker::StyleNames()}};
  build.num_shards = plan.num_persons;
  build.num_units = options.num_images;
  build.unit = "portraits";
  build.units_per_shard = (options.num_images + plan.num_persons - 1) / plan.num_persons;
  build.shard_name = PortraitShardName;
  build.write_shard = [&](int shard, const fs::path& file) {
    return WritePersonPortraits(directory, file, plan, shard);
  };
  build.write_rest = [&](const fs::path& folder) {
    if (options.buffers) MakeDirectory(folder / "buffers");
    return faces::WriteFaceTemplate(folder, database.face_template());
  };
  if (options.buffers) {
    build.finish = [&](const fs::path& folder, Manifest& manifest) {
      for (int image = 0; image < options.num_images; ++image)
        manifest.checksums[BuffersName(image).string()] = Sha256OfFile(folder / BuffersName(image));
    };
  }
  BuildShards(directory, build, task);
}

}  // namespace

void BuildPortraits(const PortraitsOptions& options, const fs::path& directory, const Task& task) {
  if (options.expressions == "stored") return Build(std::nullopt, options, directory, task);
  Build(faces::LoadFaceModel(options.source), options, directory, task);
}

void BuildPortraits(const faces::FaceModel& model, const PortraitsOptions& options, const fs::path& directory,
                    const Task& task) {
  if (options.expressions == "stored") return Build(std::nullopt, options, directory, task);
  Build(model, options, directory, task);
}

}  // namespace daumier::datasets

#include "systems/portrait/portrait_weights.h"

#include "core/error.h"
#include "core/random.h"
#include "core/safetensors.h"
#include "faces/appearance/albedo_basis.h"
#include "faces/face_model_file.h"
#include "faces/scaled_shapes.h"
#include "geometry/coordinates.h"

#include <algorithm>
#include <utility>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExpressionWeightsKey = "expression_weights";
constexpr const char* kIdentitySourceKey = "identity_source";

/// What the network sees of a picture, of PortraitPictureOptions.
Json PicturesToJson(const PortraitPictureOptions& pictures) {
  return {{"crop", pictures.crop}, {"size", pictures.size}};
}

/// The 3DMM of identity.safetensors and a face model.
faces::MorphableModel ReadModel(const fs::path& folder, const faces::FaceModel& source) {
  const fs::path file = folder / kIdentityFile;
  const SafetensorsFile arrays(file);
  const ArrayView& mean = arrays.at("mean");
  const int num_vertices = source.face_template.num_vertices();
  DAUMIER_CHECK(mean.shape == (std::vector<int64_t>{num_vertices, 3}), "{}: 'mean' is ({}), expected ({}, 3)",
                file.string(), fmt::join(mean.shape, ", "), num_vertices);
  const auto identity_source = arrays.metadata().find(kIdentitySourceKey);
  DAUMIER_CHECK(identity_source != arrays.metadata().end(), "{}: metadata '{}' is missing", file.string(),
                kIdentitySourceKey);
  const faces::AlbedoBasis albedo = faces::MakeAlbedoBasis(source.face_template);
  Eigen::MatrixXf modes = faces::ReadScaledShapes(arrays, "identity", file);
  try {
    return faces::ModelOfModes(source, {albedo.mean, albedo.modes},
                               source.face_template.neutral + geometry::PointsFrom(mean.As<float>()), std::move(modes),
                               identity_source->second);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

struct Differences {
  double vertex_mm = 0, colour = 0;
};

/// Of random faces of two models with the same modes.
Differences CompareModels(const faces::MorphableModel& a, const faces::MorphableModel& b, uint64_t seed) {
  constexpr int kNumFaces = 16;
  Rng rng = Stream(seed, "weights");
  const double mm = faces::MillimetresPerCm(a.face_template);
  const geometry::Vector3 shift = a.centre - b.centre;
  Differences largest;
  for (int i = 0; i < kNumFaces; ++i) {
    std::vector<float> x(faces::kNumCoefficients, 0.0f);
    for (Eigen::Index k = 0; k < a.identity.cols(); ++k)
      x[size_t(faces::kIdentitySlot.first + k)] = float(rng.Normal());
    for (Eigen::Index k = 0; k < a.expression.cols(); ++k)
      x[size_t(faces::kExpressionSlot.first + k)] = rng.Uniform() < 0.7 ? 0 : float(rng.Uniform());
    for (Eigen::Index k = 0; k < a.albedo_modes.cols(); ++k)
      x[size_t(faces::kAlbedoSlot.first + k)] = float(rng.Normal());
    const faces::ColouredFace face = faces::Reconstruct(a, x), other = faces::Reconstruct(b, x);
    const geometry::Points difference = (face.vertices - other.vertices).rowwise() + shift.transpose();
    largest.vertex_mm = std::max(largest.vertex_mm, mm * difference.rowwise().norm().maxCoeff());
    largest.colour = std::max(largest.colour, double((face.albedo - other.albedo).cwiseAbs().maxCoeff()));
  }
  return largest;
}

/// @throws Error naming the run and what differs.
Differences CheckSameModel(const PortraitRunFolder& run, const faces::MorphableModel& written, const fs::path& source) {
  const faces::MorphableModel& model = run.model;
  const auto fail = [&](const std::string& what) {
    throw Error(
        fmt::format("{}: its 3DMM has {} than one with {}. Make the face model again from the source that the run was "
                    "trained with: daumier dataset model --out {} source.name={} source.path=FOLDER_OR_ARCHIVE",
                    run.directory.string(), what, source.string(), source.string(), model.face_template.source));
  };
  const geometry::Triangles &own = model.face_template.triangles, &other = written.face_template.triangles;
  if (own.rows() != other.rows() || own != other) fail("other triangles");
  if (model.expression_names != written.expression_names) fail("other expression shapes");
  if (model.expression_weights != written.expression_weights) fail("other expression weights");
  if (model.albedo_modes.cols() != written.albedo_modes.cols()) fail("another number of albedo modes");
  const Differences differences = CompareModels(model, written, run.manifest.seed);
  if (!(differences.vertex_mm <= kWeightsToleranceMm))
    fail(fmt::format("other shapes (faces differ by up to {:.3g} mm, at most {:g} is allowed)", differences.vertex_mm,
                     kWeightsToleranceMm));
  if (!(differences.colour <= kWeightsColourTolerance))
    fail(fmt::format("other colours (they differ by up to {:.3g}, at most {:g} is allowed)", differences.colour,
                     kWeightsColourTolerance));
  return differences;
}

}  // namespace

Json NetworkToJson(const PortraitNetworkOfWeights& network) {
  Json json = ToJson(network.options);
  json[kExpressionWeightsKey] = faces::NameOf(network.expression_weights);
  return json;
}

PortraitNetworkOfWeights PortraitNetworkFromJson(const Json& json) {
  DAUMIER_CHECK(json.is_object() && json.contains(kExpressionWeightsKey) && json.at(kExpressionWeightsKey).is_string(),
                "the options of the network are {}, expected a table with '{}'", json.dump(), kExpressionWeightsKey);
  Json options = json;
  options.erase(kExpressionWeightsKey);
  return {ParseOptions<PortraitNetworkOptions>(options, "the network of shipped weights"),
          faces::ExpressionWeightsNamed(json.at(kExpressionWeightsKey).get<std::string>())};
}

WeightsParts WritePortraitWeights(const PortraitRunFolder& run, const fs::path& folder, const fs::path& neighbours) {
  const faces::MorphableModel& model = run.model;
  const std::string name = "face-" + model.face_template.source;
  const fs::path face_model = (neighbours / name).lexically_normal();
  DAUMIER_CHECK(IsWeightsFolder(face_model),
                "{} is missing, the face model to which weights of portraits refer. Make it: daumier dataset model "
                "--out {} source.name={} source.path=FOLDER_OR_ARCHIVE",
                face_model.string(), face_model.string(), model.face_template.source);
  const faces::FaceModel source = faces::ReadFaceModelWeights(face_model, model.face_template.source);
  DAUMIER_CHECK(source.face_template.num_vertices() == model.face_template.num_vertices(),
                "{} has {} vertices, the 3DMM of {} has {}", face_model.string(), source.face_template.num_vertices(),
                run.directory.string(), model.face_template.num_vertices());
  const geometry::Points mean = model.face_template.neutral.rowwise() + model.centre.transpose();
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> offset =
      (mean - source.face_template.neutral).cast<float>();
  SafetensorsWriter writer;
  writer.SetMetadata("kind", "identity modes");
  writer.SetMetadata(kIdentitySourceKey, model.identity_source);
  writer.Add<float>("mean", {offset.rows(), 3}, {offset.data(), size_t(offset.size())});
  faces::AddScaledShapes(writer, "identity", model.identity, faces::kShapeToleranceCm);
  WeightsParts parts;
  parts.checksums[kIdentityFile] = writer.Write(folder / kIdentityFile);
  const Differences differences = CheckSameModel(run, ReadModel(folder, source), face_model);
  parts.details = {{"face_model", name},
                   {"needs", {{name, DataHash(face_model)}}},
                   {"pictures", PicturesToJson(run.options.pictures)},
                   {"largest_vertex_error_mm", differences.vertex_mm},
                   {"largest_colour_error", differences.colour}};
  return parts;
}

PortraitRunFolder ReadPortraitWeights(const fs::path& directory) {
  PortraitRunFolder run;
  run.directory = directory;
  run.manifest = ReadWeights(directory, kPortraitSystem, {kWeightsNetwork, kIdentityFile});
  run.config = run.manifest.config;
  const std::string file = (directory / "manifest.json").string();
  const Json& details = run.manifest.details;
  for (const char* key : {"network", "pictures", "face_model"})
    DAUMIER_CHECK(details.contains(key), "{}: details.{} is missing", file, key);
  DAUMIER_CHECK(details.at("face_model").is_string(), "{}: details.face_model is {}, expected a text", file,
                details.at("face_model").dump());
  run.options.network = PortraitNetworkFromJson(details.at("network")).options;
  run.options.pictures = ParseOptions<PortraitPictureOptions>(details.at("pictures"), file);
  const fs::path face_model = NeededWeights(directory, run.manifest, details.at("face_model").get<std::string>());
  run.model = ReadModel(directory, faces::ReadFaceModelWeights(face_model));
  return run;
}

PortraitRunFolder ReadPortraitFolder(const fs::path& run_or_weights) {
  return IsWeightsFolder(run_or_weights) ? ReadPortraitWeights(run_or_weights) : ReadPortraitRunFolder(run_or_weights);
}

}  // namespace daumier::portrait

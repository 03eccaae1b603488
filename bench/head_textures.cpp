// How far painted textures (fitting/texture_head.h) are from known heads seen from the side, and pictures of them.
//   head_textures make WEIGHTS OUT N                 pictures of N known heads: OUT/000.png ...
//   head_textures measure WEIGHTS N [PREDICTED]      table; shapes, poses, light and masks are the true ones, or those of
//                                                    PREDICTED: `daumier predict WEIGHTS OUT/*.png --out PREDICTED`, and
//                                                    NNN_mask.png of `daumier predict weights/landmarks ...` there
//   head_textures figure WEIGHTS OUT.png PREDICTED FIRST COUNT [Pan et al. 2024, figure 4]: every pixel projected, the parsed
//                                                    and diffused picture, mirror images and fill, delighted
//   head_textures sheet WEIGHTS OUT.png FIRST COUNT  texture, truth and result from several sides
// WEIGHTS: a portrait run or weights/portrait.
#include "bench/textured_portraits.h"
#include "core/files.h"
#include "core/json.h"
#include "core/statistics.h"
#include "core/stopwatch.h"
#include "geometry/obj.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "rig/head_rig.h"
#include "systems/portrait/portrait_crop.h"
#include "systems/portrait/portrait_weights.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;

const double kDefaultShare = fitting::TextureOptions{}.light_share;
constexpr std::array<double, 2> kSideViews = {-30, 30};

std::string NameOf(int i) {
  return fmt::format("{:03}", i);
}

/// What all heads share.
struct Workshop {
  explicit Workshop(const fs::path& weights)
      : model(portrait::ReadPortraitFolder(weights).model),
        dresser(model.face_template),
        rig(model.face_template),
        guide(fitting::MakeTextureGuide(model.face_template, rig)) {}

  fitting::ShownHead Shown(const geometry::Points& face) const {
    const rig::RiggedHead head = rig.On(face, {{}, Eigen::MatrixXf(face.size(), 0)});
    return {rig::JoinedMesh(head).vertices, {head.eyes.at(0).centre, head.eyes.at(1).centre}};
  }

  const faces::MorphableModel model;
  const faces::HeadDresser dresser;
  const rig::HeadRig rig;
  const fitting::TextureGuide guide;
};

/// A head as its painter gets it.
struct GivenHead {
  fitting::ShownHead shown;
  render::Image mask;
  Eigen::VectorXf albedo;  ///< Coefficients, 80.
};

/// V x 3.
Eigen::MatrixXf AlbedoOf(const Workshop& workshop, const Eigen::VectorXf& coefficients) {
  const Eigen::VectorXf modes = workshop.model.albedo_modes * coefficients.head(workshop.model.albedo_modes.cols());
  return workshop.model.albedo_mean + modes.reshaped<Eigen::RowMajor>(workshop.model.albedo_mean.rows(), 3);
}

GivenHead TrueHead(const Workshop& workshop, const KnownHead& known, const KnownView& front) {
  fitting::PortraitPose pose;
  for (int k = 0; k < 6; ++k) pose[k] = known.pose[size_t(k)];
  fitting::PictureCamera camera;
  camera.linear *= kPortraitPixels / 224.0;
  return {
      fitting::ShownHeadOf(workshop.rig, known.face, pose, camera, known.light, AlbedoOf(workshop, known.looks.albedo)),
      front.mask, known.looks.albedo};
}

GivenHead PredictedHead(const Workshop& workshop, const fs::path& folder, int i) {
  const Json manifest = Json::parse(ReadFile(folder / "manifest.json"));
  const Json& record = manifest.at("details").at("drawings").at(NameOf(i));
  const Json& coefficients = record.at("coefficients");
  // The face's vertices come first in a written head.
  const geometry::Points head = geometry::ReadObj(folder / (NameOf(i) + ".obj")).vertices;
  const geometry::Points face =
      head.topRows(workshop.model.face_template.num_vertices()).rowwise() - workshop.model.centre.transpose();
  fitting::PortraitPose pose;
  for (int k = 0; k < 6; ++k) pose[k] = coefficients.at("pose")[size_t(k)].get<double>();
  portrait::PictureMap map;
  for (int row = 0; row < 2; ++row) {
    map.shift[row] = record.at("crop").at("shift")[size_t(row)].get<double>();
    for (int column = 0; column < 2; ++column)
      map.linear(row, column) = record.at("crop").at("linear")[size_t(row)][size_t(column)].get<double>();
  }
  const portrait::PictureMap inverse = map.Inverse();
  const fitting::PictureCamera camera{.linear = inverse.linear, .shift = inverse.shift};
  const auto light = coefficients.at("light").get<fitting::PortraitLight>();
  const auto albedo = coefficients.at("albedo").get<std::vector<float>>();
  const auto modes = Eigen::Map<const Eigen::VectorXf>(albedo.data(), Eigen::Index(albedo.size()));
  return {fitting::ShownHeadOf(workshop.rig, face, pose, camera, light, AlbedoOf(workshop, modes)),
          render::ReadImage(folder / (NameOf(i) + "_mask.png")), modes};
}

/// A texture of colours at the vertices of the face (V x 3), of other vertices their mean.
fitting::HeadTexture TextureOfAlbedo(const Workshop& workshop, const rig::TexelMap& texels,
                                     const Eigen::MatrixXf& albedo) {
  fitting::HeadTexture texture{render::Image(texels.size, texels.size, 3),
                               render::Image(texels.size, texels.size, 3, 0)};
  const Eigen::RowVector3f mean = albedo.colwise().mean();
  const int num_finished = int(workshop.rig.finished_vertices().size());
  for (size_t i = 0; i < texels.triangles.size(); ++i) {
    if (texels.triangles[i] < 0) continue;
    Eigen::RowVector3f colour = Eigen::RowVector3f::Zero();
    for (int k = 0; k < 3; ++k) {
      const int joined = workshop.rig.texture_space().triangles(texels.triangles[i], k);
      const int v =
          joined < num_finished ? workshop.rig.finished_vertices()[size_t(joined)] : std::numeric_limits<int>::max();
      colour += texels.weights[i][k] * (v < albedo.rows() ? Eigen::RowVector3f(albedo.row(v)) : mean);
    }
    for (int k = 0; k < 3; ++k)
      texture.picture.pixels[3 * i + size_t(k)] = uint8_t(std::clamp(255 * colour[k] + 0.5F, 0.0F, 255.0F));
  }
  return texture;
}

/// Mean |difference| of RGB, 0 .. 255, by area.
struct AreaErrors {
  std::array<double, 5> sum{}, count{};  ///< By TexturedView::source; 0: all skin.

  void Add(const KnownView& truth, const TexturedView& ours, const std::vector<uint8_t>& source) {
    for (size_t i = 0; i < source.size(); ++i) {
      const bool is_skin = source[i] >= 1 && source[i] <= 3 && truth.is_face[i] != 0;
      if (!is_skin && !(source[i] == 4 && truth.is_eye[i] != 0)) continue;
      double difference = 0;
      for (size_t k = 0; k < 3; ++k)
        difference += std::abs(int(truth.picture.pixels[3 * i + k]) - int(ours.picture.pixels[3 * i + k])) / 3.0;
      for (const size_t area : {size_t(source[i]), size_t(0)}) {
        if (area == 0 && !is_skin) continue;
        sum[area] += difference, count[area] += 1;
      }
    }
  }
};

int Make(const Workshop& workshop, const fs::path& out, int count) {
  fs::create_directories(out);
  for (int i = 0; i < count; ++i) {
    const KnownHead known = MakeKnownHead(workshop.model, workshop.dresser, i);
    render::WriteImage(out / (NameOf(i) + ".png"), ViewOf(known, known.pose).picture);
  }
  return 0;
}

int Measure(const Workshop& workshop, int count, const std::optional<fs::path>& predicted) {
  using enum fitting::TextureFill;
  struct Row {
    std::string title;
    std::unique_ptr<fitting::HeadPainter> painter;
    AreaErrors errors;
  };
  const auto painter = [&](fitting::TextureFill fill, bool delight, bool fit_light = false, double share = 1) {
    return std::make_unique<fitting::HeadPainter>(
        workshop.rig.texture_space(), workshop.guide,
        fitting::TextureOptions{.delight = delight, .fit_light = fit_light, .light_share = share, .fill = fill});
  };
  std::vector<Row> rows;
  rows.push_back({"projection, median elsewhere", painter(kNone, false), {}});
  rows.push_back({"+ mirrored", painter(kMirrored, false), {}});
  rows.push_back({"+ diffused", painter(kSmooth, false), {}});
  rows.push_back({"+ delighted by the given light", painter(kSmooth, true), {}});
  rows.push_back({"+ delighted by a fitted light", painter(kSmooth, true, true), {}});
  rows.push_back({"+ its contrast to 0.6 (default)", painter(kSmooth, true, true, kDefaultShare), {}});
  rows.push_back({"mean albedo, relit", nullptr, {}});
  rows.push_back({"albedo of coefficients, relit", nullptr, {}});
  const rig::TexelMap texels = workshop.rig.texture_space().Rasterise(1024);
  std::vector<double> milliseconds, seen, mirrored;
  for (int i = 0; i < count; ++i) {
    const KnownHead known = MakeKnownHead(workshop.model, workshop.dresser, i);
    const KnownView front = ViewOf(known, known.pose);
    const GivenHead given = predicted ? PredictedHead(workshop, *predicted, i) : TrueHead(workshop, known, front);
    std::vector<fitting::HeadTexture> textures;
    for (const Row& row : rows) {
      const Stopwatch stopwatch;
      if (row.painter) textures.push_back(row.painter->Paint(given.shown, front.picture, given.mask));
      if (textures.size() == 6 && row.painter) milliseconds.push_back(1e3 * stopwatch.seconds());
    }
    seen.push_back(textures.back().seen), mirrored.push_back(textures.back().mirrored);
    textures.push_back(TextureOfAlbedo(workshop, texels, workshop.model.albedo_mean));
    textures.push_back(TextureOfAlbedo(workshop, texels, AlbedoOf(workshop, given.albedo)));
    for (const double yaw : kSideViews) {
      const KnownView truth = ViewOf(known, TurnedPose(known.pose, yaw));
      const fitting::PortraitPose pose = TurnedPose(given.shown.pose, yaw);
      std::vector<TexturedView> views;
      for (size_t row = 0; row < rows.size(); ++row) {
        // What is painted is relit by the light that it was divided by.
        const auto* const light = textures[row].light ? &*textures[row].light
                                  : row >= 3          ? &*given.shown.light
                                                      : nullptr;
        const double share = row == 5 ? kDefaultShare : 1;
        views.push_back(
            DrawTextured(workshop.rig.texture_space(), given.shown.vertices, pose, textures[row], light, share));
      }
      for (size_t row = 0; row < rows.size(); ++row) rows[row].errors.Add(truth, views[row], views[4].source);
    }
  }
  std::printf("| texture | skin | seen | mirrored | filled | eyes |\n|---|---:|---:|---:|---:|---:|\n");
  for (const Row& row : rows) {
    std::printf("| %s |", row.title.c_str());
    for (size_t area = 0; area < 5; ++area) std::printf(" %.1f |", row.errors.sum[area] / row.errors.count[area]);
    std::printf("\n");
  }
  const AreaErrors& last = rows[4].errors;
  std::printf("\n%d heads; of the pixels of skin compared: seen %.1f %%, mirrored %.1f %%, filled %.1f %%\n", count,
              100 * last.count[1] / last.count[0], 100 * last.count[2] / last.count[0],
              100 * last.count[3] / last.count[0]);
  std::printf("of the atlas: seen %.1f %%, mirrored %.1f %%; %.0f ms a texture of 1024 (median)\n", 100 * Mean(seen),
              100 * Mean(mirrored), Median(milliseconds));
  return 0;
}

int Sheet(const Workshop& workshop, const fs::path& out, int first, int count) {
  const fitting::HeadPainter painter(workshop.rig.texture_space(), workshop.guide);
  std::vector<render::SheetCell> cells;
  for (int i = first; i < first + count; ++i) {
    const KnownHead known = MakeKnownHead(workshop.model, workshop.dresser, i);
    const KnownView front = ViewOf(known, known.pose);
    const GivenHead given = TrueHead(workshop, known, front);
    const fitting::HeadTexture texture = painter.Paint(given.shown, front.picture, given.mask);
    const auto ours = [&](const fitting::PortraitPose& pose) {
      return DrawTextured(workshop.rig.texture_space(), given.shown.vertices, pose, texture, &*texture.light,
                          kDefaultShare)
          .picture;
    };
    cells.push_back({front.picture, "picture"});
    for (const double yaw : kSideViews)
      cells.push_back({ViewOf(known, TurnedPose(known.pose, yaw)).picture, fmt::format("truth, {:+}", yaw)});
    cells.push_back({render::Resize(texture.picture, kPortraitPixels, kPortraitPixels), "texture"});
    cells.push_back({ours(given.shown.pose), "painted"});
    for (const double yaw : kSideViews)
      cells.push_back({ours(TurnedPose(given.shown.pose, yaw)), fmt::format("painted, {:+}", yaw)});
    cells.push_back({ours(TurnedPose(given.shown.pose, 180)), "from behind"});
  }
  render::WriteImage(out, render::MakeSheet(cells, 4));
  return 0;
}

int Figure(const Workshop& workshop, const fs::path& out, const fs::path& predicted, int first, int count) {
  using enum fitting::TextureFill;
  struct Column {
    const char* caption;
    fitting::TextureOptions options;
    bool is_parsed = true;
  };
  const std::array<Column, 4> columns = {
      {{"every pixel projected", {.delight = false, .margin = 0, .fill = kNone}, false},
       {"parsed and diffused", {.delight = false, .fill = kNone}},
       {"+ mirrored and filled", {.delight = false}},
       {"+ delighted", {}}}};
  std::vector<render::SheetCell> cells;
  for (int i = first; i < first + count; ++i) {
    const KnownHead known = MakeKnownHead(workshop.model, workshop.dresser, i);
    const render::Image picture = ViewOf(known, known.pose).picture;
    const GivenHead given = PredictedHead(workshop, predicted, i);
    const render::Image all_skin(picture.height, picture.width, 1, uint8_t(PictureClass::kSkin));
    cells.push_back({picture, "picture"});
    for (const Column& column : columns) {
      const fitting::HeadTexture texture =
          fitting::PaintHead(workshop.rig.texture_space(), workshop.guide, given.shown, picture,
                             column.is_parsed ? given.mask : all_skin, column.options);
      const double away = given.shown.pose[1] > 0 ? -45 : 45;  // To the side that the picture does not show.
      cells.push_back({DrawTextured(workshop.rig.texture_space(), given.shown.vertices,
                                    TurnedPose(given.shown.pose, away), texture, nullptr)
                           .picture,
                       column.caption});
    }
  }
  render::WriteImage(out, render::MakeSheet(cells, 5));
  return 0;
}

}  // namespace
}  // namespace daumier

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    const auto is = [&](const char* verb, size_t least, size_t most) {
      return arguments.size() >= least && arguments.size() <= most && arguments[0] == verb;
    };
    const auto number = [&](size_t at) { return std::stoi(arguments[at]); };
    if (is("make", 4, 4)) return daumier::Make(daumier::Workshop(arguments[1]), arguments[2], number(3));
    if (is("measure", 3, 4))
      return daumier::Measure(daumier::Workshop(arguments[1]), number(2),
                              arguments.size() > 3 ? std::optional<std::filesystem::path>(arguments[3]) : std::nullopt);
    if (is("figure", 6, 6))
      return daumier::Figure(daumier::Workshop(arguments[1]), arguments[2], arguments[3], number(4), number(5));
    if (is("sheet", 5, 5)) return daumier::Sheet(daumier::Workshop(arguments[1]), arguments[2], number(3), number(4));
    std::fputs(
        "usage: head_textures make WEIGHTS OUT N | measure WEIGHTS N [PREDICTED] | figure WEIGHTS OUT PREDICTED FIRST "
        "COUNT "
        "| sheet WEIGHTS OUT FIRST COUNT\n",
        stderr);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}

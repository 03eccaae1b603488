#include "render/shading.h"

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/corner_uv.h"
#include "geometry/normals.h"
#include "render/rasteriser.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace daumier::render {
namespace {

using Colour = Eigen::Array3f;  ///< Linear RGB.

constexpr float kInsideLight = 0.5f;
constexpr float kWetSharpness = 260.0f;

float LinearOf(uint8_t encoded) {
  const float value = static_cast<float>(encoded) / 255.0f;
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

Colour LinearOf(const Rgb& colour) {
  return Eigen::Map<const Colour>(LinearLight(colour).data());
}

uint8_t EncodedOf(float linear) {
  const float value = std::clamp(linear, 0.0f, 1.0f);
  const float encoded = value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(255.0f * encoded));
}

struct Light {
  Eigen::Vector3f direction;  ///< Towards the light, in the camera's frame: x right, y down, z away from the viewer.
  Colour colour;
  float wrap;  ///< How far the light reaches around the surface.
  float specular;
};

const std::array<Light, 3>& Lights() {
  static const std::array<Light, 3> lights = {
      Light{Eigen::Vector3f(-0.55f, -0.65f, -0.75f).normalized(), {0.80f, 0.76f, 0.70f}, 0.15f, 0.06f},
      Light{Eigen::Vector3f(0.85f, 0.05f, -0.45f).normalized(), {0.15f, 0.17f, 0.20f}, 0.3f, 0.0f},
      Light{Eigen::Vector3f(0.45f, -0.55f, 0.70f).normalized(), {0.32f, 0.33f, 0.36f}, 0.0f, 0.0f}};
  return lights;
}

/// Linear colours of a texture.
class TextureColours {
 public:
  explicit TextureColours(const Image& image) : image_(image) {
    for (int value = 0; value < 256; ++value) linear_[size_t(value)] = LinearOf(uint8_t(value));
  }

  /// Between the four texels around (u, v); those at the border continue.
  Colour At(const Eigen::Vector2f& uv) const {
    const float x = uv.x() * float(image_.width) - 0.5f, y = (1.0f - uv.y()) * float(image_.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const Colour upper = Between(Texel(top, left), Texel(top, left + 1), x - left);
    const Colour lower = Between(Texel(top + 1, left), Texel(top + 1, left + 1), x - left);
    return Between(upper, lower, y - top);
  }

 private:
  static Colour Between(const Colour& a, const Colour& b, float share) { return a + share * (b - a); }
  Colour Texel(float row, float column) const {
    const int r = static_cast<int>(std::clamp(row, 0.0f, float(image_.height - 1)));
    const int c = static_cast<int>(std::clamp(column, 0.0f, float(image_.width - 1)));
    return {linear_[image_.at(r, c, 0)], linear_[image_.at(r, c, 1)], linear_[image_.at(r, c, 2)]};
  }

  const Image& image_;
  std::array<float, 256> linear_{};
};

/// What a point is made of. `wet`: strength of a sharp highlight.
struct Substance {
  Colour albedo;
  float wet = 0.0f;
};

/// normal and view (towards the viewer) are unit vectors in the camera's frame.
Colour Shade(const Substance& substance, const Eigen::Vector3f& normal, const Eigen::Vector3f& view, float flatness) {
  const float upwards = 0.5f - 0.5f * normal.y();
  Colour light = Colour(0.10f, 0.09f, 0.08f) * (1.0f - upwards) + Colour(0.22f, 0.23f, 0.25f) * upwards;
  Colour gloss = Colour::Zero();
  for (const Light& source : Lights()) {
    const float cosine = normal.dot(source.direction);
    light += source.colour * std::max(0.0f, (cosine + source.wrap) / (1.0f + source.wrap));
    if (source.specular > 0.0f && cosine > 0.0f) {
      const float half = std::max(0.0f, normal.dot((source.direction + view).normalized()));
      gloss += source.colour * source.specular * std::pow(half, 28.0f);
      if (substance.wet > 0.0f) gloss += source.colour * substance.wet * std::pow(half, kWetSharpness);
    }
  }
  return (1.0f - flatness) * (substance.albedo * light + gloss) + flatness * substance.albedo;
}

/// Surface and closing triangles as one mesh with one list of corner attributes each.
struct Scene {
  const geometry::TriangleMesh& mesh;
  Eigen::Index num_surface_triangles;
  geometry::Points surface_normals = {}, closing_normals = {};  ///< V x 3, in the camera's frame.
  std::vector<Colour> vertex_colours = {};
  std::vector<Substance> closing = {};
  const geometry::TriangleMesh* textured = nullptr;  ///< The surface, if it has a texture.
  std::optional<TextureColours> texture = {};
};

/// The surface's triangles, then the closing ones.
geometry::TriangleMesh ClosedSurface(const RenderInput& input) {
  const geometry::Triangles &surface = input.surface.triangles, &closing = input.closing_triangles;
  geometry::TriangleMesh mesh{input.surface.vertices, geometry::Triangles(surface.rows() + closing.rows(), 3)};
  mesh.triangles << surface, closing;
  return mesh;
}

Scene MakeScene(const RenderInput& input, const geometry::TriangleMesh& mesh, const Camera& camera, const Rgb& clay) {
  const auto& surface = input.surface;
  DAUMIER_CHECK(input.vertex_colours.empty() || Eigen::Index(input.vertex_colours.size()) == surface.vertices.rows(),
                "{} colours were given for {} vertices", input.vertex_colours.size(), surface.vertices.rows());
  DAUMIER_CHECK(Eigen::Index(input.closing_colours.size()) == input.closing_triangles.rows(),
                "{} colours were given for {} closing triangles", input.closing_colours.size(),
                input.closing_triangles.rows());
  DAUMIER_CHECK(
      input.closing_gloss.empty() || Eigen::Index(input.closing_gloss.size()) == input.closing_triangles.rows(),
      "{} values of gloss were given for {} closing triangles", input.closing_gloss.size(),
      input.closing_triangles.rows());
  Scene scene{.mesh = mesh, .num_surface_triangles = surface.triangles.rows()};
  const Eigen::Matrix3d world_from_camera = camera.camera_from_world.transpose();
  scene.surface_normals = geometry::VertexNormals(surface) * world_from_camera;
  scene.closing_normals = geometry::VertexNormals({surface.vertices, input.closing_triangles}) * world_from_camera;
  for (const Rgb& colour : input.vertex_colours) scene.vertex_colours.push_back(LinearOf(colour));
  if (input.texture != nullptr) {
    DAUMIER_CHECK(input.texture->channels == 3 && !input.texture->pixels.empty(),
                  "a texture of {} x {} x {} values, expected RGB", input.texture->height, input.texture->width,
                  input.texture->channels);
    DAUMIER_CHECK(surface.has_uv() || surface.triangles.rows() == 0, "a texture is given for a surface without UV");
    geometry::CheckUv(surface);
    scene.textured = &surface;
    scene.texture.emplace(*input.texture);
  }
  if (scene.vertex_colours.empty()) scene.vertex_colours.assign(surface.vertices.rows(), LinearOf(clay));
  for (const Rgb& colour : input.closing_colours) scene.closing.push_back({LinearOf(colour)});
  for (size_t i = 0; i < input.closing_gloss.size(); ++i) scene.closing[i].wet = input.closing_gloss[i];
  return scene;
}

/// Samples of one triangle in a pixel.
struct Samples {
  int triangle, count;
  Eigen::Vector3f barycentric;  ///< Their sum.
};

/// Adds a sample to those of its triangle. Samples of a texture stay apart, for it may change between them.
void AddSample(int triangle, const Eigen::Vector3f& barycentric, bool is_textured, std::vector<Samples>& all) {
  const auto same = std::ranges::find(all, triangle, &Samples::triangle);
  if (is_textured || same == all.end()) {
    all.push_back({triangle, 1, barycentric});
  } else {
    ++same->count;
    same->barycentric += barycentric;
  }
}

/// At the centre of samples.
Colour ShadeSamples(const Scene& scene, const Camera& camera, const Samples& samples, float flatness) {
  const int triangle = samples.triangle;
  const Eigen::Vector3f barycentric = samples.barycentric / float(samples.count);
  const bool on_surface = triangle < scene.num_surface_triangles;
  const auto& normals = on_surface ? scene.surface_normals : scene.closing_normals;
  const auto corners = scene.mesh.triangles.row(triangle);

  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), point = Eigen::Vector3d::Zero();
  Substance substance{Colour::Zero()};
  for (int k = 0; k < 3; ++k) {
    normal += double{barycentric[k]} * normals.row(corners(k)).transpose();
    point += double{barycentric[k]} * scene.mesh.vertices.row(corners(k)).transpose();
    if (on_surface && !scene.texture) substance.albedo += barycentric[k] * scene.vertex_colours[corners(k)];
  }
  if (on_surface && scene.texture) {
    Eigen::Vector2f uv = Eigen::Vector2f::Zero();
    for (int k = 0; k < 3; ++k)
      uv +=
          barycentric[k] * scene.textured->uv.row(scene.textured->uv_triangles(triangle, k)).transpose().cast<float>();
    substance.albedo = scene.texture->At(uv);
  }
  if (!on_surface) substance = scene.closing[triangle - scene.num_surface_triangles];

  Eigen::Vector3d view(0.0, 0.0, -1.0);
  if (camera.perspective) view = -(camera.camera_from_world * point + camera.translation).normalized();
  const Eigen::Vector3d p0 = scene.mesh.vertices.row(corners(0)), p1 = scene.mesh.vertices.row(corners(1)),
                        p2 = scene.mesh.vertices.row(corners(2));
  const bool from_inside = (camera.camera_from_world * (p1 - p0).cross(p2 - p0)).dot(view) < 0.0;
  if (from_inside) normal = -normal;
  const Colour colour = Shade(substance, normal.normalized().cast<float>(), view.cast<float>(), flatness);
  return from_inside ? Colour(colour * kInsideLight) : colour;
}

}  // namespace

std::array<float, 3> LinearLight(const Rgb& colour) {
  return {LinearOf(colour[0]), LinearOf(colour[1]), LinearOf(colour[2])};
}

Image RenderMesh(const RenderInput& input, const Camera& camera, const ShadingStyle& style) {
  const geometry::TriangleMesh mesh = ClosedSurface(input);
  // First, since it checks the triangles.
  const Raster raster = Rasterise(Enlarged(camera, style.supersampling), mesh, {.cull_back_faces = input.is_solid});
  const Scene scene = MakeScene(input, mesh, camera, style.clay);
  const Colour background = LinearOf(style.background);
  const auto flatness = static_cast<float>(style.flatness);

  Image image(camera.height, camera.width, 3);
  const int n = style.supersampling;
  OnAllCores(camera.height, [&](int64_t of_row) {
    const int row = int(of_row);
    std::vector<Samples> covered;
    for (int column = 0; column < camera.width; ++column) {
      covered.clear();
      int num_empty = 0;
      for (int sample = 0; sample < n * n; ++sample) {
        const size_t pixel = raster.index(row * n + sample / n, column * n + sample % n);
        const int triangle = raster.triangle[pixel];
        if (triangle < 0) {
          ++num_empty;
        } else {
          AddSample(triangle, Eigen::Map<const Eigen::Vector3f>(raster.barycentric[pixel].data()),
                    scene.texture.has_value(), covered);
        }
      }
      Colour sum = background * float(num_empty);
      for (const Samples& samples : covered)
        sum += float(samples.count) * ShadeSamples(scene, camera, samples, flatness).min(1.0f);
      for (int channel = 0; channel < 3; ++channel) {
        image.at(row, column, channel) =
            covered.empty() ? style.background[channel] : EncodedOf(sum[channel] / static_cast<float>(n * n));
      }
    }
  });
  return image;
}

}  // namespace daumier::render

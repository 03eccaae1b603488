#pragma once
#include "core/json.h"
#include "core/random.h"
#include "faces/annotation.h"
#include "geometry/mesh.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::faces {

/// What stays the same for all faces of a source.
struct FaceTemplate {
  std::string source;             ///< "makehuman", "ict".
  Json provenance;                ///< {name, version, checksum, licence}, copied into manifests and model cards.
  geometry::Points neutral;       ///< Mean neutral face, V x 3, cm, y up, facing +z.
  geometry::Triangles triangles;  ///< The open surface: holes at lips, eyes and neck.
  geometry::Triangles
      closing_triangles;  ///< Close lips and eyes for rendering; never part of a metric. Uses existing vertices.
  int num_eye_closing_triangles = 0;  ///< closing_triangles begins with these; the rest closes the mouth.
  Annotation annotation;
  geometry::TextureCoordinates uv{};   ///< T x 2; empty where the source has no UV. closing_triangles have none.
  geometry::Triangles uv_triangles{};  ///< Row of `uv` at each corner, parallel to `triangles`.

  int num_vertices() const { return static_cast<int>(neutral.rows()); }
  bool has_uv() const { return uv.rows() > 0; }
};

/// The open surface of the template at other positions, with its UV. @throws Error unless `vertices` is V x 3.
geometry::TriangleMesh SurfaceMesh(const FaceTemplate& face_template, const geometry::Points& vertices);

/// Millimetres of error per centimetre of the source: 200 mm / (height of the mean neutral face from landmark 8, the
/// chin, to the hairline vertex, along y). One scale a database; no scaling of single faces.
double MillimetresPerCm(const FaceTemplate& face_template);

/// How a group of identity weights is drawn.
struct IdentityControl {
  enum class Kind {
    kGaussian,  ///< shapes = {s}:          w_s ~ N(0, sigma^2)
    kBipolar,  ///< shapes = {minus, plus}: x ~ N(0, sigma^2) clamped to [-1, 1]; the shape of its sign gets |x|; -1: no
               ///< shape
    kSimplex,  ///< shapes = {s...}:       e_s^sigma / sum e^sigma with e exponential; sigma 1 is uniform, 0 is equal
               ///< weights
  };
  std::string name;
  Kind kind = Kind::kGaussian;
  std::vector<int> shapes;
  double sigma = 1.0;
};

/// A named face expression as weights of the linear expression shapes.
struct Expression {
  std::string name;
  Eigen::VectorXf weights;  ///< num_expression_shapes
};

/// The numbers and unit of a source's own files, so that further files of it can be read.
struct SourceNumbering {
  std::vector<int> vertices;  ///< V: the number of each vertex of the template; empty where it is not known.
  int num_vertices = 0;       ///< Of the source's mesh.
  double cm_per_unit = 1;
};

/// A linear face: vertices = neutral + sum_s a_s identity_shape_s + sum_e b_e expression_shape_e.
struct FaceModel {
  FaceTemplate face_template;
  Eigen::MatrixXf
      identity_shapes;  ///< 3V x S, displacements in cm, coordinates of a vertex next to each other (x0 y0 z0 x1 ...).
  std::vector<IdentityControl> identity_controls;
  bool align_identities =
      false;  ///< Macro shapes also move and scale the head: similarity-align identities to the neutral.
  std::vector<std::string> expression_shape_names;
  Eigen::MatrixXf expression_shapes;    ///< 3V x E
  std::vector<Expression> expressions;  ///< The first is "neutral".
  SourceNumbering numbering = {};
};

/// Identity weights of a random person, S. `spread` multiplies every sigma.
Eigen::VectorXf DrawIdentity(const FaceModel& model, Rng& rng, double spread = 1.0);

/// Neutral face of an identity, aligned if the model requires it. @throws Error if the number of weights differs.
geometry::Points IdentityFace(const FaceModel& model, const Eigen::VectorXf& identity_weights);

/// The displacement of an expression, 3V. @throws Error if the number of weights differs.
Eigen::VectorXf ExpressionOffset(const FaceModel& model, const Eigen::VectorXf& expression_weights);

}  // namespace daumier::faces

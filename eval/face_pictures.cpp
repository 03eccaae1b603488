#include "eval/face_pictures.h"

#include "fitting/face_surface.h"
#include "render/shading.h"

namespace daumier::eval {

render::Frame FrameOfFaces(const faces::FaceDatabase& database, const std::vector<int>& indices) {
  const auto num_vertices = Eigen::Index(database.num_vertices());
  geometry::Points all(num_vertices * Eigen::Index(indices.size()), 3);
  for (size_t i = 0; i < indices.size(); ++i)
    all.middleRows(Eigen::Index(i) * num_vertices, num_vertices) = database.points(indices[i]);
  return render::FrameOf(all);
}

render::Image FrontView(const faces::FaceTemplate& face_template, const geometry::Points& face,
                        const render::Frame& frame) {
  return render::RenderMesh(fitting::SurfaceOf(face_template, face),
                            render::FrontalCamera(frame.centre, frame.half_height, kCell));
}

render::Image SideView(const faces::FaceTemplate& face_template, const geometry::Points& face,
                       const render::Frame& frame) {
  return render::RenderMesh(fitting::SurfaceOf(face_template, face),
                            render::SideCamera(frame.centre, frame.half_height, kCell));
}

render::Image FrontView(const faces::FaceDatabase& database, int face, const render::Frame& frame) {
  return FrontView(database.face_template(), database.points(face), frame);
}

render::Image SideView(const faces::FaceDatabase& database, int face, const render::Frame& frame) {
  return SideView(database.face_template(), database.points(face), frame);
}

}  // namespace daumier::eval

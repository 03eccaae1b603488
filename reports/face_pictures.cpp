#include "reports/face_pictures.h"

#include "render/shading.h"
#include "reports/face_surface.h"

namespace daumier::reports {

render::Frame FrameOfFaces(const std::vector<geometry::Points>& faces, double margin) {
  Eigen::Index num_points = 0;
  for (const geometry::Points& face : faces) num_points += face.rows();
  geometry::Points all(num_points, 3);
  Eigen::Index begin = 0;
  for (const geometry::Points& face : faces) {
    all.middleRows(begin, face.rows()) = face;
    begin += face.rows();
  }
  return render::FrameOf(all, margin);
}

render::Frame FrameOfFaces(const faces::FaceDatabase& database, const std::vector<int>& indices) {
  std::vector<geometry::Points> faces;
  for (const int index : indices) faces.push_back(database.points(index));
  return FrameOfFaces(faces);
}

render::Image FrontView(const faces::FinishedHead& head, const geometry::Points& face, const render::Frame& frame) {
  return render::RenderMesh(InputOf(head, face), render::FrontalCamera(frame.centre, frame.half_height, kCell));
}

render::Image SideView(const faces::FinishedHead& head, const geometry::Points& face, const render::Frame& frame) {
  return render::RenderMesh(InputOf(head, face), render::SideCamera(frame.centre, frame.half_height, kCell));
}

}  // namespace daumier::reports

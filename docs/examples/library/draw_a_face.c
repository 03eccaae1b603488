/* A drawing -> a face -> its nose pulled out -> a rigged head for a game, by the C library:
 *   cc draw_a_face.c $(pkg-config --cflags --libs daumier) -o draw_a_face && ./draw_a_face drawing.svg head.glb */
#include <daumier.h>
#include <stdio.h>
#include <stdlib.h>

static void check(daumier_status status) {
  if (status != DAUMIER_OK) fprintf(stderr, "%s\n", daumier_last_error()), exit(status);
}

int main(int argc, char** argv) {
  if (argc != 3) return fprintf(stderr, "usage: draw_a_face DRAWING HEAD.glb\n"), 2;
  daumier_predictor* predictor;
  daumier_face* face;
  check(daumier_predictor_open("sketch-ict", &predictor));
  check(daumier_predict_file(predictor, argv[1], &face));
  const size_t size = 3 * daumier_face_num_vertices(face);
  float* xyz = malloc(size * sizeof *xyz); /* x y z of each vertex, cm */
  check(daumier_face_vertices(face, xyz, size));

  daumier_model* model;
  daumier_edit* edit;
  check(daumier_model_open(NULL, &model));
  const int32_t nose = daumier_model_landmark(model, 30);
  const float move[3] = {0, 0, 1}; /* 1 cm to the front */
  check(daumier_edit_begin(model, xyz, size, &nose, 1, 1, &edit));
  check(daumier_edit_move(edit, move, 3, xyz, size));

  daumier_rig* rig;
  daumier_head* head;
  check(daumier_rig_open(NULL, &rig));
  check(daumier_rig_head(rig, xyz, size, &head));
  check(daumier_head_write(head, argv[2]));
  printf("%zu vertices, nose at %.2f %.2f %.2f cm\n", size / 3, xyz[3 * nose], xyz[3 * nose + 1], xyz[3 * nose + 2]);

  daumier_head_free(head), daumier_rig_free(rig), daumier_edit_free(edit), daumier_model_free(model);
  daumier_face_free(face), daumier_predictor_free(predictor), free(xyz);
}

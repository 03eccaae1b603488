/* Daumier as a C library: faces from drawings and portraits, deformable faces, rigged heads.
 *
 * Objects are opaque, made by functions *_open, *_predict_* and *_begin, and released by *_free, which accept NULL. A function that
 * can fail returns a status; daumier_last_error() then has the cause and the repair, and no argument has been written.
 *
 * Buffers belong to the caller. Their size is given in elements and has to be exact, so that a wrong one is an error; strokes and
 * pixels have the sizes that their counts say. A buffer that is written may not overlap one that is read, unless the function says so. Strings are UTF-8 and belong to
 * the library.
 *
 * Threads: the const functions of one object may be called from several threads at once, others from one thread at a time. Objects
 * are independent of each other, but an object must be freed after those made from it, unless the function says so. The library
 * starts one worker a core less one, at its first use, which every object shares; call nothing after fork() in the child.
 *
 * Coordinates of faces are centimetres, at most 10,000, x to the face's own left, y up, z to the front; of drawings and pictures pixels, x to the
 * right, y down.
 */
#ifndef DAUMIER_H
#define DAUMIER_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define DAUMIER_API __attribute__((visibility("default")))
#else
#define DAUMIER_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum daumier_status {
  DAUMIER_OK = 0,
  DAUMIER_FAILED = 1, /* The work failed: a damaged file, a picture without a face. */
  DAUMIER_MISUSED = 2 /* An argument is wrong: NULL, a size, a name. */
} daumier_status;

/* The version of the library, "0.2.0". */
DAUMIER_API const char* daumier_version(void);

/* The cause of the last status of this thread that was not DAUMIER_OK; "" before the first. Valid until the next call of this thread
 * that fails. */
DAUMIER_API const char* daumier_last_error(void);

typedef enum daumier_log_level { DAUMIER_LOG_INFO = 1, DAUMIER_LOG_WARNING = 2, DAUMIER_LOG_OFF = 4 } daumier_log_level;

/* What the library writes to stderr, of the process; at first nothing. */
DAUMIER_API daumier_status daumier_set_log_level(daumier_log_level level);

/* ---- Faces from drawings and portraits ---------------------------------------------------------------------------------------- */

typedef struct daumier_predictor daumier_predictor;
typedef struct daumier_face daumier_face;

/* Opens a network. weights: a folder of weights or a finished run that has a graph, or the name of shipped weights: "sketch-ict" for
 * drawings, "portrait" for pictures of faces. These are searched in $DAUMIER_WEIGHTS, or in `weights` and `share/daumier/weights` of the
 * library's folder and of those above it. FAILED if a file is missing or damaged; MISUSED if nothing has that name. */
DAUMIER_API daumier_status daumier_predictor_open(const char* weights, daumier_predictor** predictor);
DAUMIER_API void daumier_predictor_free(daumier_predictor* predictor);

/* A drawing as polylines. */
typedef struct daumier_strokes {
  const float* points;  /* x y of each point, stroke after stroke */
  const int32_t* sizes; /* points of each stroke, at least 1 */
  int32_t num_strokes;
  float width, height; /* of the sheet, in the unit of the points */
} daumier_strokes;

/* The face of a drawing; of several on one sheet the largest, with a warning. FAILED if there is none; MISUSED if the network
 * reads no strokes. Equal drawings give equal faces. */
DAUMIER_API daumier_status daumier_predict_strokes(const daumier_predictor* predictor, const daumier_strokes* strokes,
                                                   daumier_face** face);

/* The face in a picture: a portrait, or a picture of a line drawing, as the network reads. pixels: row_bytes * height bytes, rows from
 * the top, sRGB; channels: 1 grey, 3 RGB, 4 RGBA, of which transparency is laid over white. */
DAUMIER_API daumier_status daumier_predict_pixels(const daumier_predictor* predictor, const uint8_t* pixels,
                                                  int32_t width, int32_t height, int32_t channels, size_t row_bytes,
                                                  daumier_face** face);

/* The face of a file: a drawing (SVG, Xournal++, InkML) or a picture (PNG, JPEG, WebP, BMP, TIFF), as the network reads. */
DAUMIER_API daumier_status daumier_predict_file(const daumier_predictor* predictor, const char* path,
                                                daumier_face** face);

/* A face is independent of its predictor, which may be freed first. V and F are 0 where the network makes no mesh. */
DAUMIER_API void daumier_face_free(daumier_face* face);
DAUMIER_API size_t daumier_face_num_vertices(const daumier_face* face);
DAUMIER_API size_t daumier_face_num_triangles(const daumier_face* face);
/* xyz: 3V numbers, cm. */
DAUMIER_API daumier_status daumier_face_vertices(const daumier_face* face, float* xyz, size_t size);
/* corners: 3F vertices, counter-clockwise from outside. The same for all faces of a predictor. */
DAUMIER_API daumier_status daumier_face_triangles(const daumier_face* face, int32_t* corners, size_t size);
/* xyz: 3 * 68 numbers, cm, in the order of iBUG; NaN where the template has no such point. No numbers where there is no mesh. */
DAUMIER_API daumier_status daumier_face_landmarks(const daumier_face* face, float* xyz, size_t size);
/* What is doubtful, a sentence each; NULL past the last. Valid while the face is. */
DAUMIER_API size_t daumier_face_num_warnings(const daumier_face* face);
DAUMIER_API const char* daumier_face_warning(const daumier_face* face, size_t index);
/* Numbers of the prediction as JSON, those of the entry of a drawing in predict's manifest (docs/formats.md). Valid while the face is. */
DAUMIER_API const char* daumier_face_record(const daumier_face* face);

/* ---- Deformable faces ----------------------------------------------------------------------------------------------------------- */

typedef struct daumier_model daumier_model;
typedef struct daumier_edit daumier_edit;

/* Opens a deformable model. folder: a finished run of the task `deform`, a folder of faces, or weights of a face model, by their folder or
 * name; NULL: the shipped face model, of whose topology predicted faces are. */
DAUMIER_API daumier_status daumier_model_open(const char* folder, daumier_model** model);
DAUMIER_API void daumier_model_free(daumier_model* model);
DAUMIER_API size_t daumier_model_num_vertices(const daumier_model* model);
DAUMIER_API size_t daumier_model_num_triangles(const daumier_model* model);
/* corners: 3F vertices, counter-clockwise from outside. */
DAUMIER_API daumier_status daumier_model_triangles(const daumier_model* model, int32_t* corners, size_t size);

/* The vertex of a landmark, 0 to 67 in the order of iBUG (30: the tip of the nose); -1 where the model has none. */
DAUMIER_API int32_t daumier_model_landmark(const daumier_model* model, int32_t landmark);

/* M, the size of a code. Codes are standardised: 0 is the mean face, and each number varies by 1 over the model's own faces. */
DAUMIER_API size_t daumier_model_num_numbers(const daumier_model* model);
/* code: M numbers -> xyz: 3V numbers, cm. */
DAUMIER_API daumier_status daumier_model_decode(const daumier_model* model, const float* code, size_t num_numbers,
                                                float* xyz, size_t size);
/* xyz: 3V numbers, cm -> code: M numbers of the face of the model nearest to it, where smaller codes are slightly preferred. */
DAUMIER_API daumier_status daumier_model_encode(const daumier_model* model, const float* xyz, size_t size, float* code,
                                                size_t num_numbers);
/* The automatic caricature: the face's difference from the mean grows by `strength`, 0 to 2. exaggerated: 3V numbers; may be xyz. */
DAUMIER_API daumier_status daumier_model_exaggerate(const daumier_model* model, const float* xyz, size_t size,
                                                    float strength, float* exaggerated, size_t exaggerated_size);

/* The time of an edit grows faster than the number of its handles. */
#define DAUMIER_MOST_HANDLES 200

/* Begins an edit of a face by handles, to be moved as often as a pen moves. vertices: num_handles different ones. is_local: other parts of
 * the face than those of the handles stay. The model has to outlive it. */
DAUMIER_API daumier_status daumier_edit_begin(const daumier_model* model, const float* xyz, size_t size,
                                              const int32_t* vertices, size_t num_handles, int is_local,
                                              daumier_edit** edit);
DAUMIER_API void daumier_edit_free(daumier_edit* edit);
/* The face with its handles displaced from where they were at first, each to within 5 % of the largest move where the model can follow. moves: 3 * num_handles numbers, cm; xyz: 3V numbers. Moves of 0 give the
 * face itself. */
DAUMIER_API daumier_status daumier_edit_move(daumier_edit* edit, const float* moves, size_t num_moves, float* xyz,
                                             size_t size);

/* ---- Rigged heads --------------------------------------------------------------------------------------------------------------- */

typedef struct daumier_rig daumier_rig;
typedef struct daumier_head daumier_head;

/* Opens the rig of a topology. face_model: weights of a face model, by their folder or name; NULL: the shipped one. */
DAUMIER_API daumier_status daumier_rig_open(const char* face_model, daumier_rig** rig);
DAUMIER_API void daumier_rig_free(daumier_rig* rig);

/* The vertices of a predicted face without the expression that it shows. Predictions of portraits state one; faces of drawings are returned as
 * they are. xyz: 3V numbers, cm. MISUSED if the face is of another topology. */
DAUMIER_API daumier_status daumier_rig_neutral(const daumier_rig* rig, const daumier_face* face, float* xyz,
                                               size_t size);

/* A head of a neutral face, with eyes, teeth and a target for each of ARKit's 52 expressions. xyz: 3V numbers, cm, of the topology. The head
 * is independent of its rig. */
DAUMIER_API daumier_status daumier_rig_head(const daumier_rig* rig, const float* xyz, size_t size, daumier_head** head);
DAUMIER_API void daumier_head_free(daumier_head* head);

/* The mesh of the head without its eyes: N vertices, T triangles. */
DAUMIER_API size_t daumier_head_num_vertices(const daumier_head* head);
DAUMIER_API size_t daumier_head_num_triangles(const daumier_head* head);
DAUMIER_API daumier_status daumier_head_vertices(const daumier_head* head, float* xyz, size_t size);
DAUMIER_API daumier_status daumier_head_triangles(const daumier_head* head, int32_t* corners, size_t size);
/* 52 targets; their names as ARKit writes them, NULL past the last. Valid while the head is. */
DAUMIER_API size_t daumier_head_num_targets(const daumier_head* head);
DAUMIER_API const char* daumier_head_target_name(const daumier_head* head, size_t target);
/* offsets: 3N numbers, cm, that the target adds at its full weight. */
DAUMIER_API daumier_status daumier_head_target(const daumier_head* head, size_t target, float* offsets, size_t size);
/* Writes a .glb or .vrm file by the extension, whole or not at all; a file that is there is replaced. */
DAUMIER_API daumier_status daumier_head_write(const daumier_head* head, const char* path);

#ifdef __cplusplus
}
#endif
#endif

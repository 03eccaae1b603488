import { check } from "./error.js";

/** The camera of the training sketches, from details of shipped weights: render/camera.h. */
export interface Camera {
  readonly camera_from_world: readonly number[];
  readonly translation: readonly number[];
  readonly scale: number;
  readonly principal_point: readonly number[];
}

/** @throws DaumierError if it is malformed or not orthographic. */
export function checkedCamera(json: unknown, file: string): Camera {
  const camera = json as Partial<Camera> & { perspective?: boolean };
  const isComplete = camera?.camera_from_world?.length === 9 && camera.translation?.length === 3 && camera.principal_point?.length === 2 && typeof camera.scale === "number";
  check(isComplete && camera.perspective !== true, file, "details.sketches.camera is malformed", "Copy the weights again");
  return camera as Camera;
}

/** x, y in pixels of the canvas of each vertex. vertices: x, y, z in cm. */
export function project(camera: Camera, vertices: ArrayLike<number>): Float64Array {
  const { camera_from_world: r, translation: t, scale, principal_point: centre } = camera, projected = new Float64Array((2 * vertices.length) / 3);
  for (let v = 0; v < vertices.length / 3; ++v)
    for (let axis = 0; axis < 2; ++axis) {
      const along = r[3 * axis]! * vertices[3 * v]! + r[3 * axis + 1]! * vertices[3 * v + 1]! + r[3 * axis + 2]! * vertices[3 * v + 2]! + t[axis]!;
      projected[2 * v + axis] = along * scale + centre[axis]!;
    }
  return projected;
}

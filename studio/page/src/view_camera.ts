// Where the camera of the 3-D view is: a pose that a person turns, about a head that fills a share of the view.
import { type PerspectiveCamera, Vector3 } from "three";
import type { OrbitPose } from "./orbit";

export const kFieldOfView = 22;
/** Share of the height of the view that the head fills. */
const kFill = 0.9;

/** What is to be seen: the middle of a head and half its height. */
export interface Frame {
  centre: Vector3;
  halfHeight: number;
}

export function placeCamera(camera: PerspectiveCamera, frame: Frame, pose: OrbitPose, width: number, height: number): void {
  camera.aspect = width / height;
  // A narrow view must hold the width of the head, which is about 0.85 of its height.
  const half = frame.halfHeight / kFill / pose.zoom / Math.min(1, camera.aspect / 0.85);
  const distance = half / Math.tan((Math.PI * kFieldOfView) / 360) + frame.halfHeight * 0.5;
  const yaw = (Math.PI * pose.yaw) / 180;
  const pitch = (Math.PI * pose.pitch) / 180;
  const direction = new Vector3(Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch));
  camera.position.copy(frame.centre).addScaledVector(direction, distance);
  camera.lookAt(frame.centre);
  camera.updateMatrixWorld();
  camera.position.add(new Vector3(-pose.pan[0] * half, pose.pan[1] * half, 0).applyQuaternion(camera.quaternion));
  camera.near = Math.max(distance * 0.05, 1e-3);
  camera.far = distance * 4;
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
}

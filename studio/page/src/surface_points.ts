// Round points that lie on the surface of the head.
import { BufferGeometry, CanvasTexture, Points, PointsMaterial } from "three";
import { el } from "./dom";

/** Centimetres by which a point is nearer to the eye than its place, so that the surface about it hides no part of the disc. */
const kNearer = 0.7;

let disc: CanvasTexture | null = null;

/** size: diameter in pixels of the screen. */
export function surfacePoints(colour: number, size: number): Points {
  disc ??= discTexture();
  const material = new PointsMaterial({ color: colour, size, sizeAttenuation: false, map: disc, alphaTest: 0.5 });
  material.onBeforeCompile = (shader) => {
    // Along the ray to the eye, so that its place on the screen is the same.
    shader.vertexShader = shader.vertexShader.replace(
      "#include <project_vertex>",
      `#include <project_vertex>
      if (isPerspectiveMatrix(projectionMatrix)) mvPosition.xyz *= 1.0 - ${kNearer.toFixed(2)} / length(mvPosition.xyz);
      else mvPosition.z += ${kNearer.toFixed(2)};
      gl_Position = projectionMatrix * mvPosition;`,
    );
  };
  const made = new Points(new BufferGeometry(), material);
  made.frustumCulled = false;
  made.renderOrder = 1;
  return made;
}

/** A white disc. */
function discTexture(): CanvasTexture {
  const canvas = el("canvas", { width: 32, height: 32 });
  const context = canvas.getContext("2d");
  if (context) {
    context.fillStyle = "#fff";
    context.arc(16, 16, 15, 0, 7);
    context.fill();
  }
  return new CanvasTexture(canvas);
}

import { check } from "./error.js";
import { type Folder, readJson } from "./folder.js";
import { Safetensors } from "./safetensors.js";

/** The mesh of all faces of a model: template.safetensors and template.json (docs/formats.md). */
export interface FaceTemplate {
  /** Mean neutral face: x, y, z of each vertex in cm, y up, facing +z. */
  readonly neutral: Float32Array;
  /** Three vertices each, counter-clockwise seen from outside; open at lips, eyes and neck. */
  readonly triangles: Uint32Array;
  /** Close the eyes and the lips. */
  readonly closingTriangles: Uint32Array;
  /** 68 vertices in iBUG order. */
  readonly landmarks: readonly number[];
  /** Feature curves: paths of vertices, by name. */
  readonly curves: Readonly<Record<string, readonly number[]>>;
  /** Name of the source of the faces. */
  readonly source: string;
}

/** @throws DaumierError if a file is missing or malformed. */
export async function readFaceTemplate(folder: Folder): Promise<FaceTemplate> {
  const file = `${folder.name}/template.safetensors`, text = `${folder.name}/template.json`;
  const [bytes, json] = await Promise.all([folder.read("template.safetensors"), readJson(folder, "template.json")]);
  const arrays = new Safetensors(file, bytes);
  const { format_version: version, landmarks, curves, source } =
    json as { format_version?: unknown; landmarks?: number[]; curves?: { name: string; vertices: number[] }[]; source?: string };
  check(version === 1 || version === 2, text, `its version is ${String(version)} (expected 1 or 2)`, "Install a newer daumier-web");
  const repair = "Export the model again";
  const neutral = arrays.floats("neutral"), numVertices = neutral.length / 3;
  const inside = (vertices: number[] | Int32Array): boolean => vertices.every((v) => Number.isInteger(v) && v >= 0 && v < numVertices);
  check(Array.isArray(landmarks) && landmarks.length === 68 && inside(landmarks), text, "it has no 68 landmarks on the mesh", repair);
  check(Array.isArray(curves) && curves.every(({ vertices }) => inside(vertices)), text, "it has no feature curves on the mesh", repair);
  const triangles = arrays.integers("triangles"), closing = arrays.integers("closing_triangles");
  check(triangles.length % 3 === 0 && inside(triangles) && inside(closing), file, "triangles have corners that are no vertices", repair);
  return {
    neutral, triangles: Uint32Array.from(triangles), closingTriangles: Uint32Array.from(closing), landmarks,
    curves: Object.fromEntries(curves.map(({ name, vertices }) => [name, vertices])), source: source ?? "",
  };
}

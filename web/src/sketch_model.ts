import { checkOpening, described, isObject, refuseWithoutPixels } from "./arguments.js";
import { Calls } from "./calls.js";
import { type Camera, checkedCamera, project } from "./camera.js";
import { checkedStrokes, checkFrame, composed, type Drawing, inverse, mapToCanvas, type Placement, type Stroke, sheetPlacement, toCanvas } from "./drawing.js";
import { DrawingParser } from "./drawing_parser.js";
import { check } from "./error.js";
import { findFaceFrame } from "./face_frame.js";
import { type FacePointVertices, findFacePoints } from "./face_points.js";
import { type FaceTemplate, readFaceTemplate } from "./face_template.js";
import { largestFace } from "./faces_on_sheet.js";
import { type Folder, folderAt, type Place } from "./folder.js";
import { withoutFarMarks } from "./framing.js";
import { type FloatArray, type Manifest, Network, type OrtModule, outputOf, readManifest, readNumbers, type SessionOptions } from "./network.js";
import { linesOfFace, parseWarnings, type ParsedDrawing, refuseProfile } from "./parsed_drawing.js";
import { type Picture, readPicture } from "./picture.js";
import { inkOf, sampleRows } from "./raster.js";
import type { Safetensors } from "./safetensors.js";
import { sparseStrokes } from "./sparse_strokes.js";

export interface SketchOptions {
  /**
   * parser (default): a parser of drawings finds the face on the sheet, as `daumier predict --no-fit`. canvas: the sheet is the canvas of the
   * training's sketches, as `daumier predict --keep-frame --no-refine`; all that an export of a run can do.
   */
  framing?: "parser" | "canvas";
  /** Folder of the parser; default: `parser` next to the model. */
  parser?: Place;
  session?: SessionOptions;
}

/** A predicted face. */
export interface SketchFace {
  /** x, y, z of each vertex of the template in cm: to the face's own left, up, to the front. */
  readonly vertices: Float32Array;
  /** Coefficients by the name of the network's output: `u` identity, `v` expression, `residual` where it has one. */
  readonly coefficients: Readonly<Record<string, Float32Array>>;
  /** From the sheet to the canvas that the network saw. */
  readonly frame: Placement;
  /** With framing by a parser. */
  readonly parsed?: ParsedDrawing;
  readonly warnings: readonly string[];
}

/** What the network gives. */
export interface NetworkFace {
  vertices: Float32Array;
  coefficients: Record<string, Float32Array>;
}

/** What framing by a parser needs in addition. */
interface Framing {
  parser: DrawingParser;
  points: FacePointVertices;
  /** The mean face on the canvas. */
  projected: Float64Array;
}

/** mean = basis^T coefficients, of shipped weights. */
function meanFace(basis: Float32Array, coefficients: readonly number[]): Float32Array {
  const size = basis.length / coefficients.length, sum = new Float64Array(size);
  coefficients.forEach((coefficient, row) => {
    for (let i = 0; i < size; ++i) sum[i]! += coefficient * basis[row * size + i]!;
  });
  return Float32Array.from(sum);
}

async function openFraming(ort: OrtModule, folder: Folder, manifest: Manifest, template: FaceTemplate, numbers: Safetensors | undefined, options: SketchOptions): Promise<Framing> {
  const file = `${folder.name}/manifest.json`;
  const { sketches, gaussian } = manifest.details as { sketches?: { camera?: unknown }; gaussian?: { mean?: number[] } };
  check(numbers !== undefined, file, "an export has no camera and no mean face, by which drawings are framed",
    'Draw on the canvas of the training\'s sketches and give framing: "canvas", or use shipped weights (daumier export RUN --weights)');
  check(Array.isArray(gaussian?.mean), file, "details.gaussian.mean is missing", "Copy the weights again");
  const camera: Camera = checkedCamera(sketches?.camera, file);
  const mean = meanFace(numbers.floats("basis"), gaussian.mean);
  check(mean.length === template.neutral.length, numbers.file, `faces of 'basis' have ${mean.length / 3} vertices (expected ${template.neutral.length / 3})`, "Copy the weights again");
  const parser = await DrawingParser.open(ort, folderAt(options.parser ?? folder.neighbour("parser")), options.session);
  return { parser, points: findFacePoints(template), projected: project(camera, mean) };
}

/** A drawing as given, or the lines of a picture. @throws DaumierError if it is neither. */
function readInput(input: unknown): { drawing: Drawing; warnings: string[] } {
  refuseWithoutPixels(input, "drawing");
  if (isObject(input) && "data" in input) return readPicture(input as unknown as Picture);
  return { drawing: input as Drawing, warnings: [] };
}

/** From drawings to faces, by a network that reads sketches or points. */
export class SketchModel {
  private constructor(private readonly network: Network, readonly template: FaceTemplate, private readonly framing: Framing | undefined, private readonly calls: Calls) {}

  /**
   * place: shipped weights, next to their face model and `parser`, or the export of a run.
   * @throws DaumierError naming file, cause and repair.
   */
  static async open(ort: OrtModule, place: Place, options: SketchOptions = {}): Promise<SketchModel> {
    checkOpening(ort, place);
    const given: unknown = options;
    check(isObject(given) && [undefined, "parser", "canvas"].includes(options.framing), "options", isObject(given) ? `framing is ${described(options.framing)}` : `they are ${described(given)}`,
      'Give {framing: "parser"} (the default) or {framing: "canvas"}');
    const folder = folderAt(place), manifest = await readManifest(folder, "sketch"), file = `${folder.name}/manifest.json`;
    const model = manifest.details["face_model"];
    check(manifest.kind === "export" || typeof model === "string", file, "details.face_model is missing", "Copy the weights again");
    const template = await readFaceTemplate(manifest.kind === "export" ? folder : folder.neighbour(String(model)));
    const numbers = manifest.kind === "export" ? undefined : await readNumbers(folder);
    const framing = options.framing === "canvas" ? undefined : await openFraming(ort, folder, manifest, template, numbers, options);
    const network = await Network.open(ort, folder, manifest, options.session, numbers);
    const readable = network.inputNames.filter((name) => name === "sketch" || name === "points");
    network.requireNames(readable.length > 0 ? readable : ["sketch"], ["u", "v", "vertices"]);
    return new SketchModel(network, template, framing, new Calls(folder.name));
  }

  /** The face of a drawing, or of a picture of one. @throws DaumierError if it is empty or shows a profile. */
  predict(input: Drawing | Picture): Promise<SketchFace> {
    return this.calls.run(() => this.predictNow(input));
  }

  private async predictNow(input: Drawing | Picture): Promise<SketchFace> {
    const { drawing, warnings } = readInput(input), strokes = checkedStrokes(drawing);
    if (this.framing === undefined) {
      const frame = sheetPlacement(drawing);
      return { ...(await this.faceOnCanvas(mapToCanvas(sparseStrokes(strokes, frame.scale), frame))), frame, warnings };
    }
    const largest = largestFace(strokes), near = withoutFarMarks(largest.strokes);
    const { parser, points, projected } = this.framing, parsed = await parser.parse(sparseStrokes(near.strokes, near.scale));
    refuseProfile(parsed);
    const onCanvas = parsed.points.map((point) => toCanvas(parsed.frame, point));
    const frame = composed(inverse(findFaceFrame(points, projected, onCanvas, parsed.confidences)), parsed.frame);
    const face = await this.faceOnCanvas(mapToCanvas(linesOfFace(parsed), frame));
    warnings.push(...parseWarnings(parsed));
    if (largest.numFaces > 1) warnings.push(`the sheet holds ${largest.numFaces} faces, of which the largest is predicted`);
    if (largest.numLeftOut > 0) warnings.push(`${largest.numLeftOut} strokes apart from the face are left out`);
    return { ...face, frame, parsed, warnings };
  }

  /** While a line is drawn: the network alone, in the frame of an earlier prediction; all lines count as the face's. */
  preview(drawing: Drawing, frame: Placement): Promise<SketchFace> {
    return this.calls.run(async () => {
      const strokes = checkedStrokes(drawing);
      checkFrame(frame, drawing, strokes);
      return { ...(await this.faceOnCanvas(mapToCanvas(strokes, frame))), frame, warnings: [] };
    });
  }

  /** The network alone, of strokes on the canvas. */
  faceOf(strokes: readonly Stroke[]): Promise<NetworkFace> {
    return this.calls.run(() => this.faceOnCanvas(strokes));
  }

  private async faceOnCanvas(strokes: readonly Stroke[]): Promise<NetworkFace> {
    const inputs: Record<string, FloatArray> = {};
    if (this.network.inputNames.includes("sketch")) {
      const [, , side] = this.network.inputShape("sketch");
      check(side !== undefined, this.network.file, "the size of its pictures is not fixed", "Export the run again");
      inputs["sketch"] = { data: inkOf(strokes, side), shape: [1, 1, side, side] };
    }
    if (this.network.inputNames.includes("points")) {
      const [, , count] = this.network.inputShape("points");
      check(count !== undefined, this.network.file, "the number of its points is not fixed", "Export the run again");
      inputs["points"] = { data: sampleRows(strokes, count), shape: [1, 4, count] };
    }
    return this.runNetwork(inputs);
  }

  /** The network alone. @throws DaumierError if an input has another size than the network's. */
  faceOfInputs(inputs: Readonly<Record<string, FloatArray>>): Promise<NetworkFace> {
    return this.calls.run(() => this.runNetwork(inputs));
  }

  private async runNetwork(inputs: Readonly<Record<string, FloatArray>>): Promise<NetworkFace> {
    for (const [name, { shape }] of Object.entries(inputs)) {
      const expected = this.network.inputShape(name).map((side) => side ?? 1);
      check(shape.join() === expected.join(), name, `it is ${shape.join(" x ")} (expected ${expected.join(" x ")})`, "Give the size that the network reads");
    }
    const outputs = await this.network.run(inputs), { data: vertices, shape } = outputOf(outputs, "vertices", this.network);
    check(vertices.length === this.template.neutral.length, this.network.file, `its faces are ${shape.join(" x ")} (expected ${this.template.neutral.length / 3} vertices, as the template)`,
      "Give the model and the template of one export");
    const coefficients: Record<string, Float32Array> = {};
    for (const [name, { data }] of Object.entries(outputs)) if (name !== "vertices") coefficients[name] = data;
    return { vertices, coefficients };
  }

  /** Frees the memory of the networks, after the calls that run. */
  release(): Promise<void> {
    return this.calls.release(async () => {
      await this.network.release();
      await this.framing?.parser.release();
    });
  }
}

/** SketchModel.open */
export function openSketchModel(ort: OrtModule, place: Place, options?: SketchOptions): Promise<SketchModel> {
  return SketchModel.open(ort, place, options);
}

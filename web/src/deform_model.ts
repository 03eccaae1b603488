import { checkOpening, described, tagOf } from "./arguments.js";
import { Calls } from "./calls.js";
import { check } from "./error.js";
import { type FaceTemplate, readFaceTemplate } from "./face_template.js";
import { folderAt, type Place } from "./folder.js";
import { Network, type OrtModule, outputOf, readManifest, type SessionOptions } from "./network.js";
import { Safetensors } from "./safetensors.js";

/** p_model = scale p_cm + offset. */
interface ModelFrame {
  readonly scale: number;
  readonly offset: readonly [number, number, number];
}

function checkedFrame(json: unknown, file: string): ModelFrame {
  const { scale, offset } = (json ?? {}) as { scale?: number; offset?: number[] };
  check(typeof scale === "number" && scale > 0 && offset?.length === 3 && offset.every(Number.isFinite), file, "details.model_from_cm is missing or malformed",
    "Export the run again: daumier export RUN --out FOLDER");
  return { scale, offset: offset as unknown as [number, number, number] };
}

/** A deformable model of heads: a code to a surface. */
export class DeformModel {
  private constructor(
    private readonly network: Network,
    readonly template: FaceTemplate,
    private readonly frame: ModelFrame,
    private readonly points: Float32Array,
    /** Numbers of a code. */
    readonly codeLength: number,
    private readonly calls: Calls,
  ) {}

  /** place: the export of a run of the task `deform`. @throws DaumierError naming file, cause and repair. */
  static async open(ort: OrtModule, place: Place, session?: SessionOptions): Promise<DeformModel> {
    checkOpening(ort, place);
    const folder = folderAt(place), manifest = await readManifest(folder, "deform");
    check(manifest.kind === "export", `${folder.name}/manifest.json`, "this is no export", "Make one: daumier export RUN --out FOLDER");
    const frame = checkedFrame(manifest.details["model_from_cm"], `${folder.name}/manifest.json`);
    const template = await readFaceTemplate(folder), network = await Network.open(ort, folder, manifest, session);
    const readsPoints = network.inputNames.includes("points");
    network.requireNames(readsPoints ? ["latent", "points"] : ["latent"], [readsPoints ? "positions" : "vertices"]);
    const points = new Safetensors(`${folder.name}/points_template.safetensors`, await folder.read("points_template.safetensors")).floats("vertices");
    const [, codeLength] = network.inputShape("latent");
    check(codeLength !== undefined, network.file, "the length of its codes is not fixed", "Export the run again");
    return new DeformModel(network, template, frame, points, codeLength, new Calls(folder.name));
  }

  /** x, y, z of each vertex in cm. @throws DaumierError unless the code has `codeLength` finite numbers. */
  decode(latent: Float32Array): Promise<Float32Array> {
    return this.calls.run(() => this.decodeNow(latent));
  }

  private async decodeNow(latent: Float32Array): Promise<Float32Array> {
    check(tagOf(latent) === "Float32Array" || Array.isArray(latent), "latent", `it is ${described(latent)} (expected a Float32Array of ${this.codeLength})`, "Give Float32Array.from(code)");
    check(latent.length === this.codeLength && latent.every(Number.isFinite), "latent", `${latent.length} numbers are no code (expected ${this.codeLength} finite ones)`,
      "Give a code of the training faces, or of edit.json (`latent`)");
    const code = { data: Float32Array.from(latent), shape: [1, this.codeLength] };
    const readsPoints = this.network.inputNames.includes("points");
    const outputs = await this.network.run(readsPoints ? { latent: code, points: { data: this.points, shape: [this.points.length / 3, 3] } } : { latent: code });
    const positions = outputOf(outputs, readsPoints ? "positions" : "vertices", this.network).data, { scale, offset } = this.frame, expected = this.template.neutral.length;
    check(positions.length === expected, this.network.file, `it has ${positions.length / 3} vertices (expected ${expected / 3})`, "Export the run again");
    return positions.map((value, i) => (value - offset[i % 3]!) / scale);
  }

  /** Frees the memory of the network, after the calls that run. */
  release(): Promise<void> {
    return this.calls.release(() => this.network.release());
  }
}

/** DeformModel.open */
export function openDeformModel(ort: OrtModule, place: Place, session?: SessionOptions): Promise<DeformModel> {
  return DeformModel.open(ort, place, session);
}

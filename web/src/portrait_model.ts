import { checkOpening } from "./arguments.js";
import { Calls } from "./calls.js";
import { check } from "./error.js";
import { type FaceTemplate, readFaceTemplate } from "./face_template.js";
import { type Folder, folderAt, type Place } from "./folder.js";
import { type Manifest, Network, type OrtModule, outputOf, readManifest, type SessionOptions } from "./network.js";
import { checkPicture, type Picture } from "./picture.js";
import { colourPlanes, cropOfLandmarks, cropOfWhole, cropped, type PictureMap } from "./portrait_crop.js";
import { Safetensors } from "./safetensors.js";
import { readScaledShapes } from "./scaled_shapes.js";

const kSlots = { identity: [0, 80], expression: [80, 64], albedo: [144, 80], light: [224, 9], pose: [233, 6] } as const;
const kNumCoefficients = 239;

export interface PortraitFace {
  /** x, y, z of each vertex in cm, upright: the pose is in `coefficients`. */
  readonly vertices: Float32Array;
  /** identity (80), expression (64), albedo (80), light (9), pose (6): pitch, yaw, roll in radians, translation in cm. */
  readonly coefficients: Readonly<Record<keyof typeof kSlots, Float32Array>>;
  /** From the picture to the crop of 224 x 224 that the network saw. */
  readonly map: PictureMap;
  readonly warnings: readonly string[];
}

/** mean + sum of modes. */
interface MorphableModel {
  readonly mean: Float32Array;
  readonly identity: readonly Float32Array[];
  readonly expression: readonly Float32Array[];
}

function columnsOf(arrays: Safetensors, name: string): Float32Array[] {
  const numbers = arrays.floats(name), count = arrays.at(name).shape[1] ?? 0, size = count > 0 ? numbers.length / count : 0;
  return Array.from({ length: count }, (_, k) => Float32Array.from({ length: size }, (__, i) => numbers[i * count + k]!));
}

async function readExportedModel(folder: Folder, template: FaceTemplate): Promise<MorphableModel> {
  const arrays = new Safetensors(`${folder.name}/morphable.safetensors`, await folder.read("morphable.safetensors"));
  const centre = arrays.floats("centre");
  return { mean: template.neutral.map((value, i) => value + centre[i % 3]!), identity: columnsOf(arrays, "identity"), expression: columnsOf(arrays, "expression") };
}

async function readShippedModel(folder: Folder, faceModel: Folder, template: FaceTemplate): Promise<MorphableModel> {
  const own = new Safetensors(`${folder.name}/identity.safetensors`, await folder.read("identity.safetensors"));
  const shapes = new Safetensors(`${faceModel.name}/shapes.safetensors`, await faceModel.read("shapes.safetensors"));
  const offset = own.floats("mean");
  check(offset.length === template.neutral.length, own.file, `'mean' has ${offset.length / 3} vertices (expected ${template.neutral.length / 3})`, "Copy the weights and their face model again");
  return { mean: template.neutral.map((value, i) => value + offset[i]!), identity: readScaledShapes(own, "identity"), expression: readScaledShapes(shapes, "expression") };
}

/** From portraits to faces of a 3DMM: the coarse face of `daumier predict`. */
export class PortraitModel {
  private constructor(private readonly network: Network, readonly template: FaceTemplate, private readonly model: MorphableModel, private readonly side: number,
    private readonly pictures: { crop: string; size: number }, private readonly calls: Calls) {}

  /** place: shipped weights next to their face model, or the export of a run. @throws DaumierError naming file, cause and repair. */
  static async open(ort: OrtModule, place: Place, session?: SessionOptions): Promise<PortraitModel> {
    checkOpening(ort, place);
    const folder = folderAt(place), manifest: Manifest = await readManifest(folder, "portrait"), isExport = manifest.kind === "export";
    const { face_model: name } = manifest.details as { face_model?: string };
    const { pictures } = (isExport ? manifest.config : manifest.details) as { pictures?: { crop?: string; size?: number } };
    check((isExport || typeof name === "string") && typeof pictures?.crop === "string" && typeof pictures.size === "number", `${folder.name}/manifest.json`,
      "details.face_model or the options of pictures are missing", "Copy the model again");
    const crop = { crop: pictures.crop, size: pictures.size };
    const faceModel = isExport ? folder : folder.neighbour(name!), template = await readFaceTemplate(faceModel);
    const model = await (isExport ? readExportedModel(folder, template) : readShippedModel(folder, faceModel, template));
    const network = await Network.open(ort, folder, manifest, session);
    network.requireNames(["crop"], ["coefficients"]);
    const [, , side] = network.inputShape("crop");
    check(side !== undefined && side <= 224, network.file, `it reads crops of ${side} pixels (expected at most 224)`, "Export the run again");
    return new PortraitModel(network, template, model, side, crop, new Calls(folder.name));
  }

  /**
   * landmarks: 68 of iBUG order in pixels of the picture, x0 y0 x1 y1 ...; without them the whole picture counts as the face.
   * @throws DaumierError if the picture or the landmarks are malformed.
   */
  predict(picture: Picture, landmarks?: ArrayLike<number>): Promise<PortraitFace> {
    return this.calls.run(() => this.predictNow(picture, landmarks));
  }

  private async predictNow(picture: Picture, landmarks?: ArrayLike<number>): Promise<PortraitFace> {
    checkPicture(picture);
    const map = landmarks === undefined || this.pictures.crop === "none" ? cropOfWhole(picture) : cropOfLandmarks(landmarks, this.pictures.size);
    const { side } = this, planes = colourPlanes(cropped(picture, map), side);
    const { data, shape } = outputOf(await this.network.run({ crop: { data: planes, shape: [1, 3, side, side] } }), "coefficients", this.network);
    check(data.length === kNumCoefficients, this.network.file, `it has coefficients of ${shape.join(" x ")} (expected ${kNumCoefficients})`, "Export the run again");
    const slot = ([first, count]: readonly [number, number]): Float32Array => data.slice(first, first + count);
    const coefficients = { identity: slot(kSlots.identity), expression: slot(kSlots.expression), albedo: slot(kSlots.albedo), light: slot(kSlots.light), pose: slot(kSlots.pose) };
    const warnings = landmarks === undefined ? ["no landmarks were given, so that the whole picture counts as the face"] : [];
    return { vertices: this.reconstruct(coefficients), coefficients, map, warnings };
  }

  /** The face of coefficients, in cm. */
  reconstruct({ identity, expression }: Pick<PortraitFace["coefficients"], "identity" | "expression">): Float32Array {
    const sum = Float64Array.from(this.model.mean);
    for (const [modes, weights] of [[this.model.identity, identity], [this.model.expression, expression]] as const)
      modes.forEach((mode, k) => {
        const weight = weights[k] ?? 0;
        if (weight !== 0) for (let i = 0; i < sum.length; ++i) sum[i]! += weight * mode[i]!;
      });
    return Float32Array.from(sum);
  }

  /** Frees the memory of the network, after the calls that run. */
  release(): Promise<void> {
    return this.calls.release(() => this.network.release());
  }
}

/** PortraitModel.open */
export function openPortraitModel(ort: OrtModule, place: Place, session?: SessionOptions): Promise<PortraitModel> {
  return PortraitModel.open(ort, place, session);
}

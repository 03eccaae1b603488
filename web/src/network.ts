import type * as Ort from "onnxruntime-web";
import { check, DaumierError, textOf } from "./error.js";
import { type Folder, readJson } from "./folder.js";
import { completeOnnx } from "./onnx_file.js";
import { Safetensors } from "./safetensors.js";

/** onnxruntime-web as the page imported it: any of its builds, configured by the page. */
export type OrtModule = Pick<typeof Ort, "InferenceSession" | "Tensor">;
export type SessionOptions = Ort.InferenceSession.SessionOptions;

/** Row-major numbers. */
export interface FloatArray {
  readonly data: Float32Array;
  readonly shape: readonly number[];
}

/** What is read of manifest.json. */
export interface Manifest {
  readonly kind: string;
  readonly system: string;
  readonly details: Readonly<Record<string, unknown>>;
  /** The options of the run. */
  readonly config: Readonly<Record<string, unknown>>;
}

const kExport = "Give the folder of shipped weights (weights/NAME), or make one: daumier export RUN --out FOLDER";

/** The manifest of an export or of shipped weights. @throws DaumierError if it is of another kind or task. */
export async function readManifest(folder: Folder, system: string): Promise<Manifest> {
  const file = `${folder.name}/manifest.json`;
  const json = (await readJson(folder, "manifest.json")) as Record<string, unknown> | null;
  check(json !== null && typeof json === "object" && typeof json["kind"] === "string", file, "this is no manifest of Daumier", kExport);
  check(json["format_version"] === 1, file, `its version is ${String(json["format_version"])} (expected 1)`, "Install a newer daumier-web");
  const kind = json["kind"];
  check(kind === "weights" || kind === "export", file, `this is a folder of kind '${kind}' (expected 'weights' or 'export')`, kExport);
  const details = (json["details"] ?? {}) as Record<string, unknown>;
  const config = (json["config"] ?? {}) as Record<string, unknown>;
  const found = String(details["system"] ?? config["system"] ?? system);
  check(found === system, file, `this is a model of the task '${found}' (expected '${system}')`, "Give the folder of a model of this task");
  return { kind, system: found, details, config };
}

/** The numbers of a network of shipped weights. */
export async function readNumbers(folder: Folder): Promise<Safetensors> {
  return new Safetensors(`${folder.name}/network.safetensors`, await folder.read("network.safetensors"));
}

/** A network in a session of ONNX Runtime; runs follow one another. */
export class Network {
  private last: Promise<unknown> = Promise.resolve();

  private constructor(private readonly ort: OrtModule, private readonly session: Ort.InferenceSession, readonly file: string) {}

  /** numbers: those of shipped weights, where they have been read. @throws DaumierError if a file is missing or no network that ONNX Runtime reads. */
  static async open(ort: OrtModule, folder: Folder, manifest: Manifest, options: SessionOptions = {}, numbers?: Safetensors): Promise<Network> {
    const isWhole = manifest.kind === "export", name = isWhole ? "model.onnx" : "network.onnx";
    const file = `${folder.name}/${name}`;
    let bytes = await folder.read(name);
    if (!isWhole) bytes = completeOnnx(file, bytes, numbers ?? (await readNumbers(folder)));
    try {
      return new Network(ort, await ort.InferenceSession.create(bytes, { executionProviders: ["wasm"], ...options }), file);
    } catch (error) {
      throw new DaumierError(file, `ONNX Runtime cannot open it (${textOf(error)})`,
        "If the message names a .wasm or .mjs file, serve it and set ort.env.wasm.wasmPaths; else copy the model again", { cause: error });
    }
  }

  get inputNames(): readonly string[] {
    return this.session.inputNames;
  }
  get outputNames(): readonly string[] {
    return this.session.outputNames;
  }

  /** The shape of an input, undefined where it is free. @throws DaumierError if there is no such input. */
  inputShape(name: string): (number | undefined)[] {
    const found = this.session.inputMetadata.find((each) => each.name === name);
    check(found !== undefined && found.isTensor, this.file, `the network has no input '${name}' (it has ${this.inputNames.join(", ")})`, kExport);
    return found.shape.map((side) => (typeof side === "number" && side >= 0 ? side : undefined));
  }

  /** @throws DaumierError if the network has other inputs, or lacks an output. */
  requireNames(inputs: readonly string[], outputs: readonly string[]): void {
    const same = [...this.inputNames].sort().join() === [...inputs].sort().join();
    check(same, this.file, `the network reads ${this.inputNames.join(", ")} (expected ${inputs.join(", ")})`, kExport);
    for (const name of outputs) check(this.outputNames.includes(name), this.file, `the network has no output '${name}' (it has ${this.outputNames.join(", ")})`, kExport);
  }

  /** All outputs. @throws DaumierError if the network refuses the inputs. */
  run(inputs: Readonly<Record<string, FloatArray>>): Promise<Record<string, FloatArray>> {
    const running = this.last.then(() => this.runNow(inputs));
    this.last = running.catch(() => undefined);
    return running;
  }

  private async runNow(inputs: Readonly<Record<string, FloatArray>>): Promise<Record<string, FloatArray>> {
    const tensors: Record<string, Ort.Tensor> = {};
    for (const [name, { data, shape }] of Object.entries(inputs)) tensors[name] = new this.ort.Tensor("float32", data, [...shape]);
    let found: Ort.InferenceSession.ReturnType;
    try {
      found = await this.session.run(tensors);
    } catch (error) {
      throw new DaumierError(this.file, `the network does not run (${textOf(error)})`, "Copy the model again, or free memory of the page", { cause: error });
    }
    const outputs: Record<string, FloatArray> = {};
    for (const [name, tensor] of Object.entries(found)) {
      const data = tensor.data as Float32Array;
      check(areFinite(data), this.file, `the output '${name}' has a number that is not finite`, "Copy the model again; the inputs may be too large");
      outputs[name] = { data, shape: tensor.dims };
    }
    return outputs;
  }

  /** Frees the session's memory. */
  async release(): Promise<void> {
    await this.last;
    await this.session.release();
  }
}

/** A product with 0 is NaN of infinities and NaN alone. */
function areFinite(numbers: Float32Array): boolean {
  let sum = 0;
  for (let i = 0; i < numbers.length; ++i) sum += 0 * numbers[i]!;
  return sum === 0;
}

/** @throws DaumierError naming the network if there is no such output. */
export function outputOf(outputs: Readonly<Record<string, FloatArray>>, name: string, network: Network): FloatArray {
  const output = outputs[name];
  check(output !== undefined, network.file, `the network has no output '${name}'`, kExport);
  return output;
}

/** What a page gave in the place of what is expected, in words; pages in plain JavaScript have no types. */
import { check, DaumierError } from "./error.js";

const kPixels = "context.getImageData(0, 0, canvas.width, canvas.height)";
const kFewKeys = 6;

/** The name of the class of built-in objects, also of another frame of the page: HTMLCanvasElement, Uint8Array. */
export function tagOf(value: unknown): string {
  return Object.prototype.toString.call(value).slice(8, -1);
}

/** "null", "the number 3", "an array of 2", "a HTMLCanvasElement", "an object of x, y". */
export function described(value: unknown): string {
  if (value === undefined || value === null) return String(value);
  if (typeof value === "number" || typeof value === "boolean") return `the ${typeof value} ${value}`;
  if (typeof value === "string") return `the text '${value.slice(0, 40)}'`;
  if (Array.isArray(value)) return `an array of ${value.length}`;
  if (typeof value !== "object") return `a ${typeof value}`;
  const tag = tagOf(value), keys = Object.keys(value);
  if (tag !== "Object" && tag !== "Module") return `a ${tag}`;
  return keys.length === 0 ? "an object of nothing" : `an object of ${keys.slice(0, kFewKeys).join(", ")}${keys.length > kFewKeys ? " ..." : ""}`;
}

export function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}

/** An error for what has pixels, but is not an ImageData: a canvas, its context, an image, a file. */
export function refuseWithoutPixels(value: unknown, argument: string): void {
  if (!isObject(value)) return;
  const found = `it is ${described(value)} (expected its pixels)`;
  if (typeof value["getContext"] === "function") throw new DaumierError(argument, found, `Give ${kPixels} of context = canvas.getContext("2d")`);
  if (typeof value["getImageData"] === "function") throw new DaumierError(argument, found, `Give ${kPixels}`);
  if (/^(HTML(Image|Video)Element|ImageBitmap|VideoFrame|Blob|File|SVGSVGElement)$/.test(tagOf(value)))
    throw new DaumierError(argument, found, `Draw it on a canvas (context.drawImage) and give ${kPixels}`);
}

function isOrt(value: unknown): boolean {
  const { InferenceSession, Tensor } = (isObject(value) || typeof value === "function" ? value : {}) as { InferenceSession?: { create?: unknown }; Tensor?: unknown };
  return typeof InferenceSession?.create === "function" && typeof Tensor === "function";
}

/** The first two arguments of each open function. @throws DaumierError unless they are ONNX Runtime and a place. */
export function checkOpening(ort: unknown, place: unknown): void {
  check(!(isOrt(place) && !isOrt(ort)), "ort", `it is ${described(ort)}, and the second argument is ONNX Runtime: they are swapped`, "Call open...(ort, place): ONNX Runtime first");
  check(isOrt(ort), "ort", `it is ${described(ort)} (expected the module onnxruntime-web)`, 'Give the whole module: import * as ort from "onnxruntime-web/wasm"');
  check(place !== undefined && place !== null, "place", `it is ${described(place)} (expected the address of a folder)`, "Give an address such as /weights/sketch-ict as second argument");
}

import { described, isObject, refuseWithoutPixels, tagOf } from "./arguments.js";
import type { Drawing, Point } from "./drawing.js";
import { check } from "./error.js";
import { isLightOnDark, paperUnder } from "./light_lines.js";
import { thin } from "./thinning.js";

/** Pixels of RGBA, 8 bits each, row 0 on top, alpha not premultiplied: an ImageData is one. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8ClampedArray | Uint8Array;
}

const kInverted = "the picture shows light lines on dark: it is read inverted";
const kLongerSide = 512, kLeastContrast = 32, kLeastPixels = 3;

const kPixels = "Give context.getImageData(0, 0, canvas.width, canvas.height)";

/** @throws DaumierError unless it has a size in whole pixels, and 4 bytes a pixel. */
export function checkPicture(picture: Picture): void {
  refuseWithoutPixels(picture, "picture");
  const given: unknown = picture;
  check(isObject(given) && "data" in given, "picture", `it is ${described(given)} (expected {width, height, data})`, kPixels);
  const { width, height, data } = picture;
  check(/^Uint8(Clamped)?Array$/.test(tagOf(data)), "picture", `its data are ${described(data)} (expected a Uint8ClampedArray of RGBA)`, kPixels);
  check(Number.isInteger(width) && Number.isInteger(height), "picture", `its size is ${width} x ${height} (expected whole numbers of pixels)`,
    "Give the size that its data have, as an ImageData does");
  check(width > 0 && height > 0 && data.length === 4 * width * height, "picture",
    `${data.length} numbers are no RGBA of ${width} x ${height} pixels (expected ${4 * width * height})`,
    kPixels);
}

/** Grey over paper (white), 0 .. 255. */
export function greyOf({ width, height, data }: Picture, paper = 255): Float32Array {
  const grey = new Float32Array(width * height);
  for (let i = 0; i < grey.length; ++i) {
    const alpha = data[4 * i + 3]! / 255, luma = 0.299 * data[4 * i]! + 0.587 * data[4 * i + 1]! + 0.114 * data[4 * i + 2]!;
    grey[i] = paper + alpha * (luma - paper);
  }
  return grey;
}

/** Means over the areas of the pixels of a smaller picture. */
export function shrunk(grey: Float32Array, width: number, height: number, toWidth: number, toHeight: number): Float32Array {
  const out = new Float32Array(toWidth * toHeight);
  for (let row = 0; row < toHeight; ++row)
    for (let column = 0; column < toWidth; ++column) {
      const top = (row * height) / toHeight, bottom = ((row + 1) * height) / toHeight, left = (column * width) / toWidth, right = ((column + 1) * width) / toWidth;
      let sum = 0;
      for (let y = Math.floor(top); y < bottom; ++y)
        for (let x = Math.floor(left); x < right; ++x)
          sum += grey[y * width + x]! * (Math.min(x + 1, right) - Math.max(x, left)) * (Math.min(y + 1, bottom) - Math.max(y, top));
      out[row * toWidth + column] = sum / ((bottom - top) * (right - left));
    }
  return out;
}

/** Follows the skeleton from pixel to pixel; lines begin and end where it does, or meet others. */
function traced(skeleton: Uint8Array, width: number, height: number): Point[][] {
  const around = (at: number): number[] => {
    const x = at % width, y = (at - x) / width, found: number[] = [];
    // Neighbours by a side come first: corners cut behind them are no lines of their own.
    for (const [dx, dy] of [[0, -1], [1, 0], [0, 1], [-1, 0], [1, -1], [1, 1], [-1, 1], [-1, -1]] as const) {
      const nx = x + dx, ny = y + dy;
      if (nx < 0 || ny < 0 || nx >= width || ny >= height || skeleton[ny * width + nx] === 0) continue;
      const isCut = dx !== 0 && dy !== 0 && (skeleton[y * width + nx] !== 0 || skeleton[ny * width + x] !== 0);
      if (!isCut) found.push(ny * width + nx);
    }
    return found;
  };
  const pixels = [...skeleton.keys()].filter((at) => skeleton[at] !== 0), degree = new Map(pixels.map((at) => [at, around(at).length]));
  const used = new Set<string>(), key = (a: number, b: number): string => (a < b ? `${a} ${b}` : `${b} ${a}`);
  const place = (at: number): Point => [(at % width) + 0.5, Math.floor(at / width) + 0.5];
  const lines: Point[][] = [];
  const follow = (from: number, to: number): void => {
    const line = [place(from)];
    for (let last = from, at: number | undefined = to; at !== undefined && !used.has(key(last, at));) {
      used.add(key(last, at));
      line.push(place(at));
      const next: number | undefined = degree.get(at) === 2 ? around(at).find((each) => !used.has(key(at!, each))) : undefined;
      last = at;
      at = next;
    }
    lines.push(line);
  };
  for (const closed of [false, true])
    for (const at of pixels) {
      if (degree.get(at) === 0 && !closed) lines.push([place(at)]);
      if (degree.get(at) === 2 && !closed) continue;
      for (const next of around(at)) if (!used.has(key(at, next))) follow(at, next);
    }
  return lines;
}

/** Without the steps of the pixels: three times the mean of neighbours, the ends fixed. */
function smoothed(line: Point[]): Point[] {
  let points = line;
  for (let round = 0; round < 3; ++round)
    points = points.map((point, i): Point => {
      const before = points[i - 1], after = points[i + 1];
      return before === undefined || after === undefined ? point : [(before[0] + 2 * point[0] + after[0]) / 4, (before[1] + 2 * point[1] + after[1]) / 4];
    });
  return points;
}

/**
 * The strokes of a clean picture of a drawing, dark lines on light paper, light ones on dark, or either on a transparent canvas: ink below the
 * middle of the darkest and the lightest grey, thinned, followed. The C++ runtime does more with scans and photographs (paper, shading, ruling).
 * @throws DaumierError if the picture has another size than its data, or no lines.
 */
export function drawingOfPicture(picture: Picture): Drawing {
  return readPicture(picture).drawing;
}

/** drawingOfPicture, and what a person should hear of it. */
export function readPicture(picture: Picture): { drawing: Drawing; warnings: string[] } {
  checkPicture(picture);
  const scale = Math.min(1, kLongerSide / Math.max(picture.width, picture.height));
  const width = Math.max(1, Math.round(scale * picture.width)), height = Math.max(1, Math.round(scale * picture.height));
  const full = greyOf(picture, paperUnder(picture)), grey = scale < 1 ? shrunk(full, picture.width, picture.height, width, height) : full;
  let darkest = 255, lightest = 0;
  for (const value of grey) {
    darkest = Math.min(darkest, value);
    lightest = Math.max(lightest, value);
  }
  check(lightest - darkest >= kLeastContrast, "picture", "it has no lines", "Draw dark lines on light paper");
  const threshold = (darkest + lightest) / 2, isLight = isLightOnDark(grey, width, height);
  const skeleton = thin(Uint8Array.from(grey, (value) => ((isLight ? value > threshold : value < threshold) ? 1 : 0)), width, height);
  const lines = traced(skeleton, width, height).filter((line) => line.length === 1 || line.length >= kLeastPixels);
  check(lines.length > 0, "picture", "it has no lines", "Draw dark lines on light paper");
  const sx = picture.width / width, sy = picture.height / height;
  const strokes = lines.map((line) => smoothed(line).map(([x, y]): Point => [sx * x, sy * y]));
  return { drawing: { width: picture.width, height: picture.height, strokes }, warnings: isLight ? [kInverted] : [] };
}

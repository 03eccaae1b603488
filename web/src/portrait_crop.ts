import { described, isObject } from "./arguments.js";
import { check } from "./error.js";
import { checkPicture, type Picture } from "./picture.js";
import { resizedByArea } from "./resize.js";

/** What the portrait network sees of a picture: systems/portrait/portrait_crop.h. */

/** Side of a crop, pixels. */
export const kPortraitSide = 224;
const kBelowMiddle = 0.05, kLeastScale = 0.67;

/** p_crop = scale p_picture + shift. */
export interface PictureMap {
  readonly scale: number;
  readonly shift: readonly [number, number];
}

/** The box of 68 landmarks (x0 y0 x1 y1 ...) with the longer side `size` of the crop's. @throws DaumierError if they are no box. */
export function cropOfLandmarks(landmarks: ArrayLike<number>, size: number): PictureMap {
  const given: unknown = landmarks;
  check(isObject(given) && typeof given["length"] === "number", "landmarks", `they are ${described(given)} (expected 136 numbers: x0 y0 x1 y1 ...)`, "Give 68 landmarks in iBUG order, or leave them out");
  check(landmarks.length === 136 && Array.from(landmarks).every(Number.isFinite), "landmarks", `${landmarks.length} numbers are no landmarks (expected 136 finite ones: x0 y0 x1 y1 ...)`,
    "Give 68 landmarks in iBUG order, in pixels of the picture");
  let minX = Infinity, minY = Infinity, maxX = -Infinity, maxY = -Infinity;
  for (let n = 0; n < 68; ++n) {
    const x = Math.fround(landmarks[2 * n]!), y = Math.fround(landmarks[2 * n + 1]!);
    minX = Math.min(minX, x);
    maxX = Math.max(maxX, x);
    minY = Math.min(minY, y);
    maxY = Math.max(maxY, y);
  }
  const side = Math.max(maxX - minX, maxY - minY);
  check(side > 0, "landmarks", "all are in one point", "Give 68 landmarks in iBUG order, in pixels of the picture");
  const scale = (size * kPortraitSide) / side;
  return { scale, shift: [0.5 * kPortraitSide - (scale * (minX + maxX)) / 2, (0.5 + kBelowMiddle) * kPortraitSide - (scale * (minY + maxY)) / 2] };
}

/** A picture as a whole: centred, its longer side that of the crop. */
export function cropOfWhole({ width, height }: Picture): PictureMap {
  const scale = kPortraitSide / Math.max(width, height);
  return { scale, shift: [0.5 * (kPortraitSide - scale * width), 0.5 * (kPortraitSide - scale * height)] };
}

/** RGB over white where the picture is transparent. */
function rgbOf({ width, height, data }: Picture): Uint8Array {
  const rgb = new Uint8Array(3 * width * height);
  for (let i = 0; i < width * height; ++i) {
    const alpha = data[4 * i + 3]!;
    for (let c = 0; c < 3; ++c) rgb[3 * i + c] = alpha === 255 ? data[4 * i + c]! : Math.round(255 + (alpha / 255) * (data[4 * i + c]! - 255));
  }
  return rgb;
}

/** RGB, 224 x 224. What is outside of the picture repeats its border. */
export function cropped(picture: Picture, map: PictureMap): Uint8Array {
  checkPicture(picture);
  let { width, height } = picture, pixels = rgbOf(picture), scaleX = map.scale, scaleY = map.scale;
  if (map.scale < kLeastScale && width * height > 1) {  // Resized first, so that nothing is aliased.
    const toWidth = Math.max(1, Math.round(width * map.scale)), toHeight = Math.max(1, Math.round(height * map.scale));
    pixels = resizedByArea(pixels, width, height, 3, toWidth, toHeight);
    scaleX *= width / toWidth;
    scaleY *= height / toHeight;
    [width, height] = [toWidth, toHeight];
  }
  const crop = new Uint8Array(3 * kPortraitSide * kPortraitSide);
  for (let row = 0; row < kPortraitSide; ++row)
    for (let column = 0; column < kPortraitSide; ++column) {
      const x = Math.min(Math.max((column + 0.5 - map.shift[0]) / scaleX - 0.5, 0), width - 1);
      const y = Math.min(Math.max((row + 0.5 - map.shift[1]) / scaleY - 0.5, 0), height - 1);
      const x0 = Math.floor(x), y0 = Math.floor(y), x1 = Math.min(x0 + 1, width - 1), y1 = Math.min(y0 + 1, height - 1);
      const fx = Math.fround(x - x0), fy = Math.fround(y - y0);
      for (let c = 0; c < 3; ++c) {
        const at = (px: number, py: number): number => pixels[3 * (py * width + px) + c]!;
        const top = at(x0, y0) * (1 - fx) + at(x1, y0) * fx, bottom = at(x0, y1) * (1 - fx) + at(x1, y1) * fx;
        crop[3 * (row * kPortraitSide + column) + c] = Math.trunc(Math.fround(top * (1 - fy) + bottom * fy + 0.5));
      }
    }
  return crop;
}

/** 3 x side x side colours 0 .. 1 of a crop. */
export function colourPlanes(crop: Uint8Array, side: number): Float32Array {
  const pixels = resizedByArea(crop, kPortraitSide, kPortraitSide, 3, side, side), planes = new Float32Array(pixels.length), share = Math.fround(1 / 255);
  for (let i = 0; i < side * side; ++i) for (let c = 0; c < 3; ++c) planes[c * side * side + i] = pixels[3 * i + c]! * share;
  return planes;
}

/** Lines of one pixel's width from a mask of ink [Guo and Hall 1989, A1]: render/thinning.h, bit for bit. */

/** The eight neighbours of a pixel, bit 0 above it and on clockwise. */
function bit(neighbours: number, i: number): boolean {
  return ((neighbours >> (i & 7)) & 1) !== 0;
}

/** 8-connected pieces into which the neighbours fall without the pixel; corners alone do not count twice. */
function numPieces(n: number): number {
  let count = 0;
  for (let i = 0; i < 8; i += 2) count += !bit(n, i) && (bit(n, i + 1) || bit(n, i + 2)) ? 1 : 0;
  return count;
}

function goes(n: number, pass: number): boolean {
  if (numPieces(n) !== 1) return false;
  let firstPairs = 0, secondPairs = 0;
  for (let i = 0; i < 8; i += 2) {
    firstPairs += bit(n, i + 7) || bit(n, i) ? 1 : 0;
    secondPairs += bit(n, i) || bit(n, i + 1) ? 1 : 0;
  }
  const numPairs = Math.min(firstPairs, secondPairs);
  if (numPairs < 2 || numPairs > 3) return false;
  const i = pass === 0 ? 4 : 0;
  return !((bit(n, i) || bit(n, i + 1) || !bit(n, i + 3)) && bit(n, i + 2));
}

function numBits(n: number): number {
  let count = 0;
  for (let i = 0; i < 8; ++i) count += (n >> i) & 1;
  return count;
}

const kAll = [...new Array(256).keys()];
const kGoes = [0, 1].map((pass) => kAll.map((n) => goes(n, pass)));
const kIsSuperfluous = kAll.map((n) => numPieces(n) === 1 && numBits(n) > 1);

/** ink: 1 or 0, width x height. */
export function thin(ink: Uint8Array, width: number, height: number): Uint8Array {
  const stride = width + 2, mask = new Uint8Array(stride * (height + 2));
  for (let row = 0; row < height; ++row) for (let column = 0; column < width; ++column) mask[(row + 1) * stride + column + 1] = ink[row * width + column]!;
  const offsets = [-stride, -stride + 1, 1, stride + 1, stride, stride - 1, -1, -stride - 1];
  const neighboursOf = (at: number): number => offsets.reduce((bits, offset, i) => bits | (mask[at + offset]! << i), 0);
  let left: number[] = [], idle = 0;
  for (let at = 0; at < mask.length; ++at) if (mask[at] !== 0) left.push(at);
  for (let pass = 0; idle < 2; pass = 1 - pass) {
    const staying: number[] = [], going: number[] = [];
    for (const at of left) (kGoes[pass]![neighboursOf(at)] ? going : staying).push(at);
    for (const at of going) mask[at] = 0;
    left = staying;
    idle = going.length > 0 ? 0 : idle + 1;
  }
  for (const at of left) if (kIsSuperfluous[neighboursOf(at)]) mask[at] = 0;
  const skeleton = new Uint8Array(width * height);
  for (let row = 0; row < height; ++row) for (let column = 0; column < width; ++column) skeleton[row * width + column] = mask[(row + 1) * stride + column + 1]!;
  return skeleton;
}

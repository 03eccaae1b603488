/** Light lines on dark, by the rules of the C++ runtime: IsLightOnDark of render/paper.cpp, LayOverPaper of render/image.cpp. */
import type { Picture } from "./picture.js";

const kNumVotes = 8, kDarkestOpaque = 0.02, kInvisibleOnWhite = 170;

function quantile(sorted: Float32Array, share: number): number {
  return sorted[Math.floor(share * (sorted.length - 1))]!;
}

/**
 * Whether most of what is near lines is darker than they are. The edge of the picture, which may show what lies under the paper, has no say.
 * Other than there, most of the rest must be dark, too: lines wider than half a block are read as they are.
 */
export function isLightOnDark(grey: Float32Array, width: number, height: number): boolean {
  const side = Math.max(1, Math.floor(Math.max(width, height) / kNumVotes)), marginX = Math.floor(width / kNumVotes), marginY = Math.floor(height / kNumVotes);
  let votes = 0, numDark = 0, num = 0;
  const middle = (grey.reduce((a, b) => Math.min(a, b), 255) + grey.reduce((a, b) => Math.max(a, b), 0)) / 2;
  for (let top = marginY; top < height - marginY; top += side)
    for (let left = marginX; left < width - marginX; left += side) {
      const rows = Array.from({ length: Math.min(side, height - top) }, (_, i) => (top + i) * width + left), columns = Math.min(side, width - left);
      const block = new Float32Array(rows.length * columns);
      rows.forEach((at, i) => block.set(grey.subarray(at, at + columns), i * columns));
      block.sort();
      num += block.length;
      numDark += block.filter((value) => value < middle).length;
      votes += quantile(block, 0.02) + quantile(block, 0.98) - 2 * quantile(block, 0.5);
    }
  return votes > 0 && 2 * numDark > num;
}

/** The grey under transparent pixels: white; black where what is drawn could not be seen on white. */
export function paperUnder({ data }: Picture): number {
  const opacity = new Float64Array(256);
  let total = 0;
  for (let i = 0; i < data.length; i += 4) {
    const luma = Math.floor((299 * data[i]! + 587 * data[i + 1]! + 114 * data[i + 2]! + 500) / 1000);
    opacity[luma]! += data[i + 3]!;
    total += data[i + 3]!;
  }
  let brightness = 0;
  for (let below = opacity[0]!; brightness < 255 && below < kDarkestOpaque * total;) below += opacity[++brightness]!;
  return brightness > kInvisibleOnWhite ? 0 : 255;
}

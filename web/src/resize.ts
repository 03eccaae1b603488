/** OpenCV's INTER_AREA for pictures of 8 bits that get smaller, which the C++ runtime uses: within 1 of it. */

interface Tap {
  to: number;
  from: number;
  share: number;
}

function areaTaps(fromSize: number, toSize: number): Tap[] {
  const scale = 1 / (toSize / fromSize), taps: Tap[] = [];
  for (let to = 0; to < toSize; ++to) {
    const begin = to * scale, end = begin + scale, cell = Math.min(scale, fromSize - begin);
    const last = Math.min(Math.floor(end), fromSize - 1), first = Math.min(Math.ceil(begin), last);
    if (first - begin > 1e-3) taps.push({ to, from: first - 1, share: Math.fround((first - begin) / cell) });
    for (let from = first; from < last; ++from) taps.push({ to, from, share: Math.fround(1 / cell) });
    if (end - last > 1e-3) taps.push({ to, from: last, share: Math.fround(Math.min(Math.min(end - last, 1), cell) / cell) });
  }
  return taps;
}

/** Half to even, cut to 0 .. 255. */
function rounded(value: number): number {
  const floor = Math.floor(value), rest = value - floor;
  const whole = rest > 0.5 || (rest === 0.5 && floor % 2 === 1) ? floor + 1 : floor;
  return Math.min(Math.max(whole, 0), 255);
}

/** Channels of 8 bits, row-major, no side larger than before. */
export function resizedByArea(pixels: Uint8Array, width: number, height: number, channels: number, toWidth: number, toHeight: number): Uint8Array {
  if (toWidth === width && toHeight === height) return pixels.slice();
  const out = new Uint8Array(toWidth * toHeight * channels), rowSize = toWidth * channels;
  if (width === 2 * toWidth && height === 2 * toHeight) {
    for (let row = 0; row < toHeight; ++row)
      for (let i = 0; i < rowSize; ++i) {
        const at = 2 * row * width * channels + 2 * (i - (i % channels)) + (i % channels), below = at + width * channels;
        out[row * rowSize + i] = (pixels[at]! + pixels[at + channels]! + pixels[below]! + pixels[below + channels]! + 2) >> 2;
      }
    return out;
  }
  const columns = areaTaps(width, toWidth), sums = new Float32Array(out.length);
  for (const { to, from, share } of areaTaps(height, toHeight)) {
    const line = new Float32Array(rowSize);
    for (const tap of columns)
      for (let c = 0; c < channels; ++c) line[tap.to * channels + c]! += Math.fround(tap.share * pixels[(from * width + tap.from) * channels + c]!);
    for (let i = 0; i < rowSize; ++i) sums[to * rowSize + i]! += Math.fround(share * line[i]!);
  }
  sums.forEach((value, i) => (out[i] = rounded(value)));
  return out;
}

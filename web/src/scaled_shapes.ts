import { check } from "./error.js";
import type { Safetensors } from "./safetensors.js";

/** Shapes as integers with one scale each, of 8 or 16 bits (docs/weights.md). @throws DaumierError if they do not belong together. */
export function readScaledShapes(arrays: Safetensors, name: string): Float32Array[] {
  const scales = arrays.floats(`${name}/scales`), bits = arrays.integers(`${name}/bits`);
  const part = (width: number): { numbers: Int32Array; size: number } => {
    const full = `${name}/int${width}`;
    return bits.includes(width) ? { numbers: arrays.integers(full), size: arrays.at(full).shape[1] ?? 0 } : { numbers: new Int32Array(0), size: 0 };
  };
  const parts = { 8: part(8), 16: part(16) }, next = { 8: 0, 16: 0 };
  return Array.from(scales, (scale, k) => {
    const width = bits[k];
    check(width === 8 || width === 16, arrays.file, `'${name}/bits' has a shape of ${width} bits (expected 8 or 16)`, "Copy the weights again");
    const { numbers, size } = parts[width], row = next[width]++;
    check((row + 1) * size <= numbers.length, arrays.file, `'${name}/int${width}' has too few shapes`, "Copy the weights again");
    return Float32Array.from(numbers.subarray(row * size, (row + 1) * size), (value) => value * scale);
  });
}

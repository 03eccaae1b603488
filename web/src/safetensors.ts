import { check, DaumierError, textOf } from "./error.js";

const kRepair = "Load it again; if that does not help, copy the file again";
const kByteSizes: Record<string, number> = { F64: 8, F32: 4, F16: 2, I64: 8, I32: 4, I16: 2, I8: 1, U8: 1 };

/** One array of a file. */
export interface StoredArray {
  readonly type: string;
  readonly shape: readonly number[];
  readonly bytes: Uint8Array;
}

/** The value of an IEEE 754 number of 16 bits. */
export function numberOfHalf(bits: number): number {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction === 0 ? sign * Infinity : NaN;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

let halves: Float32Array | undefined;
/** All numbers of 16 bits by their bits: millions are read. */
function halfTable(): Float32Array {
  return (halves ??= Float32Array.from({ length: 65536 }, (_, bits) => numberOfHalf(bits)));
}

/** A safetensors file: 8 bytes of header length, a JSON header, raw arrays of little-endian numbers. */
export class Safetensors {
  readonly file: string;
  readonly metadata: Readonly<Record<string, string>>;
  private readonly arrays = new Map<string, StoredArray>();

  /** @throws DaumierError if the file is malformed or truncated. */
  constructor(file: string, bytes: Uint8Array) {
    this.file = file;
    const header = this.headerOf(bytes);
    const body = bytes.subarray(8 + header.length);
    this.metadata = (header.json["__metadata__"] ?? {}) as Record<string, string>;
    for (const [name, entry] of Object.entries(header.json)) {
      if (name === "__metadata__") continue;
      const { dtype, shape, data_offsets: offsets } = entry as { dtype?: string; shape?: number[]; data_offsets?: number[] };
      const size = kByteSizes[dtype ?? ""];
      check(dtype !== undefined && size !== undefined && Array.isArray(shape) && Array.isArray(offsets) && offsets.length === 2, file,
        `the entry '${name}' of the header is malformed`, kRepair);
      const [begin, end] = offsets as [number, number];
      const expected = shape.reduce((product, side) => product * side, size);
      check(begin >= 0 && end - begin === expected, file, `'${name}' has ${end - begin} bytes (expected ${expected})`, kRepair);
      check(end <= body.length, file, `it is truncated: it has ${bytes.length} bytes (expected at least ${8 + header.length + end})`, kRepair);
      this.arrays.set(name, { type: dtype, shape, bytes: body.subarray(begin, end) });
    }
  }

  private headerOf(bytes: Uint8Array): { length: number; json: Record<string, unknown> } {
    check(bytes.length >= 8, this.file, `it is truncated: it has ${bytes.length} bytes`, kRepair);
    const length = Number(new DataView(bytes.buffer, bytes.byteOffset, 8).getBigUint64(0, true));
    check(length <= bytes.length - 8, this.file, "this is no safetensors file, or it is truncated", kRepair);
    try {
      const json: unknown = JSON.parse(new TextDecoder().decode(bytes.subarray(8, 8 + length)));
      if (typeof json === "object" && json !== null) return { length, json: json as Record<string, unknown> };
    } catch (error) {
      throw new DaumierError(this.file, `its header is no JSON (${textOf(error)})`, kRepair, { cause: error });
    }
    throw new DaumierError(this.file, "its header is no JSON object", kRepair);
  }

  has(name: string): boolean {
    return this.arrays.has(name);
  }

  /** @throws DaumierError if there is no such array. */
  at(name: string): StoredArray {
    const array = this.arrays.get(name);
    check(array !== undefined, this.file, `it has no array '${name}'`, "It is of another kind, or of another version of Daumier: export again");
    return array;
  }

  /** An aligned copy. Processors that run WebAssembly are little-endian, as the file is. */
  private copyOf(name: string): { type: string; buffer: ArrayBuffer } {
    const { type, bytes } = this.at(name);
    return { type, buffer: bytes.slice().buffer };
  }

  /** Numbers of F16, F32 or F64. @throws DaumierError of another type. */
  floats(name: string): Float32Array {
    const { type, buffer } = this.copyOf(name);
    if (type === "F32") return new Float32Array(buffer);
    if (type === "F64") return new Float32Array(new Float64Array(buffer));
    check(type === "F16", this.file, `'${name}' is of type ${type} (expected F16, F32 or F64)`, kRepair);
    const bits = new Uint16Array(buffer), numbers = new Float32Array(bits.length), table = halfTable();
    for (let i = 0; i < bits.length; ++i) numbers[i] = table[bits[i]!]!;
    return numbers;
  }

  /** Numbers of I32, I16, I8 or U8. @throws DaumierError of another type. */
  integers(name: string): Int32Array {
    const { type, buffer } = this.copyOf(name);
    if (type === "I32") return new Int32Array(buffer);
    if (type === "I16") return new Int32Array(new Int16Array(buffer));
    if (type === "I8") return new Int32Array(new Int8Array(buffer));
    check(type === "U8", this.file, `'${name}' is of type ${type} (expected I32, I16, I8 or U8)`, kRepair);
    return new Int32Array(new Uint8Array(buffer));
  }
}

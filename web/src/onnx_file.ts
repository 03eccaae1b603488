import { check } from "./error.js";
import type { Safetensors } from "./safetensors.js";

/**
 * Shipped weights keep a network's numbers in network.safetensors, half of the size in float16, and its graph in
 * network.onnx, whose tensors refer to them by their names. ONNX Runtime reads neither such references nor float16 as
 * float32: here the numbers come into the graph.
 */

// Field numbers of onnx.proto.
const kGraph = 7, kInitializer = 5;
const kDataType = 2, kDims = 1, kName = 8, kRawData = 9, kExternalData = 13, kDataLocation = 14;
const kExternal = 1, kFloat = 1;
const kVarint = 0, kBytes = 2;
const kRepair = "Copy network.onnx and network.safetensors of the same weights again";

interface Field {
  number: number;
  wire: number;
  /** With its tag. */
  whole: Uint8Array;
  /** Of a varint its value, of bytes what they hold. */
  value: number;
  bytes: Uint8Array;
}

class Reader {
  private at = 0;

  constructor(private readonly file: string, private readonly bytes: Uint8Array) {}

  private varint(): number {
    let value = 0, factor = 1;
    for (;;) {
      const byte = this.bytes[this.at++];
      check(byte !== undefined, this.file, "it is truncated", kRepair);
      value += (byte & 127) * factor;
      if (byte < 128) return value;
      factor *= 128;
    }
  }

  *fields(): Generator<Field> {
    while (this.at < this.bytes.length) {
      const begin = this.at, tag = this.varint(), wire = tag & 7;
      let value = 0, size = wire === 1 ? 8 : wire === 5 ? 4 : 0;
      if (wire === kVarint) value = this.varint();
      else if (wire === kBytes) size = this.varint();
      else check(wire === 1 || wire === 5, this.file, "this is no ONNX file", kRepair);
      const first = this.at;
      this.at += size;
      check(this.at <= this.bytes.length, this.file, "it is truncated, or no ONNX file", kRepair);
      yield { number: tag >>> 3, wire, whole: this.bytes.subarray(begin, this.at), value, bytes: this.bytes.subarray(first, this.at) };
    }
  }
}

type Parts = Uint8Array[];

function varint(value: number): Uint8Array {
  const bytes: number[] = [];
  for (; value >= 128; value = Math.floor(value / 128)) bytes.push((value % 128) + 128);
  bytes.push(value);
  return Uint8Array.from(bytes);
}

function field(number: number, parts: Parts): Parts {
  const size = parts.reduce((sum, part) => sum + part.length, 0);
  return [varint(number * 8 + kBytes), varint(size), ...parts];
}

function join(parts: Parts): Uint8Array {
  const joined = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    joined.set(part, at);
    at += part.length;
  }
  return joined;
}

/** Processors that run WebAssembly are little-endian, as ONNX is. */
function bytesOf({ buffer, byteOffset, byteLength }: Float32Array): Uint8Array {
  return new Uint8Array(buffer, byteOffset, byteLength);
}

function dimsOf(file: string, tensor: Field[]): number[] {
  return tensor.filter(({ number }) => number === kDims).flatMap(({ wire, value, bytes }) => {
    if (wire === kVarint) return [value];
    const dims: number[] = [];
    for (let at = 0; at < bytes.length;) {  // Packed.
      let dim = 0, factor = 1;
      for (;;) {
        const byte = bytes[at++];
        check(byte !== undefined, file, "it is truncated", kRepair);
        dim += (byte & 127) * factor;
        if (byte < 128) break;
        factor *= 128;
      }
      dims.push(dim);
    }
    return dims;
  });
}

function completeTensor(file: string, whole: Field, numbers: Safetensors): Parts {
  const fields = [...new Reader(file, whole.bytes).fields()];
  if (!fields.some(({ number, value }) => number === kDataLocation && value === kExternal)) return [whole.whole];
  const name = new TextDecoder().decode(fields.find(({ number }) => number === kName)?.bytes);
  const shape = numbers.at(name).shape.join(" x "), dims = dimsOf(file, fields).join(" x ");
  check(shape === dims, numbers.file, `'${name}' is ${shape} (expected ${dims} by ${file})`, kRepair);
  const kept = fields.filter(({ number }) => ![kDataType, kRawData, kExternalData, kDataLocation].includes(number));
  return field(kInitializer, [...kept.map((each) => each.whole), varint(kDataType * 8), varint(kFloat),
    ...field(kRawData, [bytesOf(numbers.floats(name))])]);
}

/** The graph with all numbers in it, as float32. @throws DaumierError if the two files do not belong together. */
export function completeOnnx(file: string, bytes: Uint8Array, numbers: Safetensors): Uint8Array<ArrayBuffer> {
  const model = [...new Reader(file, bytes).fields()];
  check(model.some(({ number }) => number === kGraph), file, "this is no ONNX file", kRepair);
  return join(model.flatMap((each) => each.number !== kGraph ? [each.whole] :
    field(kGraph, [...new Reader(file, each.bytes).fields()].flatMap((part) =>
      part.number === kInitializer ? completeTensor(file, part, numbers) : [part.whole])))) as Uint8Array<ArrayBuffer>;
}

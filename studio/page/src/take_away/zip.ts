// A .zip of files as they are (stored, not compressed) [PKWARE APPNOTE 6.3.3]; pictures are compressed already.

export interface ZipEntry {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
}

const kLocal = 0x04034b50;
const kCentral = 0x02014b50;
const kEnd = 0x06054b50;
/** The first day of the format, 1980-01-01: a file is the same each time. */
const kDate = 0x21;
const kUtf8 = 0x0800;

export function zipOf(entries: readonly ZipEntry[]): Blob {
  const parts: BlobPart[] = [];
  const central: BlobPart[] = [];
  let offset = 0;
  let centralSize = 0;
  for (const { name, bytes } of entries) {
    const path = new TextEncoder().encode(name);
    // Version, flags, method, time, date, CRC, sizes, length of the name: the same in both headers.
    const shared: Field[] = [[2, 20], [2, kUtf8], [2, 0], [2, 0], [2, kDate], [4, crc32(bytes)], [4, bytes.length], [4, bytes.length], [2, path.length], [2, 0]];
    const local = record([[4, kLocal], ...shared]);
    const entry = record([[4, kCentral], [2, 20], ...shared, [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]]);
    parts.push(local, path, bytes);
    central.push(entry, path);
    offset += local.length + path.length + bytes.length;
    centralSize += entry.length + path.length;
  }
  const end = record([[4, kEnd], [2, 0], [2, 0], [2, entries.length], [2, entries.length], [4, centralSize], [4, offset], [2, 0]]);
  return new Blob([...parts, ...central, end], { type: "application/zip" });
}

type Field = [bytes: 2 | 4, value: number];

/** Little endian numbers, one after the other. */
function record(fields: readonly Field[]): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(fields.reduce((sum, [size]) => sum + size, 0));
  const view = new DataView(bytes.buffer);
  let at = 0;
  for (const [size, value] of fields) {
    if (size === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += size;
  }
  return bytes;
}

const kTable = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  return value;
});

function crc32(bytes: Uint8Array): number {
  let value = 0xffffffff;
  for (const byte of bytes) value = (kTable[(value ^ byte) & 255] ?? 0) ^ (value >>> 8);
  return (value ^ 0xffffffff) >>> 0;
}

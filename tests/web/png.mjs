// PNG files of RGB pixels, so that both runtimes read the same pixels: no browser decodes them.
import * as zlib from 'node:zlib';

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]), bytes = Buffer.alloc(body.length + 8);
  bytes.writeUInt32BE(data.length, 0);
  body.copy(bytes, 4);
  bytes.writeUInt32BE(crc(body), body.length + 4);
  return bytes;
}

const kTable = Array.from({ length: 256 }, (_, n) => {
  let value = n;
  for (let k = 0; k < 8; ++k) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value >>> 0;
});

function crc(bytes) {
  if (zlib.crc32 !== undefined) return zlib.crc32(bytes);  // Node.js 22 and later.
  let value = 0xffffffff;
  for (const byte of bytes) value = (value >>> 8) ^ kTable[(value ^ byte) & 255];
  return (value ^ 0xffffffff) >>> 0;
}

/** data: RGBA, of which alpha is left out. */
export function pngOf({ width, height, data }) {
  const header = Buffer.alloc(13), rows = Buffer.alloc(height * (3 * width + 1));
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2, 0, 0, 0], 8);
  for (let row = 0; row < height; ++row)
    for (let column = 0; column < width; ++column)
      for (let c = 0; c < 3; ++c) rows[row * (3 * width + 1) + 1 + 3 * column + c] = data[4 * (row * width + column) + c];
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', header), chunk('IDAT', zlib.deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

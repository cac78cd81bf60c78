// Small writers of PNG files for the tests.
import { crc32, deflateSync } from "node:zlib";

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(crc32(body) >>> 0, body.length + 4);
  return out;
}

/** One bit per pixel: 1 is white. `byte` fills every eight pixels. */
export function plainPng(width, height, byte) {
  const row = Buffer.alloc(Math.ceil(width / 8) + 1, byte);
  row[0] = 0;
  return png(width, height, { depth: 1, color: 0 }, Buffer.concat(Array.from({ length: height }, () => row)));
}

/** `at(x, y)` gives red, green and blue, and for pictures with clear parts alpha. */
export function colorPng(width, height, at) {
  const rows = Array.from({ length: height }, (_, y) =>
    Buffer.from([0, ...Array.from({ length: width }, (_, x) => at(x, y)).flat()]),
  );
  return png(width, height, { depth: 8, color: at(0, 0).length === 4 ? 6 : 2 }, Buffer.concat(rows));
}

function png(width, height, { depth, color }, rows) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head[8] = depth;
  head[9] = color;
  const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([
    signature,
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

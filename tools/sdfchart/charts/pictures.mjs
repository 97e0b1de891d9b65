// Pictures of the light on the ground, as PNGs within the page.
import { deflateSync } from 'node:zlib';
import { distinct, shown, splitLine } from './figures.mjs';
import { escaped } from './tables.mjs';

/// The pictures of pictures.csv by the row that they are of: { side, light, truth }, each point 0 to 254, or 255 where
/// there is none. Of several of one row the last counts; a line that is not whole does not.
export function parsePictures(text) {
  const pictures = new Map();
  for (const line of text.split('\n')) {
    const [kind, scene, method, setting, side, ...digits] = splitLine(line);
    const [light, truth] = digits.map((word) => Buffer.from(word, 'hex'));
    if (digits.length !== 2 || [light, truth].some((bytes) => bytes.length !== side * side)) continue;
    pictures.set(keyOf({ kind, scene, method, setting }), { side: +side, light, truth });
  }
  return pictures;
}

const keyOf = (row) => JSON.stringify([row.kind, row.scene, row.method, row.setting]);

// PNG's checksum (ISO/IEC 15948, annex D), which Debian's node does not have.
function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return (crc ^ 0xffffffff) >>> 0;
}

function chunk(name, data) {
  const bytes = Buffer.concat([Buffer.alloc(4), Buffer.from(name), data, Buffer.alloc(4)]);
  bytes.writeUInt32BE(data.length, 0);
  bytes.writeUInt32BE(crc32(bytes.subarray(4, -4)), bytes.length - 4);
  return bytes;
}

// A point is as many pixels as `zoom` a side. Light is a grey by sRGB's curve, and where there is no ground it is blue.
const zoom = 3;
function colourOf(byte) {
  if (byte === 255) return [40, 70, 120];
  const light = byte / 254;
  const grey = Math.round(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055));
  return [grey, grey, grey];
}

/// A PNG (ISO/IEC 15948) of side x side points.
export function pngOfPoints(points, side) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(side * zoom, 0);
  header.writeUInt32BE(side * zoom, 4);
  header.set([8, 2, 0, 0, 0], 8); // eight bits, RGB
  const rows = [];
  for (let y = 0; y < side; y++) {
    const row = [0]; // not filtered
    for (let x = 0; x < side; x++) for (let k = 0; k < zoom; k++) row.push(...colourOf(points[y * side + x]));
    for (let k = 0; k < zoom; k++) rows.push(Buffer.from(row));
  }
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', header),
    chunk('IDAT', deflateSync(Buffer.concat(rows))), chunk('IEND', Buffer.alloc(0))]);
}

/// The rows that stand for their methods: the default's, or the middle one's.
export const usualRows = (rows) => distinct(rows, 'method').map((method) => {
  const own = rows.filter((row) => row.method === method);
  return own.find((row) => row.default === 1) ?? own[Math.floor(own.length / 2)];
});

function figureOf(words, points, side) {
  const source = `data:image/png;base64,${pngOfPoints(points, side).toString('base64')}`;
  return `<figure class="light"><img src="${source}" width="144" height="144" alt="${escaped(words)}"><figcaption>${escaped(words)}</figcaption></figure>`;
}

/// The truth and each method beside one another, as HTML; nothing where there are no pictures.
export function picturesHtml(rows, pictures) {
  const known = usualRows(rows.filter((row) => pictures.has(keyOf(row))));
  if (!known.length) return '';
  const { side, truth } = pictures.get(keyOf(known[0]));
  const each = known.map((row) => figureOf(`${row.method}, ${row.setting}: ${shown(row.error_rms)} off`, pictures.get(keyOf(row)).light, side));
  return `<div class="lights">${figureOf('the truth', truth, side)}${each.join('')}</div>`;
}

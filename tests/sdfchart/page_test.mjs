// node page_test.mjs PACKAGES CHROMIUM: draws the page of the published results, opens it in Chromium and looks at it. Exits 1
// where something is wrong.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { inflateSync } from 'node:zlib';
import { themes } from '../../tools/sdfchart/charts/options.mjs';

const [packages, chromium] = process.argv.slice(2);
const root = fileURLToPath(new URL('../../', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sdfchart_page_'));

// Rows of pixels of a PNG of eight bits, RGB or RGBA (ISO/IEC 15948), as { width, height, at(x, y) }.
function decoded(png) {
  const [width, height, channels] = [png.readUInt32BE(16), png.readUInt32BE(20), { 2: 3, 6: 4 }[png[25]]];
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  const raw = inflateSync(Buffer.concat(parts)), side = width * channels, pixels = Buffer.alloc(side * height);
  for (let y = 0; y < height; y++) {
    const filter = raw[y * (side + 1)];
    for (let i = 0; i < side; i++) {
      const left = i < channels ? 0 : pixels[y * side + i - channels], up = y ? pixels[(y - 1) * side + i] : 0;
      const corner = y && i >= channels ? pixels[(y - 1) * side + i - channels] : 0, p = left + up - corner;
      const [a, b, c] = [left, up, corner].map((v) => Math.abs(p - v));
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      pixels[y * side + i] = raw[y * (side + 1) + 1 + i] + [0, left, up, (left + up) >> 1, paeth][filter];
    }
  }
  return { width, height, at: (x, y) => pixels.readUIntBE(y * side + x * channels, 3) };
}

const number = (colour) => parseInt(colour.slice(1), 16);
const count = (picture, colour) => {
  let found = 0;
  for (let y = 0; y < picture.height; y++) for (let x = 0; x < picture.width; x++) found += picture.at(x, y) === number(colour);
  return found;
};

function chrome(page, ...options) {
  const profile = mkdtempSync(join(folder, 'profile_'));
  return execFileSync(chromium, ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync', '--hide-scrollbars',
    '--virtual-time-budget=8000', `--user-data-dir=${profile}`, ...options, `file://${page}`], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: 1 << 28 });
}

function screenshot(page, width, height, ...options) {
  const file = join(folder, 'shot.png');
  chrome(page, `--window-size=${width},${height}`, `--screenshot=${file}`, ...options);
  const picture = decoded(readFileSync(file));
  assert.deepEqual([picture.width, picture.height], [width, height]);
  return picture;
}

// The first chart's ten methods, in colours that are theirs alone, its front's grey and words on the theme's ground.
function expectCharts(picture, theme, name) {
  assert.equal(picture.at(2, 2), number(theme.back), `${name}: the ground`);
  theme.lines.forEach((colour, i) => assert.ok(count(picture, colour) > 40, `${name}: the ${i}th line, ${colour}`));
  assert.ok(count(picture, theme.text) > 1000, `${name}: words`);
  const ground = count(picture, theme.back) / (picture.width * picture.height);
  assert.ok(ground > 0.7 && ground < 0.98, `${name}: ${ground} of it is empty`);
}

// What a reader's pointer finds out, told by a script at the page's end, which the page itself has not.
const pointing = `<script type="module">
const tell = (name, text) => { document.body.dataset[name] = text; };
const mark = [...document.querySelectorAll('.chart svg path')].find((path) => path.getAttribute('fill') === '${themes.light.lines[0]}' && path.getBoundingClientRect().top > document.querySelector('.chart').getBoundingClientRect().top + 90);
const box = mark.getBoundingClientRect(), at = { clientX: box.x + box.width / 2, clientY: box.y + box.height / 2, bubbles: true };
mark.dispatchEvent(new MouseEvent('mousemove', at));
setTimeout(() => {
  tell('pointed', document.querySelector('.chart').innerText);
  const form = document.getElementById('chooser');
  const choose = (cost) => { form.elements.error.value = 0.001; form.elements.cost.value = cost; form.dispatchEvent(new Event('input')); return form.querySelector('output').textContent; };
  tell('fastest', choose(0));
  tell('smallest', choose(1));
  form.elements.error.value = 1e-30;
  form.dispatchEvent(new Event('input'));
  tell('none', form.querySelector('output').textContent);
}, 1000);
</script>`;

try {
  execFileSync('node', [join(root, 'tools/sdfchart/charts/draw.mjs'), packages, join(root, 'docs/charts/results.csv'), folder]);
  const page = join(folder, 'index.html');

  expectCharts(screenshot(page, 1200, 1500), themes.light, 'light');
  expectCharts(screenshot(page, 1200, 1500, '--blink-settings=preferredColorScheme=0'), themes.dark, 'dark');
  const phone = screenshot(page, 390, 3000);
  expectCharts(phone, themes.light, 'phone');
  for (let y = 0; y < phone.height; y++) assert.equal(phone.at(385, y), number(themes.light.back), `phone: something sticks out at ${y}`);

  writeFileSync(join(folder, 'pointed.html'), readFileSync(page, 'utf8').replace(/<\/body><\/html>\s*$/, `${pointing}</body></html>`));
  const dom = chrome(join(folder, 'pointed.html'), '--window-size=1200,1500', '--dump-dom');
  const told = (name) => dom.match(new RegExp(`<body[^>]* data-${name}="([^"]*)"`))?.[1] ?? '';
  assert.match(told('pointed'), /OpenVDB, dense\s+\d+ voxels\s+ball\s+time: [^]*runs, the middle half/, 'what a mark says of itself');
  assert.match(told('fastest'), /sdf2gltf SCENE --voxel-size/);
  assert.match(told('smallest'), /triangles[^]*sdf2gltf SCENE --tolerance/);
  assert.match(told('none'), /nothing that was measured keeps it; the nearest is/);
} finally {
  rmSync(folder, { recursive: true });
}

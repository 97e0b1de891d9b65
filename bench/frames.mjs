// What a frame of each sample costs, and what its rays read, by each --start: node bench/frames.mjs [SDFVIEW] [FRAMES]
// Ratios are of medians of frames drawn by turns: above 1 the other way is faster than cones.
import { execFileSync } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const [sdfview = join(root, 'build/release/bin/sdfview'), frames = '20'] = process.argv.slice(2);
const starts = ['raster', 'plain'];

function reportOf(scene) {
  const compare = starts.flatMap((start) => ['--compare', start]);
  return JSON.parse(execFileSync(sdfview, [scene, '--bench', frames, '--size', '640x360', ...compare]));
}

const line = (name, cells) => console.log(name.padEnd(20) + cells.map((cell) => String(cell).padStart(10)).join(''));
line('scene', ['ms', 'cone', ...starts.flatMap((start) => [start, 'faster', 'rms'])]);
const reads = { cone: [] };
for (const file of readdirSync(join(root, 'samples')).filter((name) => name.endsWith('.lua')).sort()) {
  const report = reportOf(join(root, 'samples', file));
  const cone = report.readings_a_ray.primary;
  reads.cone.push(cone);
  const cells = report.compared.flatMap(({ with: start, other_readings_a_ray: other, ratio, rms }) => {
    (reads[start] ??= []).push(other.primary);
    return [other.primary.toFixed(2), ratio.toFixed(2), rms.toFixed(5)];
  });
  line(basename(file, '.lua'), [report.frame_ms.toFixed(1), cone.toFixed(2), ...cells]);
}
// Where rays may not start elsewhere, since the light of the scene counts their readings, all ways read the same.
const free = reads.cone.map((cone, i) => cone === 0 || cone !== reads.plain[i]);
const mean = (numbers) => numbers.reduce((sum, n) => sum + n, 0) / numbers.length;
for (const [name, counts] of [['mean', () => true], ['mean where free', (_, i) => free[i]]])
  line(name, ['', ...Object.values(reads).flatMap((all) => [mean(all.filter(counts)).toFixed(2), '', ''])]);

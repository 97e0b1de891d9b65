// What the charts compute from the rows. Run by node; exits 1 where something is wrong.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { defaultsBehind, fastestWithin } from '../../tools/sdfchart/charts/choose.mjs';
import { sections } from '../../tools/sdfchart/charts/sections.mjs';
import { withSummary } from '../../tools/sdfchart/charts/summary.mjs';
import { fittedExponent, paretoFront, parseResults, shown, slug } from '../../tools/sdfchart/charts/figures.mjs';

const text = '# made by\nkind,scene,method,seconds,status\nmeshing,ball,"a, ""b""",0.5,ok\nmeshing,ball,c,,failed: why\n';
const { notes, rows } = parseResults(text);
assert.deepEqual(notes, ['made by']);
assert.equal(rows[0].method, 'a, "b"');
assert.equal(rows[0].seconds, 0.5);
assert.ok(Number.isNaN(rows[1].seconds));
assert.throws(() => parseResults('a,b\n1,2\n'), /results.csv/);

const p = (x, y) => ({ x, y });
assert.deepEqual(paretoFront([p(3, 1), p(1, 3), p(2, 4), p(2, 2), p(4, 1)]), [p(1, 3), p(2, 2), p(3, 1)]);
assert.deepEqual(paretoFront([]), []);

assert.ok(Math.abs(fittedExponent([p(1, 5), p(2, 20), p(4, 80)]) - 2) < 1e-12);
assert.ok(Number.isNaN(fittedExponent([p(2, 5), p(2, 6)])));

assert.equal(shown(0), '0');
assert.equal(shown(NaN), '');
assert.equal(shown(1234.6), '1235');
assert.equal(shown(0.12345), '0.123');
assert.equal(shown(4.56e-7), '4.56·10⁻⁷');
assert.equal(slug('over the voxels a side (drilled box)'), 'over-the-voxels-a-side-drilled-box');

const meshes = [[0.1, 1e-3, 1], [0.01, 5e-4, 0], [0.001, 1e-2, 0]].map(([seconds, error_rms, standard], i) => (
  { kind: 'meshing', scene: 'ball', method: `m${i}`, setting: '', status: 'ok', seconds, error_rms, default: standard }));
const failed = { kind: 'meshing', scene: 'ball', method: 'f', setting: '', status: 'failed: why', seconds: NaN, error_rms: NaN, default: 0 };
assert.equal(fastestWithin(sections[0], 'ball', [...meshes, failed], 1e-3).method, 'm1');
assert.equal(fastestWithin(sections[0], 'ball', [...meshes, failed], 1e-9), undefined);
const [behind] = defaultsBehind(sections, meshes.map((row, i) => ({ ...row, triangles: [300, 100, 5][i] })));
assert.equal(behind.best.method, 'm1');
assert.ok(Math.abs(behind.factor - 3) < 1e-9);
assert.equal(behind.ok, false);

// The README says what the results say that are kept beside the charts.
const root = new URL('../../', import.meta.url);
const [readme, results] = ['README.md', 'docs/charts/results.csv'].map((file) => readFileSync(new URL(file, root), 'utf8'));
assert.equal(withSummary(readme, parseResults(results)), readme, 'run node tools/sdfchart/charts/publish.mjs');
assert.throws(() => withSummary('no place for it', parseResults(results)), /mark the place/);
const slower = results.replace(/^(shadows,.*?,soft,one ray,[^,]*,1,)[^,]*/m, '$17');
assert.notEqual(slower, results);
assert.notEqual(withSummary(readme, parseResults(slower)), readme);

// What the charts compute from the rows. Run by node; exits 1 where something is wrong.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';
import { defaultsBehind, fastestWithin, offered } from '../../tools/sdfchart/charts/choose.mjs';
import { parsePictures, picturesHtml, pngOfPoints, usualRows } from '../../tools/sdfchart/charts/pictures.mjs';
import { chartOption, themes } from '../../tools/sdfchart/charts/options.mjs';
import { axisName, sections } from '../../tools/sdfchart/charts/sections.mjs';
import { gridSvg } from '../../tools/sdfchart/charts/tables.mjs';
import { withSummary } from '../../tools/sdfchart/charts/summary.mjs';
import { distinct, fittedExponent, paretoFront, parseResults, shown, slug } from '../../tools/sdfchart/charts/figures.mjs';

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

// What a user says to have a row: nothing for stages alone and for other programs.
const section = (kind) => sections.find((s) => s.kind === kind);
const asked = (kind, row) => offered(section(kind), [{ kind, scene: 'ball', setting: '', ...row }]).map((r) => r.asked)[0];
assert.equal(asked('meshing', { method: 'uniform, proven', size: 0.125 }), 'sdf2gltf SCENE --voxel-size 0.125 --certify');
assert.equal(asked('meshing', { method: 'tolerance', size: 0.01 }), 'sdf2gltf SCENE --tolerance 0.01');
for (const method of ['+ creases', 'OpenVDB, dense', 'tolerance, voxels of 1/64']) assert.equal(asked('meshing', { method, size: 1 }), undefined);
const drawn = { method: 'OpenGL, --start cone', setting: "0.25 of a pixel's cone" };
assert.equal(asked('marching', { ...drawn, scene: 'ball, OpenGL, 64 steps' }), 'sdfview SCENE --start cone --steps 64');
assert.equal(asked('marching', { ...drawn, setting: "1 of a pixel's cone" }), undefined);
assert.equal(asked('marching', { method: 'plain', setting: 'threshold 1e-05' }), undefined);
const lamp = { scene: 'ball, lamp of 7°' };
assert.equal(asked('shadows', { ...lamp, method: 'hard', size: 1 }), 'shadows{kind = "hard"}');
assert.equal(asked('shadows', { ...lamp, method: 'signed', size: 1 }), 'shadows{kind = "signed", sharpness = 8.14}');
assert.equal(asked('shadows', { ...lamp, method: 'points of the lamp', size: 16 }), 'directional_light{radius = 7}, sdfview SCENE --samples 16');
assert.equal(asked('occlusion', { method: 'taps, relative', size: 5 }), 'ambient_occlusion{count = 5, strength = 0.2}');

// Axes say what their chart goes over.
assert.equal(axisName(section('growth').x[0], 'x', 'over the voxels a side (drilled box)'), 'voxels a side');
assert.equal(axisName(section('normals').x[0], 'x', 'torus 10 from the origin'), 'step (scene units)');
assert.equal(axisName(section('normals').x[0], 'x', 'over the distance from the origin (torus)'), 'distance from the origin (scene units)');

// The tables of docs/charts.md are those of the results that are kept beside the charts.
const root = new URL('../../', import.meta.url);
const [page, results] = ['docs/charts.md', 'docs/charts/results.csv'].map((file) => readFileSync(new URL(file, root), 'utf8'));
assert.equal(withSummary(page, parseResults(results)), page, 'run node tools/sdfchart/charts/publish.mjs');
assert.throws(() => withSummary('no place for it', parseResults(results)), /mark the place/);
const slower = results.replace(/^(shadows,.*?,soft,one ray,[^,]*,1,)[^,]*/m, '$17');
assert.notEqual(slower, results);
assert.notEqual(withSummary(page, parseResults(slower)), page);

// Pictures: the last of a row counts, what is not whole does not, and PNGs hold the points.
const lines = 'shadows,ball,hard,one ray,2,00fe00ff,0000feff\nshadows,ball,hard,one ray,2,fefe00ff,0000feff\nshadows,ball,soft,one ray,2,00fe';
const pictures = parsePictures(lines);
assert.equal(pictures.size, 1);
assert.deepEqual([...pictures.values()][0].light, Buffer.from([254, 254, 0, 255]));
const png = pngOfPoints(Buffer.from([254, 0, 255, 254]), 2);
assert.equal(png.readUInt32BE(16), 6);
assert.equal(png.subarray(-8).toString('hex'), '49454e44ae426082'); // the end's known checksum
const pixels = inflateSync(png.subarray(41, -16));
assert.deepEqual([...pixels.subarray(0, 19)], [0, ...Array(9).fill(255), ...Array(9).fill(0)]);
const light = (method, setting, standard) => ({ kind: 'shadows', scene: 'ball', method, setting, default: standard, error_rms: 0.5 });
assert.deepEqual(usualRows([light('a', '1', 0), light('a', '2', 1), light('b', '1', 0), light('b', '2', 0), light('b', '3', 0)]).map((r) => r.setting), ['2', '2']);
assert.match(picturesHtml([light('hard', 'one ray', 0)], pictures), /the truth.*hard, one ray: 0.5 off/s);
assert.equal(picturesHtml([light('soft', 'one ray', 0)], pictures), '');

// What failed is a cross with its reason, beside what did not.
const failing = { ...failed, method: 'm0', setting: 's', status: 'failed: too slow' };
const charted = chartOption({ section: sections[0], scene: 'ball', x: sections[0].x[0], y: sections[0].y[0], rows: [...meshes, failing].map((row) => ({ runs: 1, seconds_q1: 1, seconds_q3: 1, ...row })) }, themes.light, 1000);
const [crossed] = charted.series.filter((s) => s.markPoint).map((s) => s.markPoint.data[0]);
assert.match(crossed.told, /m0.*too slow: s/);
assert.equal(crossed.label.formatter, 'm0: 1 failed');

// The table of rays: the viewer's frames beside the marcher, in one row for each scene.
const rays = [['plain', 't 1', 0], ['auto', 't 1', 1], ['OpenGL, a', 'c 1', 1], ['OpenGL, a', 'c 2', 0]].map(([method, setting, standard], i) => (
  { kind: 'marching', scene: 'ball', method, setting, default: standard, status: 'ok', seconds: 1, items: 1e6, evaluations: i + 1, error_rms: 0.5, machine: 'm' }));
const marks = page.match(/<!-- begin[^]*?-->\n/)[0] + page.match(/<!-- end[^]*?-->/)[0];
assert.match(withSummary(marks, { rows: rays }), /\| ball \| 1, 1 µs, 0.5 \| 2, 1 µs, 0.5 \| 3, 1 µs, 0.5 \|/);

// The grid of the known failures as a picture: who holds, degrades with a figure, fails, or did not run.
const known = [['a', 'holds', 'ok'], ['b', 'degrades', 'ok'], ['c', 'fails', 'ok'], ['d', '', 'failed: why']].map(([scene, verdict, status]) => (
  { kind: 'stability', scene, method: 'm', setting: '', verdict, status, error_max: 0.25 }));
const grid = gridSvg(known, 'title', distinct);
for (const words of ['>● holds<', '>◐ degrades 0.25<', '>✕ fails 0.25<', '>✕ did not run<', '>title<']) assert.ok(grid.includes(words), words);

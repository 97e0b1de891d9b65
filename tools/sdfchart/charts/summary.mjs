// The tables of docs/charts.md, made of nothing but rows of results.csv.
import { fastestWithin } from './choose.mjs';
import { distinct, shown } from './figures.mjs';
import { sections } from './sections.mjs';

const time = (seconds) => (seconds < 1 ? `${shown(1e3 * seconds)} ms` : `${shown(seconds)} s`);
const table = (heads, lines) =>
  [heads, heads.map(() => '---'), ...lines].map((cells) => `| ${cells.join(' | ')} |`).join('\n');

// The time and triangles of a method's fastest mesh that is nowhere farther off than `error`, or the error of its best.
function meshWithin(rows, scene, method, error) {
  const own = rows.filter((row) => row.scene === scene && row.method === method);
  if (!own.length) return '';
  const section = sections.find(({ kind }) => kind === 'meshing');
  const [seconds, largest] = [section.x[0], section.y[1]];
  const best = fastestWithin(section, scene, own, error, seconds, largest);
  return best ? `${time(best.seconds)}, ${best.triangles}` : `not kept: ${shown(Math.min(...own.map(largest.of)))}`;
}

function meshing(rows) {
  const own = rows.filter((row) => row.kind === 'meshing' && row.status === 'ok');
  const methods = { tolerance: 'with a tolerance', uniform: 'of one voxel size', 'OpenVDB, dense': 'OpenVDB, every voxel read',
    'CGAL make_surface_mesh': "CGAL's `make_surface_mesh`" };
  const lines = own.filter((row) => row.default === 1).map(({ scene, size }) =>
    [scene, shown(size), ...Object.keys(methods).map((method) => meshWithin(own, scene, method, size))]);
  return 'Meshes within the default tolerance of `sdf2gltf`, both ways. A cell has the time and the triangles of the method\'s\n' +
    'fastest setting that keeps it. Where no setting keeps it, the cell has the distance of the best one.\n\n' + table(['', 'tolerance', ...Object.values(methods)], lines);
}

function marching(rows) {
  const own = rows.filter((row) => row.kind === 'marching' && row.status === 'ok');
  const isDrawn = (row) => row.method.startsWith('OpenGL') && !row.method.includes('--method');
  const seen = (row) => row.scene.replace(/, OpenGL$/, '');
  const usual = own.filter((row) => row.default === 1);
  const columns = [...usual.filter((row) => !isDrawn(row)).slice(0, 1), ...usual.filter(isDrawn).slice(0, 1)]
    .flatMap((row) => distinct(own.filter((r) => r.setting === row.setting), 'method')
      .filter((method) => method === 'plain' || method === row.method || isDrawn({ method }))
      .map((method) => ({ method, setting: row.setting })));
  const cell = (row) => (row ? `${shown(row.evaluations)}, ${shown((1e6 * row.seconds) / row.items)} µs, ${shown(row.error_rms)}` : '');
  const lines = [...new Set(usual.map(seen))].map((scene) => [scene, ...columns.map(({ method, setting }) =>
    cell(own.find((row) => seen(row) === scene && row.method === method && row.setting === setting)))]);
  return 'Rays, at the thresholds of the viewer. A cell has the readings of the distance a ray, the time a ray, and the error of\n' +
    'the depth (root mean square). The first methods use one thread, those of OpenGL all threads of the driver.\n\n' +
    table(['', ...columns.map(({ method }) => method)], lines);
}

function shadows(rows) {
  const own = rows.filter((row) => row.kind === 'shadows' && row.status === 'ok');
  const methods = [['hard', 'one ray'], ['soft', 'one ray'], ['signed', 'one ray'], ['points of the lamp', '4 rays']];
  const lines = distinct(own, 'scene').map((scene) => [scene, ...methods.map(([method, setting]) => {
    const row = own.find((r) => r.scene === scene && r.method === method && r.setting === setting);
    return row ? `${shown(row.error_rms)}, ${shown((1e6 * row.seconds) / row.items)} µs` : '';
  })]);
  return 'Shadows of lamps. A cell has the error of the light, from 0 to 1 (root mean square), and the time a point.\n\n' +
    table(['', ...methods.map((words) => words.join(', '))], lines);
}

const line = (name, text) => `<!-- ${name} of the charts' summary; ./bootstrap charts writes it -->${text}`;
const [begin, end] = [line('begin', '\n'), line('end', '')];

/// The text with the summary of the rows between the two lines that mark its place. Throws where they are missing.
export function withSummary(text, { rows }) {
  const [from, to] = [text.indexOf(begin), text.indexOf(end)];
  if (from < 0 || to < from) throw new Error('the lines that mark the place of the summary are missing');
  const machine = distinct(rows, 'machine').join('; ');
  const parts = [`Measured on ${machine}.`, meshing(rows), marching(rows), shadows(rows)];
  return `${text.slice(0, from)}${begin}${parts.join('\n\n')}\n${text.slice(to)}`;
}

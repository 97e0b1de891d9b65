// Tables for the README, of nothing but rows of results.csv.
import { fastestWithin } from './choose.mjs';
import { distinct, shown } from './figures.mjs';
import { sections } from './sections.mjs';

const sectionOf = (kind) => sections.find((section) => section.kind === kind);
const time = (seconds) => (seconds < 1 ? `${shown(1e3 * seconds)} ms` : `${shown(seconds)} s`);
const table = (heads, lines) =>
  [heads, heads.map(() => '---'), ...lines].map((cells) => `| ${cells.join(' | ')} |`).join('\n');

// The fastest setting of a method that is no farther off than `error`.
function costWithin(rows, method, scene, error) {
  const own = rows.filter((row) => row.method === method);
  const best = fastestWithin(sectionOf('meshing'), scene, own, error);
  return best ? `${time(best.seconds)}, ${best.triangles}` : 'not reached';
}

function meshing(rows) {
  const own = rows.filter((row) => row.kind === 'meshing' && row.status === 'ok');
  const lines = own.filter((row) => row.method === 'uniform' && row.setting === '64 voxels').map((row) => {
    const within = (method) => costWithin(rows, method, row.scene, row.error_rms);
    return [row.scene, shown(row.error_rms), within('uniform'), within('tolerance, voxels of 1/64'),
      within('OpenVDB, dense'), within('CGAL make_surface_mesh')];
  });
  return 'Meshes no farther off than the uniform one of 64 voxels: the time, and the triangles\n\n' +
    table(['', 'root mean square of the two-sided distance', 'uniform', 'by tolerance', 'OpenVDB, every voxel read',
      "CGAL's `make_surface_mesh`"], lines);
}

function marching(rows) {
  const own = rows.filter((row) => row.kind === 'marching' && row.status === 'ok');
  const lines = own.filter((row) => row.default === 1).map((row) => {
    const plain = own.find((r) => r.method === 'plain' && r.scene === row.scene && r.setting === row.setting);
    return [row.scene, ...[row, plain].flatMap((r) => [shown(r.evaluations), shown(r.error_rms)])];
  });
  return 'Rays, with the thresholds of the viewer: readings of the distance, and the error of the depth (root mean ' +
    'square)\n\n' + table(['', 'as the viewer marches', '', 'plain sphere tracing', ''], lines);
}

function shadows(rows) {
  const own = rows.filter((row) => row.kind === 'shadows' && row.status === 'ok');
  const methods = ['hard', 'soft', 'signed', 'points of the lamp'];
  const lines = distinct(own, 'scene').map((scene) => [scene, ...methods.map((method) => {
    const row = own.find((r) => r.scene === scene && r.method === method);
    return row ? `${shown(row.error_rms)}, ${shown((1e6 * row.seconds) / row.items)} µs` : '';
  })]);
  return 'Shadows of lamps: the error of the light, from 0 to 1 (root mean square), and the time a point\n\n' +
    table(['', ...methods], lines);
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

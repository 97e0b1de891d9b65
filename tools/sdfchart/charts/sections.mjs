// What is charted: a section for each kind of measurement, with the figures that its axes can show.

// `held`: the figure along x that the defaults are chosen by, and how many times as much of it they may take as the
// best that is no less right.

// A figure: how it is read from a row, its name and unit, and which way is better (-1: less, 1: more).
const figure = (name, unit, better, of) => ({ name, unit, better, of });
const column = (name, unit, better, key) => figure(name, unit, better, (row) => row[key]);
const perItem = (name, unit, scale = 1e6) =>
  figure(name, unit, -1, (row) => (scale * row.seconds) / row.items);

const seconds = column('time', 's', -1, 'seconds');
const rms = (unit) => column('error, root mean square', unit, -1, 'error_rms');
const largest = (unit) => column('largest error', unit, -1, 'error_max');
const scenes = 'scene units';

const lightSection = (kind, title, lead) => ({
  kind, title, lead,
  charts: 'scene', series: 'method',
  x: [perItem('time a point', 'µs')],
  y: [rms('of the light'), largest('of the light')],
  pareto: true,
  drawn: [[0, 0]],
});

export const sections = [
  {
    kind: 'meshing',
    title: 'Meshing: time against distance from the surface',
    lead: 'Each point is one mesh. Its error is the two-sided distance between mesh and surface, by CGAL: the ' +
      'larger of both ways. Lines join the settings of a method, from coarse to fine.',
    charts: 'scene', series: 'method',
    x: [seconds, column('triangles', '', -1, 'triangles'), column('file size, .glb', 'bytes', -1, 'file_bytes'),
        column('memory', 'bytes', -1, 'memory_bytes')],
    y: [rms(scenes), largest(scenes), column('error of the normals, root mean square', '°', -1, 'error_normal_deg')],
    pareto: true,
    held: { x: 1, factor: 2 }, // a tolerance is kept with few triangles
    drawn: [[0, 0], [1, 0], [0, 1], [0, 2]],
  },
  {
    kind: 'marching',
    title: 'Marching: time a ray against depth error',
    lead: 'Each point is one method at one threshold and budget of steps, over the same rays. The depth is held to ' +
      'a dense march in double. Rays that should hit and did not, and the other way round, are figures of their own.',
    charts: 'scene', series: 'method',
    x: [perItem('time a ray', 'µs'), column('readings a ray', '', -1, 'evaluations')],
    y: [rms(scenes), largest(scenes), column('missed hits, share of rays', '', -1, 'missed'),
        column('false hits, share of rays', '', -1, 'false_hits')],
    pareto: true,
    held: { x: 1, factor: 2 }, // readings, which no other program disturbs
    drawn: [[0, 0], [1, 0], [0, 2]],
  },
  {
    kind: 'normals',
    title: 'Normals: angle error against the step of the differences',
    lead: 'Too long a step sees the curvature, too short a one the rounding of floats, which grows with the ' +
      'distance from the origin. Exact derivatives have no step.',
    charts: 'scene', series: 'method',
    x: [column('step', scenes, 0, 'size'), perItem('time a normal', 'ns', 1e9)],
    y: [rms('°'), largest('°')],
    drawn: [[0, 0], [1, 0]],
  },
  lightSection('shadows', 'Soft shadows: time a point against error of the light',
    'Held to rays to 1024 points of the lamp, by formulas of their own. A chart for each lamp and scene; ' +
      'light runs from 0 to 1. The pictures show the ground from above; what the blocker covers is blue.'),
  lightSection('occlusion', 'Ambient occlusion: time a point against error',
    'Held to 4096 rays a point over the hemisphere, by formulas of their own. Occlusion runs from 0 to 1. The pictures ' +
    'show the ground from above, lit by the sky alone; what the blocker covers is blue.'),
  {
    kind: 'evaluation',
    title: 'Evaluation: points a second and rounding, over the number of operations',
    lead: 'One thread. The double reading defines the value; errors of the float readings are in units of the last ' +
      'place of the largest number in play, the coordinate or the value.',
    charts: 'scene', series: 'method',
    x: [column('operations of the scene', '', 0, 'size')],
    y: [figure('points a second', '1/s', 1, (row) => row.items / row.seconds), rms('ulp'), largest('ulp')],
    drawn: [[0, 0], [0, 2]],
  },
  {
    kind: 'growth',
    title: 'Growth: how time and memory follow the size of the task',
    lead: 'The number after a name is the exponent p of the fitted power law, time ~ size^p: 1 grows as the size, ' +
      '2 as its square.',
    charts: 'scene', series: 'method',
    x: [column('size: voxels a side, balls, or parts', '', 0, 'size')],
    y: [seconds, column('memory', 'bytes', -1, 'memory_bytes')],
    fit: true,
    drawn: [[0, 0], [0, 1]],
  },
  {
    kind: 'stability',
    title: 'Stability: known failures, and who holds',
    lead: 'Each row is a case in which a common method fails. A full disc holds, a half one degrades with the ' +
      'figure beside it, a cross fails.',
    grid: true,
  },
];

/// The figure's name with its unit and the way that is better, as an axis says it. `along` is 'x' or 'y'.
export function axisName(figure, along) {
  const name = figure.name + (figure.unit ? ` (${figure.unit})` : '');
  if (figure.better === 0) return name;
  const arrow = { x: { '-1': '←', 1: '→' }, y: { '-1': '↓', 1: '↑' } }[along][figure.better];
  return `${name}   ${arrow} better`;
}

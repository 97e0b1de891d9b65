// What is charted: a section for each kind of measurement, with the figures that its axes can show.

// `held`: the figure along x that the defaults are chosen by, and how many times as much of it they may take as the
// best that is no less right. `command`: what a user says to have a row's method and setting; none where nothing can be
// said.

// A figure: how it is read from a row, its name and unit, and which way is better (-1: less, 1: more).
const figure = (name, unit, better, of) => ({ name, unit, better, of });
const column = (name, unit, better, key) => figure(name, unit, better, (row) => row[key]);
const perItem = (name, unit, scale = 1e6) =>
  figure(name, unit, -1, (row) => (scale * row.seconds) / row.items);

const seconds = column('time', 's', -1, 'seconds');
const rms = (unit) => column('error, root mean square', unit, -1, 'error_rms');
const largest = (unit) => column('largest error', unit, -1, 'error_max');
const scenes = 'scene units';

// What a chart goes over is in its scene's name, "over the voxels a side (drilled box)".
const over = (scene) => scene.replace(/^over the /, '').replace(/ \(.*/, '');

const mesher = (row) => {
  const size = +row.size.toPrecision(6), proven = row.method.endsWith(', proven') ? ' --certify' : '';
  if (row.method.startsWith('uniform')) return `sdf2gltf SCENE --voxel-size ${size}${proven}`;
  if (row.method === 'tolerance') return `sdf2gltf SCENE --tolerance ${size}`;
  return undefined;
};

// The viewer's threshold cannot be said.
const ray = (row) => {
  if (!row.method.startsWith('OpenGL, ') || !row.setting.startsWith('0.25 ')) return undefined;
  const steps = row.scene.match(/, (\d+) steps$/);
  return `sdfview SCENE ${row.method.slice('OpenGL, '.length)}${steps ? ` --steps ${steps[1]}` : ''}`;
};

const occlusion = ({ method, size }) =>
  (method === 'taps, relative' ? `ambient_occlusion{count = ${size}, strength = ${+(1 / size).toPrecision(3)}}` : undefined);
const shadow = ({ method, scene, size }) => {
  const degrees = scene.match(/lamp of ([\d.]+)°/)[1];
  if (method === 'points of the lamp') return `directional_light{radius = ${degrees}}, sdfview SCENE --samples ${size}`;
  const sharpness = method === 'hard' ? '' : `, sharpness = ${(1 / Math.tan((degrees * Math.PI) / 180)).toPrecision(3)}`;
  return `shadows{kind = "${method}"${sharpness}}`;
};

const lightSection = (kind, command, title, lead) => ({
  kind, command, title, lead,
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
      'larger of both ways. Lines join the settings of a method, from coarse to fine. The default keeps its tolerance with few ' +
      'triangles, which takes time: look at it across triangles, too.',
    charts: 'scene', series: 'method',
    x: [seconds, column('triangles', '', -1, 'triangles'), column('file size, .glb', 'bytes', -1, 'file_bytes'),
        column('memory', 'bytes', -1, 'memory_bytes')],
    y: [rms(scenes), largest(scenes), column('error of the normals, root mean square', '°', -1, 'error_normal_deg')],
    pareto: true,
    held: { x: 1, factor: 2 }, // a tolerance is kept with few triangles
    command: mesher,
    drawn: [[0, 0], [1, 0], [0, 1], [0, 2]],
  },
  {
    kind: 'marching',
    title: 'Marching: time a ray against depth error',
    lead: 'Each point is one method at one threshold, over the same rays. In charts that name a number of steps a ray may take no ' +
      'more; with cone starts, rays begin where a cone around 4 by 4 of them has come to. The depth is held to a dense march in ' +
      'double. Rays that should hit and did not, and the other way round, are figures of their own. One thread marches, OpenGL ' +
      'takes all that its driver has.',
    charts: 'scene', series: 'method',
    x: [perItem('time a ray', 'µs'), column('readings a ray', '', -1, 'evaluations')],
    y: [rms(scenes), largest(scenes), column('missed hits, share of rays', '', -1, 'missed'),
        column('false hits, share of rays', '', -1, 'false_hits')],
    pareto: true,
    held: { x: 1, factor: 2 }, // readings, which no other program disturbs
    command: ray,
    drawn: [[0, 0], [1, 0], [0, 2]],
  },
  {
    kind: 'normals',
    title: 'Normals: angle error against the step of the differences',
    lead: 'Too long a step sees the curvature, too short a one the rounding of floats, which grows with the ' +
      'distance from the origin. Exact derivatives have no step.',
    charts: 'scene', series: 'method',
    x: [{ ...column('step', scenes, 0, 'size'), nameIn: (scene) => (scene.startsWith('over the ') ? over(scene) : 'step') }, perItem('time a normal', 'ns', 1e9)],
    y: [rms('°'), largest('°')],
    drawn: [[0, 0], [1, 0]],
  },
  lightSection('shadows', shadow, 'Soft shadows: time a point against error of the light',
    'Held to rays to 1024 points of the lamp, by formulas of their own. A chart for each lamp and scene; ' +
      'light runs from 0 to 1. The pictures show the ground from above; what the blocker covers is blue.'),
  lightSection('occlusion', occlusion, 'Ambient occlusion: time a point against error',
    'Held to 4096 rays a point over the hemisphere, by formulas of their own. Occlusion runs from 0 to 1. The pictures ' +
    'show the ground from above, lit by the sky alone; what the blocker covers is blue.'),
  {
    kind: 'evaluation',
    title: 'Evaluation: points a second and rounding, over the number of operations',
    lead: 'One thread; GLSL takes all that its driver has. The double reading defines the value; errors of the float readings ' +
      'are in units of the last place of the largest number in play, the coordinate or the value.',
    charts: 'scene', series: 'method',
    x: [column('operations of the scene', '', 0, 'size')],
    y: [figure('points a second', '1/s', 1, (row) => row.items / row.seconds), rms('ulp'), largest('ulp')],
    drawn: [[0, 0], [0, 2]],
  },
  {
    kind: 'growth',
    title: 'Growth: how time and memory follow the size of the task',
    lead: 'The number after a name is the exponent p of the fitted power law: ^1 grows as the size, ^2 as its square. ' +
      'A stage\'s memory is the most that the process held in it, beyond what it held before the mesh was begun.',
    charts: 'scene', series: 'method',
    x: [{ ...column('size', '', 0, 'size'), nameIn: over }],
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

/// The figure's name in a chart of this scene.
export const nameIn = (figure, scene) => (figure.nameIn ? figure.nameIn(scene) : figure.name);

/// The figure's name with its unit and the way that is better, as an axis says it. `along` is 'x' or 'y'.
export function axisName(figure, along, scene) {
  const name = nameIn(figure, scene) + (figure.unit ? ` (${figure.unit})` : '');
  if (figure.better === 0) return name;
  const arrow = { x: { '-1': '←', 1: '→' }, y: { '-1': '↓', 1: '↑' } }[along][figure.better];
  return `${name}   ${arrow} better`;
}

// node publish.mjs MEASURED DOCS README: takes results.csv and the main charts of the folder MEASURED over to DOCS, and
// writes their summary into README.
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseResults } from './figures.mjs';
import { withSummary } from './summary.mjs';

const [measured, docs, readme] = process.argv.slice(2);
const charts = {
  meshing: 'meshing-drilled-box-time-error-root-mean-square',
  marching: 'marching-smooth-blended-balls-readings-a-ray-error-root-mean-square',
  shadows: 'shadows-ball-lamp-of-7-time-a-point-error-root-mean-square',
  growth: 'growth-over-the-voxels-a-side-drilled-box-size-time',
  stability: 'stability',
  evaluation: 'evaluation-unions-of-balls-operations-of-the-scene-points-a-second',
};
mkdirSync(docs, { recursive: true });
copyFileSync(join(measured, 'results.csv'), join(docs, 'results.csv'));
for (const [name, chart] of Object.entries(charts)) copyFileSync(join(measured, `${chart}.svg`), join(docs, `${name}.svg`));
const results = parseResults(readFileSync(join(docs, 'results.csv'), 'utf8'));
writeFileSync(readme, withSummary(readFileSync(readme, 'utf8'), results));

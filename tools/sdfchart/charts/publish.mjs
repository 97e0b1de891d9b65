// node publish.mjs MEASURED CHARTS PAGE: copies results.csv and the main charts of the folder MEASURED to the folder CHARTS,
// and writes the summary of the results into PAGE, such as docs/charts.md.
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseResults } from './figures.mjs';
import { withSummary } from './summary.mjs';

const [measured, folder, page] = process.argv.slice(2);
const charts = {
  meshing: 'meshing-drilled-box-time-error-root-mean-square',
  marching: 'marching-smooth-blended-balls-readings-a-ray-error-root-mean-square',
  shadows: 'shadows-ball-lamp-of-7-time-a-point-error-root-mean-square',
  growth: 'growth-over-the-voxels-a-side-drilled-box-size-time',
  stability: 'stability',
  evaluation: 'evaluation-unions-of-balls-operations-of-the-scene-points-a-second',
};
mkdirSync(folder, { recursive: true });
copyFileSync(join(measured, 'results.csv'), join(folder, 'results.csv'));
for (const [name, chart] of Object.entries(charts)) copyFileSync(join(measured, `${chart}.svg`), join(folder, `${name}.svg`));
const results = parseResults(readFileSync(join(folder, 'results.csv'), 'utf8'));
writeFileSync(page, withSummary(readFileSync(page, 'utf8'), results));

// node check.mjs results.csv: exits 1 where a default is farther behind the Pareto front than its section allows, with a
// line for each, and 2 where the file holds no default to be checked. Factors are of one run, so that a machine's
// speed has no say.
import { readFileSync } from 'node:fs';
import { defaultsBehind } from './choose.mjs';
import { parseResults, shown } from './figures.mjs';
import { sections } from './sections.mjs';

const all = defaultsBehind(sections, parseResults(readFileSync(process.argv[2], 'utf8')).rows);
const named = (row) => `${row.method}, ${row.setting}`;
for (const { row, best, cost, factor, allowed, ok } of all)
  if (!ok)
    console.error(`sdfchart: ${row.kind}, ${row.scene}: the default (${named(row)}) takes ${shown(factor)} times the ` +
      `${cost.name} of ${named(best)}, which is no less right; ${allowed} times are allowed`);
process.exitCode = !all.length ? 2 : all.every((one) => one.ok) ? 0 : 1;

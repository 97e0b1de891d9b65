// node draw.mjs PACKAGES results.csv FOLDER: charts as SVG and PNG, and index.html with all of them, into FOLDER.
// PACKAGES is the folder whose node_modules hold what package.json names.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { distinct, parseResults } from './figures.mjs';
import { chartOption, themes } from './options.mjs';
import { chartName, pageOf } from './page.mjs';
import { parsePictures } from './pictures.mjs';
import { sections } from './sections.mjs';
import { gridSvg } from './tables.mjs';

const [packages, results, folder] = process.argv.slice(2);
const require = createRequire(resolve(packages, 'package.json'));
const echarts = require('echarts');
const { Resvg } = require('@resvg/resvg-js');
const here = dirname(fileURLToPath(import.meta.url));
const read = (file) => readFileSync(join(here, file), 'utf8');

const size = { width: 1000, height: 620 };

function svgOf(asked) {
  const chart = echarts.init(null, null, { renderer: 'svg', ssr: true, ...size });
  chart.setOption(chartOption(asked, themes.light, size.width));
  const svg = chart.renderToSVGString();
  chart.dispose();
  return svg;
}

function pngOf(svg) {
  const font = { loadSystemFonts: true, defaultFontFamily: 'DejaVu Sans', sansSerifFamily: 'DejaVu Sans' };
  return new Resvg(svg, { font, fitTo: { mode: 'zoom', value: 2 } }).render().asPng();
}

function write(name, svg) {
  writeFileSync(join(folder, `${name}.svg`), svg);
  writeFileSync(join(folder, `${name}.png`), pngOf(svg));
}

function drawGrid(section, rows) {
  const own = rows.filter((row) => row.kind === section.kind);
  if (own.length) write(section.kind, gridSvg(own, section.title, distinct));
}

function drawSection(section, rows) {
  for (const scene of distinct(rows.filter((row) => row.kind === section.kind), 'scene'))
    for (const [i, j] of section.drawn) {
      const [x, y] = [section.x[i], section.y[j]];
      const svg = svgOf({ section, scene, x, y, rows, title: `${section.title.split(':')[0]}, ${scene}` });
      write(chartName(section, scene, x, y), svg);
    }
}

// The modules as one script: what they import is in it.
const inlined = (files) => files.map(read).join('\n').replace(/^import .*\n/gm, '').replace(/^export /gm, '');

const { notes, rows } = parseResults(readFileSync(results, 'utf8'));
for (const section of sections) (section.grid ? drawGrid : drawSection)(section, rows);
const lights = join(dirname(results), 'pictures.csv');
writeFileSync(join(folder, 'index.html'), pageOf({
  sections, rows, notes, pictures: parsePictures(existsSync(lights) ? readFileSync(lights, 'utf8') : ''), style: read('style.css'),
  library: readFileSync(require.resolve('echarts/dist/echarts.min.js'), 'utf8'),
  modules: inlined(['figures.mjs', 'sections.mjs', 'choose.mjs', 'options.mjs']), script: read('browser.js'),
}));

// The page with all charts and their tables: one file that needs no other.
import { defaultsBehind } from './choose.mjs';
import { distinct, shown, slug } from './figures.mjs';
import { picturesHtml } from './pictures.mjs';
import { escaped, gridOf, tableOf } from './tables.mjs';

function chartHtml(section, scene, rows, pictures) {
  const own = rows.filter((row) => row.kind === section.kind && row.scene === scene);
  return `<figure><h3>${escaped(scene)}</h3>
<div class="chart" role="img" aria-label="${escaped(section.title + ': ' + scene)}" data-kind="${section.kind}" data-scene="${escaped(scene)}"></div>
${picturesHtml(own, pictures)}<details><summary>Table: ${own.length} measurements</summary><div class="wide">${tableOf(section, own)}</div></details></figure>`;
}

function choice(section, along) {
  const figures = section[along];
  if (figures.length < 2) return '';
  const options = figures.map((f, i) => `<option value="${i}">${escaped(f.name)}</option>`).join('');
  return `<label>${along === 'x' ? 'across' : 'upwards'} <select data-kind="${section.kind}" data-along="${along}">${options}</select></label> `;
}

function sectionHtml(section, rows, pictures) {
  const own = rows.filter((row) => row.kind === section.kind);
  const head = `<section id="${section.kind}"><h2>${escaped(section.title)}</h2><p>${escaped(section.lead)}</p>`;
  if (section.grid) return `${head}<div class="wide">${gridOf(own, distinct)}</div></section>`;
  const charts = distinct(own, 'scene').map((scene) => chartHtml(section, scene, rows, pictures)).join('\n');
  return `${head}<p class="choices">${choice(section, 'x')}${choice(section, 'y')}</p><div class="charts">${charts}</div></section>`;
}

// A form that names the fastest setting for a scene and an error, and what the defaults cost.
function chooserHtml(sections, rows) {
  const options = sections.filter((s) => s.command).flatMap((s) =>
    distinct(rows.filter((row) => row.kind === s.kind), 'scene')
      .map((scene) => `<option value="${escaped(JSON.stringify([s.kind, scene]))}">${s.kind}: ${escaped(scene)}</option>`));
  const behind = defaultsBehind(sections, rows).map(({ row, best, cost, factor }) =>
    `<tr><td>${row.kind}</td><td>${escaped(row.scene)}</td><td>${escaped(row.method)}, ${escaped(row.setting)}</td>` +
    `<td>${escaped(best.method)}, ${escaped(best.setting)}</td><td>${shown(factor)} times the ${escaped(cost.name)}</td></tr>`);
  if (!options.length) return '';
  return `<section id="choose"><h2>Choose for me</h2>
<form id="chooser"><label>scene <select name="scene">${options.join('')}</select></label>
<label>error of at most <input name="error" type="number" step="any" min="0" value="0.001"></label>
<label>with the least <select name="cost"></select></label>
<label><input name="offered" type="checkbox" checked> of what the programs offer</label> <output></output></form>
<details><summary>Table: the defaults beside the cheapest that is no less right</summary><div class="wide"><table>
<thead><tr><th>kind</th><th>scene</th><th>default</th><th>cheapest as right</th><th>the default takes</th></tr></thead>
<tbody>${behind.join('\n')}</tbody></table></div></details></section>`;
}

/// `scripts`: the text of the charting library; of the modules that make options, without imports and exports;
/// of what runs in the page.
export function pageOf({ sections, rows, notes, pictures, style, library, modules, script }) {
  const shownSections = sections.filter((s) => rows.some((row) => row.kind === s.kind));
  const links = shownSections.map((s) => `<a href="#${s.kind}">${s.kind}</a>`).join(' ');
  const machines = distinct(rows, 'machine').join('; ');
  const data = JSON.stringify(rows, (key, value) => (Number.isNaN(value) ? null : value)).replace(/</g, '\\u003c');
  return `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><title>libsdf: speed against accuracy</title><style>${style}</style></head>
<body><header><h1>libsdf: speed against accuracy</h1>
<p>Every method measured both ways: how fast, and how right. Lower left is better unless an axis says otherwise. Touch or
point at a mark to read it. Marks have shapes of their own, so that the charts can be read without colours.</p>
<p class="small">${escaped(machines)}<br>${escaped(notes.join('; '))}; times are medians</p><nav>${links}</nav></header>
<main>${chooserHtml(shownSections, rows)}
${shownSections.map((s) => sectionHtml(s, rows, pictures)).join('\n')}</main>
<script>${library.replace(/<\/script/g, '<\\/script')}</script>
<script type="module">${modules}
const rows = ${data}.map((row) => Object.fromEntries(Object.entries(row).map(([k, v]) => [k, v === null ? NaN : v])));
${script}</script></body></html>
`;
}

export const chartName = (section, scene, x, y) =>
  [section.kind, slug(scene), slug(x.name), slug(y.name)].join('-');

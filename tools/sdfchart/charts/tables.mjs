// Tables of the charts' rows, as HTML.
import { shown } from './figures.mjs';

export const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);

/// The rows with every figure of the section that one of them has.
export function tableOf(section, rows) {
  const figures = [...section.x, ...section.y].filter((f) => rows.some((row) => Number.isFinite(f.of(row))));
  const heads = ['method', 'setting', ...figures.map((f) => f.name + (f.unit ? `, ${f.unit}` : '')), 'runs'];
  const cells = (row) => {
    if (row.status !== 'ok') return `<td colspan="${figures.length + 1}">✕ ${escaped(row.status)}</td>`;
    return [...figures.map((f) => f.of(row)), row.runs].map((v) => `<td class="number">${shown(v)}</td>`).join('');
  };
  const body = rows.map((row) => `<tr${row.default === 1 ? ' class="default"' : ''}><td>${escaped(row.method)}</td>` +
    `<td>${escaped(row.setting)}${row.default === 1 ? ' (default)' : ''}</td>${cells(row)}</tr>`);
  return `<table><thead><tr>${heads.map((h) => `<th>${escaped(h)}</th>`).join('')}</tr></thead>` +
    `<tbody>${body.join('\n')}</tbody></table>`;
}

const signs = { holds: '●', degrades: '◐', fails: '✕' };

/// The grid of the known failures: a row for each case, a column for each method.
export function gridOf(rows, distinct) {
  const methods = distinct(rows, 'method');
  const cell = (row) => {
    if (!row) return '<td></td>';
    if (row.status !== 'ok') return `<td class="fails" title="${escaped(row.status)}">✕ did not run</td>`;
    const figure = row.verdict === 'holds' ? '' : ` ${shown(row.error_max)}`;
    return `<td class="${row.verdict}" title="${escaped(row.setting)}: ${shown(row.error_max)}">` +
      `${signs[row.verdict]} ${row.verdict}${figure}<small>${escaped(row.setting)}</small></td>`;
  };
  const body = distinct(rows, 'scene').map((scene) => `<tr><th>${escaped(scene)}</th>` +
    methods.map((m) => cell(rows.find((row) => row.scene === scene && row.method === m))).join('') + '</tr>');
  return `<table class="grid"><thead><tr><th>case</th>${methods.map((m) => `<th>${escaped(m)}</th>`).join('')}</tr></thead>` +
    `<tbody>${body.join('\n')}</tbody></table>`;
}

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

// As style.css has them on light.
const fills = { holds: '#d5ecd9', degrades: '#fdeebf', fails: '#f6c9c0' };

/// The same grid as an SVG, without what the methods do.
export function gridSvg(rows, title, distinct) {
  const methods = distinct(rows, 'method'), cases = distinct(rows, 'scene');
  const [left, wide, line, above] = [400, 290, 22, 70];
  const width = left + wide * methods.length + 10, height = above + line * cases.length + 10;
  const text = (x, y, words, more = '') => `<text x="${x}" y="${y}"${more}>${escaped(words)}</text>`;
  const bold = ' font-weight="bold"';
  const cell = (row, i, k) => {
    if (!row) return '';
    const verdict = row.status === 'ok' ? row.verdict : 'fails';
    const words = row.status === 'ok' ? `${signs[verdict]} ${verdict}${verdict === 'holds' ? '' : ` ${shown(row.error_max)}`}` : '✕ did not run';
    const [x, y] = [left + wide * k, above + line * i];
    return `<rect x="${x}" y="${y}" width="${wide - 2}" height="${line - 2}" fill="${fills[verdict]}"/>${text(x + 8, y + 14, words)}`;
  };
  const lines = cases.map((name, i) => text(10, above + line * i + 14, name) +
    methods.map((method, k) => cell(rows.find((row) => row.scene === name && row.method === method), i, k)).join(''));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" ` +
    `font-family="DejaVu Sans, sans-serif" font-size="12" fill="#1a1a1a"><rect width="100%" height="100%" fill="#ffffff"/>` +
    text(10, 26, title, `${bold} font-size="16"`) + text(10, above - 10, 'case', bold) +
    methods.map((method, k) => text(left + wide * k + 8, above - 10, method, bold)).join('') + lines.join('\n') + '</svg>\n';
}

// Rows of results.csv, and what is computed from them.

/// The rows of a file as objects by column; numbers where the cell is one, NaN where a number's cell is empty.
/// Lines that begin with # are comments and come back in `notes`.
export function parseResults(text) {
  const texts = new Set(['kind', 'scene', 'method', 'setting', 'verdict', 'status', 'machine']);
  const lines = text.split('\n').filter((line) => line !== '');
  const notes = lines.filter((line) => line.startsWith('#')).map((line) => line.slice(1).trim());
  const [names, ...cells] = lines.filter((line) => !line.startsWith('#')).map(splitLine);
  if (!names || names[0] !== 'kind') throw new Error('this is no results.csv of sdfchart: its columns are not named');
  const rows = cells.filter((cell) => cell.length === names.length).map((cell) =>
    Object.fromEntries(names.map((name, i) => [name, texts.has(name) ? cell[i] : cell[i] === '' ? NaN : +cell[i]])));
  return { notes, rows };
}

/// The cells of a line.
export function splitLine(line) {
  const cells = [''];
  let quoted = false;
  for (let i = 0; i < line.length; i++) {
    if (line[i] === '"' && quoted && line[i + 1] === '"') cells[cells.length - 1] += line[++i];
    else if (line[i] === '"') quoted = !quoted;
    else if (line[i] === ',' && !quoted) cells.push('');
    else cells[cells.length - 1] += line[i];
  }
  return cells;
}

/// The values of `key` in the rows, each once, in the order of their first rows.
export const distinct = (rows, key) => [...new Set(rows.map((row) => row[key]))];

/// Of points { x, y }, less being better in both, those that no other is as good as in both, by x.
export function paretoFront(points) {
  const front = [];
  for (const p of [...points].sort((a, b) => a.x - b.x || a.y - b.y))
    if (!front.length || p.y < front[front.length - 1].y) front.push(p);
  return front;
}

/// The exponent p of y ~ x^p by least squares of the logarithms; NaN where there are fewer than two sizes.
export function fittedExponent(points) {
  const logs = points.filter((p) => p.x > 0 && p.y > 0).map((p) => [Math.log(p.x), Math.log(p.y)]);
  if (new Set(logs.map(([x]) => x)).size < 2) return NaN;
  const mean = (i) => logs.reduce((sum, l) => sum + l[i], 0) / logs.length;
  const [mx, my] = [mean(0), mean(1)];
  return logs.reduce((sum, [x, y]) => sum + (x - mx) * (y - my), 0) /
    logs.reduce((sum, [x]) => sum + (x - mx) ** 2, 0);
}

/// A number for people: 3 digits, powers of ten as 10⁻⁶, empty for NaN.
export function shown(value) {
  if (Number.isNaN(value)) return '';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) {
    const [digits, exponent] = value.toExponential(2).split('e');
    return `${+digits}·10${raised(exponent)}`;
  }
  return size >= 1000 ? String(Math.round(value)) : String(+value.toPrecision(3));
}

/// An exponent in raised digits.
export const raised = (exponent) => String(+exponent).replace(/[-0-9]/g, (c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[+c]));

/// A word for a file's name.
export const slug = (text) => text.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');

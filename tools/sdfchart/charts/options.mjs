// Options of ECharts for each chart: the same in the page and in the SVG files.
import { axisName, nameIn } from './sections.mjs';
import { distinct, fittedExponent, paretoFront, raised, shown } from './figures.mjs';

// Shapes and dashes that greyscale shows; a hollow shape is filled as its background.
const plus = 'path://M4 0h2v4h4v2h-4v4h-2v-4h-4v-2h4z', star = 'path://M5 0l1.2 3.8h4l-3.2 2.4 1.2 3.8-3.2-2.3-3.2 2.3 1.2-3.8-3.2-2.4h4z';
const cross = 'path://M1 0l4 4l4 -4l1 1l-4 4l4 4l-1 1l-4 -4l-4 4l-1 -1l4 -4l-4 -4z';
const solid = ['circle', 'rect', 'triangle', 'diamond'];
const symbols = [...solid, ...solid, plus, star];
const isHollow = (i) => i % symbols.length >= 4 && i % symbols.length < 8;
const dashes = ['solid', 'dashed', 'dotted', [8, 3, 2, 3]];

// On narrow screens the names stand in the legend alone; else also beside the lines, in a column so wide.
const isNarrow = (width) => width < 600;
const nameWidth = 245;
const rightOf = (narrow) => (narrow ? 16 : nameWidth);

// The colours of lines are Okabe and Ito's (2008), which the colour-blind can tell, and some more; on dark they are lighter.
export const themes = {
  light: { text: '#1a1a1a', faint: '#6b6b6b', line: '#dddddd', back: '#ffffff', front: '#444444',
    lines: ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b8860b', '#56b4e9', '#7f3c8d', '#888888', '#a0522d', '#2f4f9f'] },
  dark: { text: '#eeeeee', faint: '#a8a8a8', line: '#3a3a3a', back: '#161a1d', front: '#bbbbbb',
    lines: ['#4aa3df', '#ff8c42', '#2fc89a', '#e8a0c8', '#e0b040', '#9fd8f8', '#c79ad6', '#b0b0b0', '#d98c6a', '#93a8f0'] },
};
const colourOf = (i, theme) => theme.lines[i % theme.lines.length];

/// The points of a chart by series: rows with both figures, and those that failed.
export function pointsOf(section, scene, x, y, rows) {
  const own = rows.filter((row) => row.kind === section.kind && row.scene === scene);
  const ok = own.filter((row) => row.status === 'ok');
  // What has no place along x, as a scheme without a step, is a line across the chart.
  const places = ok.map((row) => x.of(row)).filter((v) => v > 0);
  const ends = [Math.min(...places), Math.max(...places)];
  const point = (row) => (Number.isNaN(x.of(row)) ? ends : [x.of(row)]).map((v) => ({ x: v, y: y.of(row), row }));
  const series = distinct(own, section.series).map((name, i) => ({
    name, i,
    points: ok.filter((row) => row[section.series] === name).flatMap(point)
      .filter((p) => p.x > 0 && Number.isFinite(p.x) && Number.isFinite(p.y)),
  }));
  return { series, failed: own.filter((row) => row.status !== 'ok') };
}

// A logarithmic axis has no place for 0: it is shown at a power of ten below the least that is above it, where the axis
// then begins and says 0. None where nothing is 0.
function zeroOf(series) {
  const values = series.flatMap((s) => s.points.map((p) => p.y));
  if (values.every((y) => y > 0)) return undefined;
  const above = values.filter((y) => y > 0);
  return above.length ? 10 ** Math.floor(Math.log10(Math.min(...above)) - 0.5) : 1e-3;
}

const described = (row) =>
  [`<b>${row.method}</b>`, row.setting + (row.default === 1 ? ' — the default' : ''), row.scene].join('<br>');

function tooltipOf(p, x, y) {
  const row = p.row;
  const value = (figure, v) => `${nameIn(figure, row.scene)}: ${shown(v)} ${figure.unit}`;
  const spread = Number.isNaN(row.seconds) ? '' :
    `<br>${shown(row.runs)} runs, the middle half from ${shown(row.seconds_q1)} to ${shown(row.seconds_q3)} s`;
  return `${described(row)}<br>${value(x, p.x)}<br>${value(y, p.y)}${spread}`;
}

const wordsOf = { axis: (v) => {
  const power = Math.log10(v);
  if (Math.abs(power - Math.round(power)) > 1e-6) return '';
  return Math.abs(power) > 3 ? `10${raised(Math.round(power))}` : String(+v.toPrecision(6));
} };

// The axis of values of which some are 0.
const zeroAxis = (zero, series, color) => ({
  min: zero, max: series.every((s) => s.points.every((p) => p.y <= 0)) ? 1 : undefined,
  axisLabel: { color, hideOverlap: true, formatter: (v) => (v <= zero * 1.001 ? '0' : wordsOf.axis(v)) },
});

function axis(figure, along, scene, theme, narrow) {
  return {
    type: 'log', name: axisName(figure, along, scene), nameLocation: 'middle', nameGap: along === 'x' ? 28 : narrow ? 40 : 48,
    nameTextStyle: { color: theme.text, fontSize: narrow ? 11 : 13 },
    axisLabel: { color: theme.text, formatter: wordsOf.axis, hideOverlap: true },
    axisLine: { show: true, lineStyle: { color: theme.faint } }, axisTick: { show: true },
    splitLine: { lineStyle: { color: theme.line } },
  };
}

function lineSeries(s, { x, y, section }, floor, theme, width) {
  const narrow = isNarrow(width);
  const colour = colourOf(s.i, theme);
  const last = s.points.reduce((right, p, k) => (p.x >= s.points[right].x ? k : right), 0); // whose name stands beside it
  const exponent = section.fit ? fittedExponent(s.points) : NaN;
  const name = s.name + (Number.isNaN(exponent) ? '' : `  ^${exponent.toFixed(2)}`);
  return {
    name, type: 'line', color: colour, symbol: symbols[s.i % symbols.length], symbolSize: narrow ? 8 : 10,
    lineStyle: { color: colour, width: 1.5, type: dashes[Math.floor(s.i / 2) % dashes.length] },
    itemStyle: { color: isHollow(s.i) ? theme.back : colour, borderColor: colour, borderWidth: isHollow(s.i) ? 2 : 0 }, z: 3, clip: false,
    labelLayout: { x: width - nameWidth + 22, moveOverlap: 'shiftY' },
    labelLine: { show: !narrow, length2: 4, lineStyle: { color: colour, width: 0.8 } },
    data: s.points.map((p, k) => ({
      value: [p.x, Math.max(p.y, floor)], told: tooltipOf(p, x, y),
      label: k === last && !narrow
        ? { show: true, align: 'left', minMargin: 8, color: theme.text, fontSize: 12, formatter: name }
        : { show: false },
    })),
  };
}

const frontName = 'Pareto front';

function frontSeries(series, floor, theme) {
  const front = paretoFront(series.flatMap((s) => s.points.map((p) => ({ x: p.x, y: Math.max(p.y, floor) }))));
  return {
    name: frontName, type: 'line', step: 'end', symbol: 'none', showSymbol: false, silent: true, z: 1, color: theme.front,
    lineStyle: { color: theme.front, width: 5, opacity: 0.3 }, data: front.map((p) => [p.x, p.y]),
  };
}

// A ring around the points that the programs take where nothing is said.
function defaultSeries(series, floor, theme, narrow) {
  const data = series.flatMap((s) => s.points).filter((p) => p.row.default === 1)
    .filter((p, i, all) => all.findIndex((other) => other.row === p.row) === i);
  return {
    name: 'default', type: 'scatter', symbol: 'circle', symbolSize: 20, silent: true, z: 4, color: theme.text,
    itemStyle: { color: 'transparent', borderColor: theme.text, borderWidth: 2 },
    data: data.map((p, k) => ({
      value: [p.x, Math.max(p.y, floor)],
      label: { show: !narrow && data.findIndex((other) => other.row.method === p.row.method) === k, position: 'top', distance: 3, formatter: 'default', color: theme.text, fontWeight: 'bold',
        textBorderColor: theme.back, textBorderWidth: 3 },
    })),
  };
}

/// A chart of one scene with these figures along its axes. `title` is drawn within it, where it is given.
export function chartOption(asked, theme, width) {
  const { section, scene, x, y, rows, title } = asked;
  const narrow = isNarrow(width);
  const { series, failed } = pointsOf(section, scene, x, y, rows);
  const zero = zeroOf(series), floor = zero ?? 0;
  const drawn = series.filter((s) => s.points.length);
  const lines = drawn.map((s) => lineSeries(s, asked, floor, theme, width));
  const all = section.pareto && y.better < 0 && x.better < 0 ? [frontSeries(drawn, floor, theme), ...lines] : lines;
  const standard = defaultSeries(drawn, floor, theme, narrow);
  if (standard.data.length) all.push(standard);
  const legendRows = legendRowsOf(all.map((one) => one.name), narrow, width);
  const above = (title ? 34 : 4) + (16 + legendGap(narrow)) * legendRows + 10;
  return {
    animation: false, backgroundColor: theme.back, textStyle: { fontFamily: 'DejaVu Sans, sans-serif' },
    title: title ? { text: title, left: 8, top: 6, textStyle: { color: theme.text, fontSize: narrow ? 13 : 16 } } : undefined,
    legend: { top: title ? 34 : 4, left: 8, right: 8, itemWidth: 28, itemGap: legendGap(narrow), textStyle: { color: theme.text, fontSize: narrow ? 11 : 12 },
      data: all.map(({ name }) => (name === frontName ? { name, icon: 'path://M0 0h30v5h-30z' } : { name })) },
    grid: { left: narrow ? 62 : 74, right: rightOf(narrow), top: above, bottom: 56 },
    tooltip: { trigger: 'item', confine: true, formatter: (p) => p.data.told ?? '' },
    xAxis: axis(x, 'x', scene, theme, narrow), yAxis: { ...axis(y, 'y', scene, theme, narrow), ...(zero ? zeroAxis(zero, series, theme.text) : {}) },
    series: [...all, ...failureSeries(failed, series, above, theme, width)],
  };
}

const legendGap = (narrow) => (narrow ? 8 : 30);

// How many rows the legend will take: names as wide as DejaVu Sans draws them, about.
function legendRowsOf(names, narrow, width) {
  const letter = narrow ? 6 : 6.2, gap = legendGap(narrow);
  let rows = 1, used = 0;
  for (const name of names) {
    const wide = 36 + letter * name.length + gap;
    if (used + wide > width - 16) rows++, used = 0;
    used += wide;
  }
  return rows;
}

// What failed has no place along the axes: crosses in the corner of what is slow and wrong, each with its method's name.
function failureSeries(failed, series, above, theme, width) {
  const narrow = isNarrow(width), right = width - rightOf(narrow);
  return distinct(failed, 'method').map((method, k) => {
    const own = failed.filter((row) => row.method === method);
    const reasons = distinct(own, 'status').map((status) =>
      `${status}: ${own.filter((row) => row.status === status).map((row) => row.setting).join(', ')}`);
    const colour = colourOf(series.find((s) => s.name === method).i, theme);
    return {
      name: `${method}, failed`, type: 'scatter', data: [], z: 5,
      markPoint: {
        symbol: cross, symbolSize: 10, itemStyle: { color: colour },
        data: [{
          x: right - 10, y: above + 12 + 16 * k, told: `<b>${method}</b><br>${reasons.join('<br>')}`,
          label: { show: true, position: 'left', color: theme.text, fontSize: narrow ? 10 : 12, formatter: `${method}: ${own.length} failed`,
            textBorderColor: theme.back, textBorderWidth: 3 },
        }],
      },
    };
  });
}

// Runs in the page: draws the charts at the window's width, and again where it, the theme or a choice changes.
const dark = matchMedia('(prefers-color-scheme: dark)');
const boxes = [...document.querySelectorAll('.chart')];
const chosen = {};

function draw(box) {
  const section = sections.find((s) => s.kind === box.dataset.kind);
  const { x = 0, y = 0 } = chosen[section.kind] ?? {};
  const chart = echarts.getInstanceByDom(box) ?? echarts.init(box, null, { renderer: 'svg' });
  chart.resize();
  const asked = { section, scene: box.dataset.scene, x: section.x[x], y: section.y[y], rows };
  chart.setOption(chartOption(asked, themes[dark.matches ? 'dark' : 'light'], box.clientWidth), true);
}
const drawAll = () => boxes.forEach(draw);

for (const select of document.querySelectorAll('select[data-kind]'))
  select.addEventListener('change', () => {
    const { kind, along } = select.dataset;
    chosen[kind] = { ...chosen[kind], [along]: +select.value };
    boxes.filter((box) => box.dataset.kind === kind).forEach(draw);
  });
const chooser = document.getElementById('chooser');
let costs; // of the section whose scene is chosen

// The figures that a choice can be cheap in are those along x of which less is better.
function listCosts(section) {
  const figures = section.x.filter((figure) => figure.better < 0);
  if (costs?.[0] === figures[0]) return;
  costs = figures;
  chooser.elements.cost.replaceChildren(...costs.map((figure, i) => new Option(figure.name, i)));
}

// The least error, and whose it is.
function nearest(section, scene, among, off) {
  const known = among.filter((row) => row.kind === section.kind && row.scene === scene && row.status === 'ok' && off.of(row) >= 0);
  const best = known.sort((a, b) => off.of(a) - off.of(b))[0];
  return best ? `${best.method}, ${best.setting}: ${shown(off.of(best))} ${off.unit}` : 'none, for all failed';
}

function choose() {
  const [kind, scene] = JSON.parse(chooser.elements.scene.value);
  const section = sections.find((s) => s.kind === kind);
  listCosts(section);
  const cost = costs[+chooser.elements.cost.value], off = section.y[0];
  const among = chooser.elements.offered.checked ? offered(section, rows) : rows;
  const best = fastestWithin(section, scene, among, +chooser.elements.error.value, cost);
  chooser.querySelector('output').textContent = best
    ? `→ ${best.method}, ${best.setting}: error ${shown(off.of(best))} ${off.unit}, ${cost.name} ${shown(cost.of(best))} ${cost.unit}`.trimEnd() +
      (best.asked ? ` — ${best.asked}` : '')
    : `→ nothing that was measured keeps it; the nearest is ${nearest(section, scene, among, off)}`;
}
if (chooser) {
  chooser.addEventListener('input', choose);
  chooser.addEventListener('submit', (event) => event.preventDefault());
  choose();
}

dark.addEventListener('change', drawAll);
addEventListener('resize', drawAll);
drawAll();
document.body.dataset.drawn = boxes.length;

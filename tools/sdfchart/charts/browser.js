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

for (const select of document.querySelectorAll('select'))
  select.addEventListener('change', () => {
    const { kind, along } = select.dataset;
    chosen[kind] = { ...chosen[kind], [along]: +select.value };
    boxes.filter((box) => box.dataset.kind === kind).forEach(draw);
  });
function choose() {
  const [kind, scene] = JSON.parse(chooser.elements.scene.value);
  const section = sections.find((s) => s.kind === kind);
  const error = +chooser.elements.error.value, [time, off] = [section.x[0], section.y[0]];
  const best = fastestWithin(section, scene, rows, error);
  chooser.querySelector('output').textContent = best
    ? `→ ${best.method}, ${best.setting}: error ${shown(off.of(best))} ${off.unit} in ${shown(time.of(best))} ${time.unit}`
    : '→ nothing that was measured keeps it';
}
const chooser = document.getElementById('chooser');
if (chooser) {
  chooser.addEventListener('input', choose);
  chooser.addEventListener('submit', (event) => event.preventDefault());
  choose();
}

dark.addEventListener('change', drawAll);
addEventListener('resize', drawAll);
drawAll();
document.body.dataset.drawn = boxes.length;

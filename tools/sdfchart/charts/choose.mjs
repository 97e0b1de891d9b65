// The fastest setting that keeps an error, from what was measured; and how far the defaults are behind it.

/// Of the section's rows of one scene, the fastest whose error (the section's first) is at most `error`.
export function fastestWithin(section, scene, rows, error) {
  const [time, off] = [section.x[0], section.y[0]];
  return rows.filter((row) => row.kind === section.kind && row.scene === scene && row.status === 'ok')
    .filter((row) => off.of(row) <= error && time.of(row) > 0)
    .sort((a, b) => time.of(a) - time.of(b))[0];
}

/// For each default among the rows: the fastest row of its section and scene that is no less right, and how many
/// times as long the default takes.
export function defaultsBehind(sections, rows) {
  const behind = [];
  for (const section of sections.filter((s) => s.pareto))
    for (const row of rows.filter((r) => r.kind === section.kind && r.default === 1 && r.status === 'ok')) {
      const best = fastestWithin(section, row.scene, rows, section.y[0].of(row));
      behind.push({ row, best, factor: section.x[0].of(row) / section.x[0].of(best) });
    }
  return behind;
}

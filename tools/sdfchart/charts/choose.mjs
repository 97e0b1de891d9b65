// The fastest setting that keeps an error, from what was measured; and how far the defaults are behind it.

/// Of the section's rows of one scene, that of the least `cost` (a figure; the section's first along x if none is
/// named) of which `off` (a figure; the first along y) is at most `error`.
export function fastestWithin(section, scene, rows, error, cost = section.x[0], off = section.y[0]) {
  return rows.filter((row) => row.kind === section.kind && row.scene === scene && row.status === 'ok')
    .filter((row) => off.of(row) <= error && cost.of(row) > 0)
    .sort((a, b) => cost.of(a) - cost.of(b))[0];
}

/// The rows that a user can ask a program for, each with what is to be said (`asked`).
export const offered = (section, rows) =>
  rows.map((row) => ({ ...row, asked: row.kind === section.kind ? section.command?.(row) : undefined })).filter((row) => row.asked);

/// For each default of the sections that say what theirs are chosen for (`held`): the row that is no less right at
/// the least of that cost, how many times as much the default costs, and whether that is more than is allowed.
export function defaultsBehind(sections, rows) {
  const behind = [];
  for (const section of sections.filter((s) => s.held)) {
    const cost = section.x[section.held.x];
    for (const row of rows.filter((r) => r.kind === section.kind && r.default === 1 && r.status === 'ok')) {
      const best = fastestWithin(section, row.scene, rows, section.y[0].of(row), cost);
      const factor = cost.of(row) / cost.of(best);
      behind.push({ row, best, cost, factor, allowed: section.held.factor, ok: factor <= section.held.factor });
    }
  }
  return behind;
}

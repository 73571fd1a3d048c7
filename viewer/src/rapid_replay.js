// SPDX-License-Identifier: MIT
// What the paper's rapid search does for a chosen ε, from a trace that was recorded to its end.

/**
 * @param trace [{level, direction, score}], level 0 the corners, then one ring a level.
 * @returns {path: [{direction, score}], evaluations, levels}: where the search stood after each level.
 */
export function replayRapid(trace, goal, epsilon) {
  const better = (a, b) => (goal === 'best' ? a > b : a < b);
  const rings = [];
  for (const step of trace) {
    (rings[step.level] ??= []).push(step);
  }
  const bestOf = (ring) => ring.reduce((best, step) => (better(step.score, best.score) ? step : best));
  let here = bestOf(rings[0]);
  let evaluations = rings[0].length;
  const path = [here];
  for (const ring of rings.slice(1)) {
    const best = bestOf(ring);
    evaluations += ring.length;
    const gain = Math.abs(here.score - best.score);
    if (!better(here.score, best.score)) {
      here = best;
    }
    path.push(here);
    if (gain < epsilon) {
      break;
    }
  }
  return { path, evaluations, levels: path.length - 1 };
}

// Which path and vertex is under a point of the screen.
import { projectedSegment } from "./scene_marks.js";
import { segmentEnds } from "./strokes.js";

const kVertexReach = 11, kLineReach = 7;

export function distanceToSegment([x, y], [[ax, ay], [bx, by]]) {
  const dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
  const t = squared > 0 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / squared, 0), 1) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

function nearestVertex(path, at, project) {
  let best = { vertex: -1, distance: kVertexReach };
  path.points.forEach((point, vertex) => {
    const screen = point && project(point);
    const distance = screen ? Math.hypot(screen[0] - at[0], screen[1] - at[1]) : Infinity;
    if (distance < best.distance) best = { vertex, distance };
  });
  return best.vertex;
}

/** {path, vertex}, -1 for none. The selected path comes first: one wants its vertices. Others only if they are shown. */
export function pick(at, paths, selected, othersShown, project) {
  const own = selected >= 0 ? nearestVertex(paths[selected], at, project) : -1;
  if (own >= 0) return { path: selected, vertex: own };
  let best = { path: -1, vertex: -1, distance: kLineReach };
  for (const path of paths) {
    if (!othersShown && path.index !== selected) continue;
    for (const segment of path.segments) {
      const ends = segmentEnds(path, segment), screen = ends && projectedSegment(project, ...ends);
      const distance = screen ? distanceToSegment(at, screen) : Infinity;
      if (distance < best.distance) best = { path: path.index, vertex: segment[1], distance };
    }
  }
  return { path: best.path, vertex: best.vertex };
}

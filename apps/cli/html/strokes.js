// Lines of paths as the 3D view draws them: start, end, colour, shape (width, halo, dash), thirteen floats each.
import { add, cross, normalized, norm, scale, subtract } from "./vector.js";

const kSegmentColors = ["path", "light", "light"];  // by kind: scattered, to an emitter, to the environment

/** Ends of one segment of the data. */
export function segmentEnds(path, [from, to]) {
  const start = from < 0 ? path.origin : path.points[from], end = path.points[to];
  return start && end ? [start, end] : null;
}

export class Strokes {
  constructor() {
    this.floats = [];
  }

  add(start, end, color, alpha, width, halo = 0, dash = 0) {
    this.floats.push(...start, ...end, ...color, alpha, width, halo, dash);
  }

  array() {
    return new Float32Array(this.floats);
  }
}

/** All paths, faint: the more there are, the fainter. */
export function allPaths(paths, colors, faint) {
  const strokes = new Strokes();
  const alpha = Math.min(Math.max(5 / Math.sqrt(paths.length + 1), 0.1), 0.75) * (faint ? 0.55 : 1);
  for (const path of paths)
    for (const segment of path.segments) {
      const ends = segmentEnds(path, segment);
      if (ends) strokes.add(...ends, colors[kSegmentColors[segment[2]]], alpha, 1.3);
    }
  return strokes.array();
}

/** One path with its next events. */
export function onePath(path, vertex, colors, withEvents) {
  const strokes = new Strokes();
  for (const segment of path.segments) {
    const ends = segmentEnds(path, segment);
    if (!ends) continue;
    const color = segment[2] === 0 && segment[1] === vertex ? colors.current : colors[kSegmentColors[segment[2]]];
    strokes.add(...ends, color, 1, 3.4, 1.3);
  }
  // Last and thinner: where a shadow ray goes the path's way, both are seen.
  if (withEvents)
    path.json.vertices.forEach((v, i) => {
      const start = path.points[i];
      for (const event of v.nee) {
        const end = event.position;
        if (!start || !end.every(Number.isFinite)) continue;
        const here = vertex < 0 || vertex === i ? 1 : 0.55;
        strokes.add(start, end, event.visible ? colors.visible : colors.occluded, here, 2, 0.8, event.visible ? 0 : 7);
      }
    });
  return strokes.array();
}

export function hoveredPath(path, colors) {
  const strokes = new Strokes();
  for (const segment of path.segments) {
    const ends = segmentEnds(path, segment);
    if (ends) strokes.add(...ends, colors[kSegmentColors[segment[2]]], 0.9, 2.2, 1);
  }
  return strokes.array();
}

/** The renderer's camera as a pyramid. */
export function frustum(camera, aspect, size, colors) {
  const strokes = new Strokes();
  if (!camera || camera.kind !== "perspective") return strokes.array();
  const forward = normalized(camera.direction), right = normalized(cross(forward, camera.up), [1, 0, 0]);
  const up = normalized(cross(right, forward)), tan = Math.tan((camera.verticalFieldOfView * Math.PI) / 360);
  const corner = (x, y) => add(camera.position, scale(add(forward, add(scale(right, x * tan * aspect), scale(up, y * tan))), size));
  const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
  const line = (a, b) => strokes.add(a, b, colors.muted, 0.9, 1.5, 0.6);
  corners.forEach((c, i) => {
    line(camera.position, c);
    line(c, corners[(i + 1) % 4]);
  });
  line(corner(-0.35, 1.12), corner(0, 1.5));
  line(corner(0, 1.5), corner(0.35, 1.12));
  return strokes.array();
}

/** Where a person would look to see a path: its points, without those that are far outside of the scene. */
export function pointsInScene(path, bounds) {
  const near = (p) => p && norm(subtract(p, bounds.center)) < bounds.radius * 1.5;
  return path.points.filter(near);
}

// What lies over the 3D view: arrow heads, vertices and their numbers of the selected path, drawn in two dimensions.
import { themeColor } from "./elements.js";
import { segmentEnds } from "./strokes.js";

/** The piece of a segment that is in front of the eye, on the screen; null if none is. */
export function projectedSegment(project, start, end) {
  let a = project(start), b = project(end);
  if (a && b) return [a, b];
  if (!a && !b) return null;
  // Cut by halving: precise enough for an arrow and for picking.
  let near = a ? start : end, far = a ? end : start;
  for (let i = 0; i < 24; ++i) {
    const middle = near.map((c, k) => (c + far[k]) / 2);
    if (project(middle)) near = middle;
    else far = middle;
  }
  const cut = project(near);
  return a ? [a, cut] : [cut, b];
}

function arrow(context, [a, b], color, halo) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  if (length < 44) return;
  const x = a[0] + (b[0] - a[0]) * 0.55, y = a[1] + (b[1] - a[1]) * 0.55;
  const dx = (b[0] - a[0]) / length, dy = (b[1] - a[1]) / length;
  context.beginPath();
  context.moveTo(x + dx * 8, y + dy * 8);
  context.lineTo(x - dx * 6 - dy * 6, y - dy * 6 + dx * 6);
  context.lineTo(x - dx * 6 + dy * 6, y - dy * 6 - dx * 6);
  context.closePath();
  context.lineWidth = 2.5;
  context.lineJoin = "round";
  context.strokeStyle = halo;
  context.fillStyle = color;
  context.stroke();
  context.fill();
}

function disc(context, [x, y], radius, fill, ring, ringWidth) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.lineWidth = ringWidth;
  context.strokeStyle = ring;
  context.stroke();
  context.fillStyle = fill;
  context.fill();
}

function label(context, [x, y], text, chosen, colors) {
  context.font = (chosen ? "600 13px " : "500 11.5px ") + themeColor("sans");
  context.textBaseline = "middle";
  context.textAlign = "center";
  context.lineJoin = "round";
  if (chosen) {
    const width = Math.max(context.measureText(text).width + 11, 20);
    context.beginPath();
    context.roundRect(x - width / 2, y - 10, width, 20, 10);
    context.fillStyle = colors.selected;
    context.strokeStyle = colors.halo;
    context.lineWidth = 2;
    context.stroke();
    context.fill();
    context.fillStyle = "#1b1005";
  } else {
    context.strokeStyle = colors.halo;
    context.lineWidth = 3.5;
    context.strokeText(text, x, y);
    context.fillStyle = colors.text;
  }
  context.fillText(text, x, y + 0.5);
}

/** Beside the line, where the path does not go: outside of its bend, to the right of what is nearly straight. */
function aside(project, path, i) {
  const here = project(path.points[i]);
  let x = 0, y = 0, dx = 0, dy = 1;
  for (const j of [i - 1, i + 1]) {
    const screen = path.points[j] && projectedSegment(project, path.points[i], path.points[j]);
    if (!screen) continue;
    const other = screen[1];  // or where it leaves what the eye sees
    const length = Math.hypot(other[0] - here[0], other[1] - here[1]) || 1;
    dx = (other[0] - here[0]) / length;
    dy = (other[1] - here[1]) / length;
    x -= dx;
    y -= dy;
  }
  const length = Math.hypot(x, y);
  if (length < 0.9) return [here[0] + Math.abs(dy) * 20, here[1] - Math.sign(dy || 1) * dx * 20];
  return [here[0] + (x / length) * 25, here[1] + (y / length) * 25];
}

/** @param project world to pixels of the style sheet, null behind the eye */
export function drawMarks(context, project, path, vertex) {
  const colors = {};
  for (const name of ["path", "light", "current", "selected", "halo", "text"]) colors[name] = themeColor(name);
  for (const segment of path.segments) {
    const ends = segmentEnds(path, segment), screen = ends && projectedSegment(project, ...ends);
    const color = segment[2] > 0 ? colors.light : segment[1] === vertex ? colors.current : colors.path;
    if (screen) arrow(context, screen, color, colors.halo);
  }
  const shown = path.points.map((p) => p && project(p));
  shown.forEach((at, i) => {
    if (at && i !== vertex) disc(context, at, 4.5, colors.path, colors.halo, 2.5);
  });
  if (shown[vertex]) disc(context, shown[vertex], 7, colors.selected, colors.halo, 3);
  shown.forEach((at, i) => {
    if (at && i !== vertex) label(context, aside(project, path, i), String(path.json.vertices[i].depth), false, colors);
  });
  if (shown[vertex]) label(context, aside(project, path, vertex), String(path.json.vertices[vertex].depth), true, colors);
}

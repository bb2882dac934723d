// Plots of what each path contributes: luminance, red green blue, depth. A point is a path; the selected one is on top.
import { byId, themeColor } from "./elements.js";
import { formatNumber, toNumber } from "./format.js";
import { Frame, axisPosition } from "./plot_axis.js";

const kReach = 10;

function plotColors() {
  const colors = {};
  for (const name of ["grid", "border", "muted", "text", "data", "red", "green", "blue", "selected", "halo", "panel", "sans", "warning"]) colors[name] = themeColor(name);
  return colors;
}

class Plot {
  constructor(id, data, selection, label) {
    this.canvas = byId(id);
    this.canvas.setAttribute("aria-label", label);
    this.data = data;
    this.selection = selection;
    this.log = false;
    this.targets = [];  // {x, y, path} of what can be clicked
    new ResizeObserver(() => this.draw()).observe(this.canvas.parentElement);
    this.canvas.addEventListener("click", (event) => {
      const path = this.pathAt(event.offsetX, event.offsetY);
      if (path >= 0) selection.select(path, selection.vertex < 0 ? -1 : 0);
    });
    this.canvas.addEventListener("pointermove", (event) => selection.hover(this.pathAt(event.offsetX, event.offsetY)));
    this.canvas.addEventListener("pointerleave", () => selection.hover(-1));
  }

  pathAt(x, y) {
    let best = { path: -1, distance: kReach };
    for (const target of this.targets) {
      const distance = Math.hypot(target.x - x, target.y - y);
      if (distance < best.distance) best = { path: target.path, distance };
    }
    return best.path;
  }

  /** Sizes the canvas as its place is and paints. */
  draw() {
    const caption = this.canvas.previousElementSibling, figure = this.canvas.parentElement;
    const width = figure.clientWidth, height = figure.clientHeight - caption.offsetHeight;
    if (width < 60 || height < 60) return;
    const ratio = window.devicePixelRatio || 1;
    this.canvas.style.height = height + "px";
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const context = this.canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    this.targets = [];
    this.paint(context, width, height, plotColors());
  }

  /** Values of one quantity over the samples. */
  scatter(context, quantity, color, box, colors, labelsBelow) {
    const axis = this.log ? quantity.log : quantity.linear;
    const { analysis, paths } = this.data, { selection } = this;
    const frame = new Frame(analysis.samples, { ...axis, log: this.log }, box);
    frame.draw(context, colors, labelsBelow);
    const alpha = Math.min(Math.max(16 / Math.sqrt(paths.length + 1), 0.25), 0.85), beyond = new Set([...axis.above, ...axis.below]);
    const put = (path, radius, fill, ring) => {
      const value = quantity.values[path], number = toNumber(value);
      if (value === null || Number.isNaN(number)) return;
      const x = frame.toX(paths[path].json.sample), y = frame.toY(number);
      this.targets.push({ x, y, path });
      context.beginPath();
      if (axis.above.includes(path)) this.triangle(context, x, y + 2, radius * 1.4);
      else context.arc(x, y, radius, 0, 2 * Math.PI);
      context.fillStyle = fill;
      context.fill();
      if (!ring) return;
      context.strokeStyle = ring;
      context.lineWidth = 1.5;
      context.stroke();
    };
    context.globalAlpha = alpha;
    for (const path of paths) if (path.index !== selection.path && !beyond.has(path.index)) put(path.index, 2.4, color);
    context.globalAlpha = 1;
    for (const path of beyond) if (path !== selection.path) put(path, 3.2, axis.above.includes(path) ? colors.warning : color);
    if (selection.hovered >= 0 && selection.hovered !== selection.path) put(selection.hovered, 4.5, color, colors.text);
    if (selection.path >= 0) put(selection.path, 5, colors.selected, colors.halo);
    this.mean(context, quantity, frame, colors);
    this.tell(context, quantity, frame, colors);
  }

  triangle(context, x, y, size) {
    context.moveTo(x, y - size);
    context.lineTo(x + size, y + size * 0.8);
    context.lineTo(x - size, y + size * 0.8);
    context.closePath();
  }

  /** Where the pixel's value is: the mean of what is shown. */
  mean(context, quantity, frame, colors) {
    const { box } = frame, value = toNumber(quantity.mean), y = frame.toY(value);
    if (axisPosition(value, frame.y.range, frame.y.log) > 1) {
      context.font = "11px " + colors.sans;
      context.fillStyle = colors.muted;
      context.textAlign = "right";
      context.textBaseline = "middle";
      context.fillText("↑ mean " + formatNumber(value), box.left + box.width, box.top - 1);
      return;
    }
    context.strokeStyle = colors.muted;
    context.setLineDash([4, 4]);
    frame.line(context, box.left, y, box.left + box.width, y);
    context.setLineDash([]);
  }

  /** The value of the path that one looks at. */
  tell(context, quantity, frame, colors) {
    const { selection } = this, path = selection.hovered >= 0 ? selection.hovered : selection.path;
    if (path < 0 || quantity.values[path] === null) return;
    const number = toNumber(quantity.values[path]), text = formatNumber(number);
    context.font = "600 11.5px " + colors.sans;
    const width = context.measureText(text).width, { box } = frame;
    const x = frame.toX(this.data.paths[path].json.sample), right = x + 12 + width < box.left + box.width;
    const y = Math.max(Number.isNaN(number) ? box.top : frame.toY(number), box.top + 1);
    context.textBaseline = "middle";
    context.textAlign = right ? "left" : "right";
    context.lineWidth = 3;
    context.lineJoin = "round";
    context.strokeStyle = colors.panel;
    context.strokeText(text, x + (right ? 11 : -11), y);
    context.fillStyle = Number.isFinite(number) ? (path === selection.path ? colors.selected : colors.text) : colors.warning;
    context.fillText(text, x + (right ? 11 : -11), y);
  }
}

export class LuminancePlot extends Plot {
  paint(context, width, height, colors) {
    const box = { left: 46, top: 12, width: width - 56, height: height - 48 };
    this.scatter(context, this.data.analysis.luminance, colors.data, box, colors, true);
    sampleLabel(context, box, colors);
  }
}

export class RgbPlot extends Plot {
  paint(context, width, height, colors) {
    const each = (height - 34) / 3;
    ["red", "green", "blue"].forEach((name, i) => {
      const box = { left: 46, top: 12 + i * each, width: width - 56, height: each - 17 };
      this.scatter(context, this.data.analysis[name], colors[name], box, colors, i === 2);
      if (i === 2) sampleLabel(context, box, colors);
    });
  }
}

function sampleLabel(context, box, colors) {
  context.font = "11px " + colors.sans;
  context.fillStyle = colors.muted;
  context.textAlign = "center";
  context.textBaseline = "top";
  context.fillText("sample index", box.left + box.width / 2, box.top + box.height + 20);
}

export class DepthPlot extends Plot {
  paint(context, width, height, colors) {
    const { paths, analysis: { depths } } = this.data, { selection } = this;
    const most = Math.max(...depths.counts, 1);
    const box = { left: 34, top: 10, width: width - 44, height: height - 46 };
    this.frame = new Frame(depths, { range: [0, most * 1.06], ticks: depths.countTicks, log: false }, box);
    this.frame.draw(context, colors, true);
    const bin = (path) => Math.floor((path.json.depth - depths.range[0]) / depths.width);
    const chosen = selection.path >= 0 ? bin(paths[selection.path]) : -1, hovered = selection.hovered >= 0 ? bin(paths[selection.hovered]) : -1;
    depths.counts.forEach((count, i) => {
      const x0 = this.frame.toX(depths.range[0] + i * depths.width), x1 = this.frame.toX(depths.range[0] + (i + 1) * depths.width);
      const y = this.frame.toY(count), gap = Math.min((x1 - x0) * 0.12, 3);
      context.fillStyle = i === chosen ? colors.selected : colors.data;
      context.globalAlpha = i === chosen ? 1 : i === hovered ? 0.95 : 0.7;
      context.fillRect(x0 + gap, y, x1 - x0 - 2 * gap, box.top + box.height - y);
    });
    context.globalAlpha = 1;
    context.font = "11px " + colors.sans;
    context.fillStyle = colors.muted;
    context.textAlign = "center";
    context.textBaseline = "top";
    context.fillText("depth", box.left + box.width / 2, box.top + box.height + 20);
  }

  /** The brightest path of the bar. */
  pathAt(x, y) {
    const { depths, order } = this.data.analysis;
    if (!this.frame || y > this.frame.box.top + this.frame.box.height) return -1;
    const share = (x - this.frame.box.left) / this.frame.box.width;
    if (share < 0 || share >= 1) return -1;
    const bin = Math.floor((share * (depths.range[1] - depths.range[0])) / depths.width);
    const found = order.find((i) => Math.floor((this.data.paths[i].json.depth - depths.range[0]) / depths.width) === bin);
    return found === undefined ? -1 : found;
  }
}

// Where values lie on an axis, and its drawing. Ranges and ticks come with the data: analysis has made them.
import { toNumber } from "./format.js";

const kLabelHeight = 14;

/** 0 at the range's begin, 1 at its end, beyond outside; NaN for what is none, -Infinity for values <= 0 on a logarithmic one. */
export function axisPosition(value, [min, max], log) {
  if (!log) return (value - min) / (max - min);
  if (value <= 0) return -Infinity;
  return (Math.log(value) - Math.log(min)) / (Math.log(max) - Math.log(min));
}

/** The plot's inside and how values get there. */
export class Frame {
  /** @param x, y {range, ticks, log} @param box {left, top, width, height} */
  constructor(x, y, box) {
    this.x = { ...x, range: x.range.map(toNumber) };
    this.y = { ...y, range: y.range.map(toNumber) };
    this.box = box;
  }

  toX(value) {
    return this.box.left + this.box.width * axisPosition(value, this.x.range, this.x.log);
  }

  /** Values beyond lie on the edge. */
  toY(value) {
    const position = axisPosition(value, this.y.range, this.y.log);
    return this.box.top + this.box.height * (1 - Math.min(Math.max(position, 0), 1));
  }

  draw(context, colors, withLabelsBelow = true) {
    const { left, top, width, height } = this.box;
    context.font = "11px " + colors.sans;
    context.lineWidth = 1;
    context.strokeStyle = colors.grid;
    context.fillStyle = colors.muted;
    context.textBaseline = "middle";
    context.textAlign = "right";
    let last = Infinity;
    for (const [value, text] of this.y.ticks) {
      const y = Math.round(this.toY(toNumber(value))) + 0.5;
      if (text) this.line(context, left, y, left + width, y);
      if (!text || last - y < kLabelHeight) continue;  // where there is little room, not every tick is named
      context.fillText(text, left - 6, y);
      last = y;
    }
    context.textBaseline = "top";
    context.textAlign = "center";
    for (const [value, text] of this.x.ticks) {
      const x = Math.round(this.toX(toNumber(value))) + 0.5;
      if (text) this.line(context, x, top, x, top + height);
      if (text && withLabelsBelow) context.fillText(text, x, top + height + 5);
    }
    context.strokeStyle = colors.border;
    this.line(context, left, top + height + 0.5, left + width, top + height + 0.5);
  }

  line(context, x0, y0, x1, y1) {
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
  }
}

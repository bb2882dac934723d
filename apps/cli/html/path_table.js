// The table of paths: sorted, outliers marked, only the rows in sight are elements.
import { byId, element, numberElement, swatch } from "./elements.js";
import { formatValue, toNumber } from "./format.js";

const kRowHeight = 24;

/** What a column shows, and the number it sorts by. */
const kColumns = [
  { title: "", hint: "outliers", key: (p) => (p.outlier ? 1 : 0), cell: (p) => element("span", "", p.outlier ? "▲" : "") },
  { title: "sample", ascending: true, key: (p) => p.json.sample, cell: (p) => element("span", "", p.json.sample + (p.json.part ? "." + p.json.part : "")) },
  { title: "depth", key: (p) => p.json.depth, cell: (p) => element("span", "", formatValue(p.json.depth)) },
  { title: "luminance", key: (p) => brightness(p.luminance), cell: (p) => number(p.luminance) },
  ...["red", "green", "blue"].map((title, i) => ({ title, key: (p) => brightness(p.json.estimate && p.json.estimate[i]), cell: (p) => number(p.json.estimate && p.json.estimate[i]) })),
  { title: "", hint: "colour", fixed: true, cell: (p) => element("span", "", p.json.estimate ? swatch(p.json.estimate) : "–") },
];

/** NaN and infinity come first: they are what one looks for. */
function brightness(value) {
  if (value === null || value === undefined) return -Infinity;
  const n = toNumber(value);
  return Number.isFinite(n) ? n : Infinity;
}

function number(value) {
  return value === null || value === undefined ? element("span", "muted", "–") : numberElement(value);
}

export class PathTable {
  constructor(data, selection) {
    this.data = data;
    this.selection = selection;
    this.box = byId("table");
    this.onlyOutliers = byId("only-outliers");
    this.sortedBy = 3;
    this.reversed = false;
    this.head = this.makeHead();
    this.rows = element("div", "rows");
    this.rows.setAttribute("role", "rowgroup");
    this.box.append(this.head, this.rows);
    this.box.addEventListener("scroll", () => this.showRows());
    new ResizeObserver(() => this.showRows()).observe(this.box);
    this.onlyOutliers.disabled = !data.paths.some((p) => p.outlier);
    this.onlyOutliers.addEventListener("change", () => this.sort());
    this.rows.addEventListener("click", (event) => this.select(event));
    this.rows.addEventListener("pointerover", (event) => selection.hover(rowPath(event)));
    this.rows.addEventListener("pointerleave", () => selection.hover(-1));
    this.box.addEventListener("keydown", (event) => {
      const step = { ArrowUp: -1, ArrowDown: 1, PageUp: -12, PageDown: 12, Home: -1e9, End: 1e9 }[event.key];
      if (!step) return;
      event.preventDefault();
      selection.stepPath(step);
    });
    this.sort();
  }

  makeHead() {
    const head = element("div", "line-head");
    head.setAttribute("role", "row");
    kColumns.forEach((column, i) => {
      const cell = element("span", "");
      cell.setAttribute("role", "columnheader");
      const button = column.fixed ? column.title : element("button", "", column.title || "▲");
      cell.append(button);
      head.append(cell);
      if (column.fixed) return;
      button.tabIndex = -1;
      button.title = "Sort by " + (column.title || column.hint);
      button.addEventListener("click", () => {
        this.reversed = this.sortedBy === i && !this.reversed;
        this.sortedBy = i;
        this.sort();
      });
    });
    return head;
  }

  sort() {
    const { key, ascending } = kColumns[this.sortedBy], sign = (ascending ? 1 : -1) * (this.reversed ? -1 : 1);
    const paths = this.onlyOutliers.checked ? this.data.paths.filter((p) => p.outlier) : this.data.paths.slice();
    const compare = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
    paths.sort((a, b) => sign * compare(key(a), key(b)) || a.index - b.index);
    this.order = this.selection.order = paths.map((p) => p.index);
    this.head.querySelectorAll("button").forEach((button, i) => {
      if (i === this.sortedBy) button.dataset.sorted = "";
      else delete button.dataset.sorted;
      button.parentElement.setAttribute("aria-sort", i !== this.sortedBy ? "none" : sign > 0 ? "ascending" : "descending");
    });
    this.rows.style.height = this.order.length * kRowHeight + "px";
    this.box.setAttribute("aria-rowcount", this.order.length + 1);
    this.showRows(true);
  }

  select(event) {
    const path = rowPath(event);
    if (path >= 0) this.selection.select(path, this.selection.vertex < 0 ? -1 : 0);
  }

  selectionChanged() {
    const at = this.order.indexOf(this.selection.path);
    if (at >= 0 && this.shownPath !== this.selection.path) {
      const top = at * kRowHeight, visible = this.box.clientHeight - this.head.offsetHeight;
      if (top < this.box.scrollTop) this.box.scrollTop = top;
      else if (top + kRowHeight > this.box.scrollTop + visible) this.box.scrollTop = top + kRowHeight - visible;
    }
    this.shownPath = this.selection.path;
    this.showRows();
  }

  /** Makes the rows in sight, unless they are there. */
  showRows(anew = false) {
    const first = Math.max(Math.floor(this.box.scrollTop / kRowHeight) - 8, 0);
    const last = Math.min(first + Math.ceil(this.box.clientHeight / kRowHeight) + 16, this.order.length);
    const range = first + "-" + last;
    if (anew || range !== this.shownRange) {
      this.rows.replaceChildren(...this.order.slice(first, last).map((path, i) => this.makeRow(path, first + i)));
      this.shownRange = range;
    }
    for (const row of this.rows.children) row.setAttribute("aria-selected", Number(row.dataset.path) === this.selection.path);
    const chosen = this.rows.querySelector("[aria-selected=true]");
    if (chosen) this.box.setAttribute("aria-activedescendant", chosen.id);
    else this.box.removeAttribute("aria-activedescendant");
  }

  makeRow(path, at) {
    const row = element("div", "line-row", ...kColumns.map((column) => column.cell(this.data.paths[path])));
    for (const cell of row.children) cell.setAttribute("role", "gridcell");
    row.id = "path-" + path;
    row.dataset.path = path;
    row.setAttribute("role", "row");
    row.setAttribute("aria-rowindex", at + 2);
    row.style.top = at * kRowHeight + "px";
    row.title = this.data.paths[path].events;
    return row;
  }
}

function rowPath(event) {
  const row = event.target.closest("[data-path]");
  return row ? Number(row.dataset.path) : -1;
}

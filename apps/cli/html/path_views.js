// The selected path: its vertices, and every value that was recorded at one of them or for the path.
import { byId, element, numberElement, swatch } from "./elements.js";
import { formatValue, printable } from "./format.js";

const isNumber = (value) => typeof value === "number" || (typeof value === "string" && /^(NaN|-?Infinity)$/.test(value));

export function pathName(path) {
  return "Path " + path.json.sample + (path.json.part ? "." + path.json.part : "");
}

export function vertexName(vertex) {
  if (vertex.event) {
    const { type, lobe, label } = vertex.event;
    return [type + (lobe && lobe !== "none" ? " " + lobe : ""), label].filter(Boolean).join(" · ");
  }
  return vertex.envmap ? "environment" : "vertex";
}

/** One recorded value: numbers in columns, colours with their look. */
function valueElement(value, isColor) {
  const cell = element("td", "");
  if (value === null) cell.append(element("span", "muted", "–"));
  else if (isNumber(value)) cell.append(Number.isInteger(value) ? element("span", "one", formatValue(value)) : numberElement(value, "one"));
  else if (Array.isArray(value) && value.length <= 4 && value.every(isNumber)) {
    const numbers = element("span", "numbers");
    numbers.append(...value.map((v) => numberElement(v)));
    cell.append(numbers);
    if (isColor) cell.append(swatch(value));
  } else cell.append(element("span", "text", formatValue(value)));
  return cell;
}

class Rows {
  constructor(caption) {
    this.body = element("tbody", "");
    this.table = element("table", "data", this.body);
    if (caption) this.table.prepend(element("caption", "", caption));
  }

  add(key, value, isColor = false) {
    if (value !== undefined) this.body.append(element("tr", "", element("th", "", key), valueElement(value, isColor)));
    return this;
  }

  /** User data, with all values of keys that were recorded several times. */
  addData(owner) {
    const history = owner.history || {};
    for (const [key, value] of Object.entries(owner.data)) {
      const values = Object.hasOwn(history, key) ? history[key] : [value];
      values.forEach((v, i) => this.add(values.length > 1 ? key + " (" + (i + 1) + " of " + values.length + ")" : key, v, looksLikeColor(key)));
    }
    return this;
  }
}

const looksLikeColor = (key) => /weight|throughput|radiance|colou?r|emission|albedo|reflectance|estimate/i.test(key);

export class PathViews {
  constructor(data, selection) {
    this.data = data;
    this.selection = selection;
    this.list = byId("vertices");
    this.values = byId("values");
    byId("path-previous").addEventListener("click", () => selection.stepPath(-1));
    byId("path-next").addEventListener("click", () => selection.stepPath(1));
    byId("copy").addEventListener("click", () => this.copy());
    this.list.addEventListener("click", (event) => {
      const item = event.target.closest("[data-vertex]");
      if (item) selection.select(selection.path, Number(item.dataset.vertex));
    });
    this.list.addEventListener("keydown", (event) => {
      const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
      if (!step || selection.path < 0) return;
      event.preventDefault();
      if (step < 0 && selection.vertex <= 0) selection.select(selection.path, -1);
      else selection.stepVertex(step);
    });
  }

  chosen() {
    const path = this.data.paths[this.selection.path];
    if (!path) return null;
    return this.selection.vertex < 0 ? path.json : path.json.vertices[this.selection.vertex];
  }

  copy() {
    const chosen = this.chosen() || this.data.json.pixel, button = byId("copy");
    const told = (word) => {
      button.textContent = word;
      setTimeout(() => (button.textContent = "Copy JSON"), 1500);
    };
    if (!navigator.clipboard) told("No clipboard here");
    else navigator.clipboard.writeText(JSON.stringify(chosen, null, 2)).then(() => told("Copied"), () => told("Not allowed"));
  }

  selectionChanged() {
    const { path: index, vertex } = this.selection;
    if (index === this.shownPath && vertex === this.shownVertex) return;
    if (index !== this.shownPath) this.values.scrollTop = 0;
    this.shownPath = index;
    this.shownVertex = vertex;
    const path = this.data.paths[index];
    byId("path-title").textContent = path ? pathName(path) : "Path";
    byId("path-note").textContent = path ? "depth " + formatValue(path.json.depth) + (path.outlier ? ", outlier" : "") + (path.events ? " · " + printable(path.events) : "") : "";
    if (!path) {
      this.list.replaceChildren(element("p", "word muted", "Choose a path in the table, in a plot or in the scene."));
      this.values.replaceChildren(...this.pixelTables());
      byId("values-title").textContent = "Pixel";
      return;
    }
    this.showVertices(path, vertex);
    byId("values-title").textContent = vertex < 0 ? pathName(path) : "Vertex " + path.json.vertices[vertex].depth + " of " + pathName(path).toLowerCase();
    this.values.replaceChildren(...(vertex < 0 ? this.pathTables(path) : this.vertexTables(path.json, path.json.vertices[vertex])));
  }

  showVertices(path, vertex) {
    const whole = this.item(-1, "•", element("span", "what", element("b", "", "whole path")), path.json.estimate);
    const items = path.json.vertices.map((v, i) => {
      const place = v.surface ? this.data.meshName(v.surface.mesh) : "";
      const what = element("span", "what", element("b", "", vertexName(v)), " ", element("span", "muted", (v.subpath === "light" ? "light subpath " : "") + place));
      return this.item(i, String(v.depth), what, v.estimate);
    });
    this.list.replaceChildren(whole, ...items);
    for (const item of this.list.children) {
      const chosen = Number(item.dataset.vertex) === vertex;
      item.setAttribute("aria-selected", chosen);
      if (chosen) this.list.setAttribute("aria-activedescendant", item.id);
      if (chosen) this.reveal(item);
    }
  }

  /** Scrolls the list, not the page. */
  reveal(item) {
    const list = this.list.getBoundingClientRect(), place = item.getBoundingClientRect();
    if (place.top < list.top) this.list.scrollTop -= list.top - place.top;
    else if (place.bottom > list.bottom) this.list.scrollTop += place.bottom - list.bottom;
  }

  item(index, label, what, estimate) {
    const item = element("div", "item", element("span", "number", label), what);
    if (estimate) item.append(element("span", "estimate muted", ...estimate.map((v) => numberElement(v))), swatch(estimate));
    item.dataset.vertex = index;
    item.id = "vertex-" + index;
    item.setAttribute("role", "option");
    return item;
  }

  pixelTables() {
    const { pixel, analysis } = this.data.json;
    const rows = new Rows().add("replayed", pixel.replay.replayed, true).add("rendered", pixel.replay.rendered, true).add("estimates add up", pixel.replay.sums)
      .add("paths", analysis.paths).add("mean luminance", analysis.outliers.mean).add("standard deviation", analysis.outliers.deviation)
      .add("outliers", analysis.outliers.count).add("integrator", pixel.integrator).add("sampler", pixel.sampler).add("seed", pixel.seed);
    return [rows.table];
  }

  pathTables({ json, luminance }) {
    const rows = new Rows().add("estimate", json.estimate, true).add("luminance", luminance).add("depth", json.depth).add("origin", json.origin).addData(json);
    return [rows.table, ...this.contributionTables(json, () => true), ...this.splatTables(json)];
  }

  vertexTables(path, vertex) {
    const rows = new Rows().add("event", vertexName(vertex)).add("estimate so far", vertex.estimate, true).add("emission", vertex.emission, true)
      .add(vertex.envmap ? "environment at" : "position", vertex.envmap || vertex.position);
    if (vertex.surface) rows.add("surface", this.data.meshName(vertex.surface.mesh) + ", face " + vertex.surface.face);
    for (const event of vertex.nee) {
      rows.add("next event", event.position);
      rows.body.lastChild.lastChild.append(element("span", event.visible ? "visible" : "occluded", event.visible ? "visible" : "occluded"));
    }
    rows.addData(vertex);
    const here = (c) => c.depth === vertex.depth && (c.subpath || "camera") === (vertex.subpath || "camera");
    return [rows.table, ...this.contributionTables(path, here)];
  }

  contributionTables(path, wanted) {
    const found = path.contributions.filter(wanted);
    if (found.length === 0) return [];
    const rows = new Rows("Contributions");
    for (const c of found) {
      rows.add(c.depth + " · " + c.technique, c.value, true);
      if (c.misWeight !== null) rows.add("MIS weight", c.misWeight);
    }
    return [rows.table];
  }

  splatTables(path) {
    if (!path.splats) return [];
    const rows = new Rows("Splats");
    for (const splat of path.splats) rows.add("pixel " + formatValue(splat.pixel), splat.value, true);
    return [rows.table];
  }
}

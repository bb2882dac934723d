// Puts the page together: data, selection, views, keys.
import { byId, element, swatch } from "./elements.js";
import { formatNumber, formatValue, parseColor, printable, toNumber } from "./format.js";
import { readPageData } from "./page_data.js";
import { PathTable } from "./path_table.js";
import { PathViews } from "./path_views.js";
import { DepthPlot, LuminancePlot, RgbPlot } from "./plots.js";
import { SceneView } from "./scene_view.js";
import { Selection } from "./selection.js";

const kVerdicts = {
  exact: "Rendered and replayed have equal bits: these are the paths that made the pixel.",
  close: "Rendered and replayed differ by at most 1e-4.",
  different: "These paths did not make the pixel that was rendered.",
  unknown: "There was no render with these settings to compare with.",
};

function fact(name, value) {
  return element("div", "", element("dt", "", name), element("dd", "", value));
}

function fillHeader({ json }) {
  const { pixel } = json;
  byId("title").textContent = printable(json.title);
  const facts = [["pixel", json.title.includes(formatValue(pixel.pixel)) ? "" : formatValue(pixel.pixel)], ["spp", pixel.spp], ["seed", pixel.seed], ["integrator", pixel.integrator], ["sampler", pixel.sampler], ["renderer", json.renderer], ["where", json.query]];
  byId("facts").append(...facts.filter(([, value]) => value !== null && value !== "").map(([name, value]) => fact(name, String(value))));
  byId("pixel-color").append(swatch(pixel.replay.replayed), element("span", "", pixel.replay.replayed.map((v) => formatNumber(toNumber(v))).join("  ")));
  const verdict = byId("verdict");
  verdict.textContent = "replay " + pixel.replay.verdict;
  verdict.className = "badge " + pixel.replay.verdict;
  verdict.title = kVerdicts[pixel.replay.verdict];
  byId("about").textContent = "Made by " + printable(json.software) + ". Radiance in W/(sr m²), before division by samples per pixel.";
}

function fillNotes({ json, analysis, meshes }) {
  const { outliers } = analysis;
  const part = analysis.shown < analysis.paths ? "the " + analysis.shown + " brightest of " + analysis.paths : String(analysis.paths);
  byId("path-count").textContent = part + (outliers.count > 0 ? ", " + outliers.count + (outliers.count > 1 ? " outliers" : " outlier") : "");
  byId("plot-note").textContent = outliers.considered > 1 ? "mean " + formatNumber(toNumber(outliers.mean)) + ", σ " + formatNumber(toNumber(outliers.deviation)) : "";
  const { scene } = json;
  if (!scene) byId("scene-note").textContent = "Made without the scene's surfaces";
  else if (scene.shown < scene.triangles) byId("scene-note").textContent = "Surfaces are simplified: " + scene.shown + " of " + scene.triangles + " triangles";
}

/** "#path=3.0&vertex=2": what to begin with, so that a link can point at it. Else the brightest path. */
function firstSelection(data) {
  const wanted = new URLSearchParams(location.hash.slice(1)), [sample, part = "0"] = (wanted.get("path") || "").split(".");
  const found = data.paths.findIndex((p) => String(p.json.sample) === sample && String(p.json.part) === part);
  if (found < 0) return [data.paths.length > 0 ? data.analysis.order[0] : -1, 0];
  const depth = wanted.get("vertex");
  return [found, depth === null ? -1 : data.paths[found].json.vertices.findIndex((v) => String(v.depth) === depth)];
}

function listenToKeys(selection, scene, log) {
  const actions = {
    "[": () => selection.stepPath(-1), "]": () => selection.stepPath(1),
    ",": () => selection.stepVertex(-1), ".": () => selection.stepVertex(1),
    c: () => scene.goHome(), f: () => scene.focus(), l: () => log.click(), Escape: () => selection.select(-1),
  };
  document.addEventListener("keydown", (event) => {
    const action = actions[event.key] || actions[event.key.toLowerCase()];
    if (!action || event.ctrlKey || event.metaKey || event.altKey || (event.target.matches && event.target.matches("input[type=text], textarea"))) return;
    event.preventDefault();
    action();
  });
}

function start() {
  const data = readPageData(byId("emca-data").textContent);
  fillHeader(data);
  fillNotes(data);
  const selection = new Selection(data.paths, data.analysis.order);
  const table = new PathTable(data, selection), details = new PathViews(data, selection);
  const plots = [new LuminancePlot("plot-luminance", data, selection, "Luminance of each path over its sample index"),
    new RgbPlot("plot-rgb", data, selection, "Red, green and blue of each path over its sample index"),
    new DepthPlot("plot-depth", data, selection, "How many paths have each depth")];
  const scene = new SceneView(data, selection);
  const update = () => {
    scene.selectionChanged();
    table.selectionChanged();
    details.selectionChanged();
    for (const plot of plots) plot.draw();
  };
  selection.listen(update);
  byId("log").addEventListener("change", (event) => {
    for (const plot of plots) {
      plot.log = event.target.checked;
      plot.draw();
    }
  });
  matchMedia("(prefers-color-scheme: light)").addEventListener("change", () => {
    scene.themeChanged();
    update();
  });
  listenToKeys(selection, scene, byId("log"));
  const [path, vertex] = firstSelection(data);
  selection.select(path, vertex);
  update();
  // For the console and for tests.
  globalThis.emca = { data: data.json, selection, scene, formatNumber, parseColor };
}

start();

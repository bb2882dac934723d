// The 3D view: scene, paths, the selected one in front. Reads data and selection, draws when something changed.
import { byId, themeColor } from "./elements.js";
import { parseColor } from "./format.js";
import { pick } from "./picking.js";
import { SceneGl } from "./scene_gl.js";
import { listenToInput } from "./scene_input.js";
import { drawMarks } from "./scene_marks.js";
import { allPaths, frustum, hoveredPath, onePath, pointsInScene } from "./strokes.js";
import { boundingSphere, norm, subtract, transformed } from "./vector.js";
import { ViewCamera } from "./view_camera.js";

/** What navigation and "in the scene" mean: surfaces that are no lamps, else whatever the paths reach. */
function sceneBounds(data) {
  const points = [];
  for (const mesh of data.meshes) {
    if (Math.max(...mesh.emission) > 0) continue;
    for (let i = 0; i < mesh.positions.length; i += 3) points.push(mesh.positions.subarray(i, i + 3));
  }
  if (points.length === 0) for (const path of data.paths) points.push(...path.points.filter((p, i) => p && !path.json.vertices[i].envmap));
  return boundingSphere(points);
}

export class SceneView {
  constructor(data, selection) {
    this.data = data;
    this.selection = selection;
    this.canvas = byId("scene");
    this.marks = byId("scene-marks");
    this.bounds = sceneBounds(data);
    this.camera = new ViewCamera(data.camera, this.bounds, data.image);
    this.showPaths = byId("show-paths");
    this.showEvents = byId("show-events");
    this.opacity = byId("opacity");
    this.opacity.parentElement.hidden = data.meshes.length === 0;
    try {
      this.gl = new SceneGl(this.canvas, data.meshes);
    } catch (error) {
      this.fail(error.message);
      return;
    }
    this.themeChanged();
    this.listen();
  }

  /** A word in the place of the scene; everything else goes on. */
  fail(message) {
    this.gl = null;
    byId("scene-word").textContent = message;
    byId("scene-word").hidden = false;
    for (const hidden of [this.canvas, this.marks, ...document.querySelectorAll(".tools, .legend")]) hidden.hidden = true;
  }

  listen() {
    const redraw = () => this.request();
    listenToInput(this.canvas, this.camera, {
      changed: redraw,
      click: (at) => this.click(at),
      hover: (at) => this.hover(at),
    });
    // At once: a picture of the old size would be stretched.
    new ResizeObserver(() => this.gl && this.draw()).observe(this.canvas);
    this.opacity.addEventListener("input", redraw);
    for (const box of [this.showPaths, this.showEvents]) box.addEventListener("change", () => this.selectionChanged());
    byId("view-camera").addEventListener("click", () => this.goHome());
    byId("view-focus").addEventListener("click", () => this.focus());
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.fail("The browser took the graphics away from this page; load it again to see the scene.");
    });
  }

  goHome() {
    this.camera.goHome();
    this.request();
  }

  /** The whole selected path, else the whole scene. */
  focus() {
    const path = this.data.paths[this.selection.path];
    const points = path ? pointsInScene(path, this.bounds) : [];
    const sphere = points.length > 0 ? boundingSphere(points) : this.bounds;
    this.camera.show({ center: sphere.center, radius: Math.max(sphere.radius, this.bounds.radius * 0.02) });
    this.request();
  }

  themeChanged() {
    if (!this.gl) return;
    this.colors = {};
    for (const name of ["path", "light", "current", "visible", "occluded", "muted"]) this.colors[name] = parseColor(themeColor(name));
    this.gl.readColors();
    const aspect = this.data.image ? this.data.image[0] / this.data.image[1] : 4 / 3;
    this.gl.setStrokes("frustum", frustum(this.data.camera, aspect, this.bounds.radius * 0.06, this.colors));
    this.selectionChanged();
  }

  selectionChanged() {
    if (!this.gl) return;
    const { path, vertex, hovered } = this.selection, { paths } = this.data;
    const faint = path >= 0;
    if (this.builtFaint !== faint || this.builtColors !== this.colors) this.gl.setStrokes("all", allPaths(paths, this.colors, faint));
    this.builtFaint = faint;
    this.builtColors = this.colors;
    const events = this.showEvents.checked;
    this.gl.setStrokes("selected", paths[path] ? onePath(paths[path], vertex, this.colors, events) : []);
    this.gl.setStrokes("hovered", paths[hovered] && hovered !== path ? hoveredPath(paths[hovered], this.colors) : []);
    this.request();
  }

  request() {
    if (!this.gl || this.requested) return;
    this.requested = true;
    requestAnimationFrame((now) => {
      this.requested = false;
      if (!this.gl) return;
      const more = this.camera.step(now);
      this.draw();
      if (more) this.request();
    });
  }

  resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(Math.round(this.canvas.clientWidth * ratio), 1), height = Math.max(Math.round(this.canvas.clientHeight * ratio), 1);
    for (const canvas of [this.canvas, this.marks]) {
      if (canvas.width === width && canvas.height === height) continue;
      canvas.width = width;
      canvas.height = height;
    }
    return ratio;
  }

  draw() {
    const pixelRatio = this.resize(), { canvas, camera } = this;
    this.matrix = camera.matrix(canvas.width, canvas.height);
    const eye = camera.eye(), opacity = Number(this.opacity.value);
    const lines = [["selected", 1, 0.8], ["hovered", 1, 0.6]];
    if (this.showPaths.checked) lines.unshift(["all", 1, 0.55]);
    // From the renderer's own place its pyramid would be a frame without meaning.
    const away = this.data.camera ? norm(subtract(eye, this.data.camera.position)) : 0;
    if (away > this.bounds.radius * 0.15) lines.unshift(["frustum", 1, 0.5]);
    this.gl.draw({ matrix: this.matrix, eye, axis: camera.axis, mirrored: camera.mirrored, opacity, pixelRatio }, lines);
    const context = this.marks.getContext("2d");
    context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    const path = this.data.paths[this.selection.path];
    if (path) drawMarks(context, (p) => this.project(p), path, this.selection.vertex);
    if (!this.drawn) this.firstFrame = performance.now();
    this.drawn = true;
  }

  /** World to pixels of the style sheet; null behind the eye. */
  project(point) {
    const [x, y, z, w] = transformed(this.matrix, point);
    if (!(w > 0) || z < -w) return null;
    return [((x / w) * 0.5 + 0.5) * this.canvas.clientWidth, (0.5 - (y / w) * 0.5) * this.canvas.clientHeight];
  }

  pickAt(at) {
    return pick(at, this.data.paths, this.selection.path, this.showPaths.checked, (p) => this.project(p));
  }

  click(at) {
    if (!this.matrix) return;
    const found = this.pickAt(at);
    if (found.path >= 0) this.selection.select(found.path, found.vertex);
  }

  hover(at) {
    const found = at && this.matrix ? this.pickAt(at) : { path: -1 };
    this.canvas.style.cursor = found.path >= 0 ? "pointer" : "";
    this.selection.hover(found.path);
  }
}

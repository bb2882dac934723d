// Draws meshes and strokes with WebGL 2. Knows nothing of paths or selection.
import { kGroundShader, kMeshShader, kStrokeShader, deleteArray, makeArray, makeProgram } from "./gl_programs.js";
import { parseColor, toSrgb } from "./format.js";
import { themeColor } from "./elements.js";
import { shadedCorners } from "./mesh_normals.js";

const kStrokeLayout = [[0, 3], [1, 3], [2, 4], [3, 3]];

/** Clay that has taken some of the surface's colour. */
function clay(diffuse) {
  const own = diffuse.map((c) => Math.pow(toSrgb(c) / 255, 0.75)), neutral = parseColor(themeColor("mesh"));
  return own.map((c, i) => 0.62 * c + 0.38 * neutral[i]);
}

/** The hue of a light at full brightness. */
function glow(emission) {
  const most = Math.max(...emission);
  return emission.map((c) => (most > 0 && Number.isFinite(c) ? 0.55 + 0.45 * (toSrgb(c / most) / 255) : 1)).map((c, i) => c * [1, 0.97, 0.86][i]);
}

export class SceneGl {
  /** Throws where there is no WebGL 2. */
  constructor(canvas, meshes) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "low-power" });
    if (!gl) throw new Error("This browser has no WebGL 2, so that the scene cannot be drawn; plots and values are complete.");
    this.gl = gl;
    this.canvas = canvas;
    this.ground = makeProgram(gl, kGroundShader);
    this.surface = makeProgram(gl, kMeshShader);
    this.stroke = makeProgram(gl, kStrokeShader);
    this.empty = gl.createVertexArray();
    this.meshes = meshes.filter((m) => m.indices.length > 0).map((mesh) => ({
      mesh, lamp: Math.max(...mesh.emission) > 0,
      array: makeArray(gl, shadedCorners(mesh.positions, mesh.indices), [[0, 3], [1, 3]], false),
    }));
    this.strokes = new Map();
    this.readColors();
  }

  readColors() {
    for (const name of ["scene-top", "scene-bottom", "halo", "mesh-back"]) this[name] = parseColor(themeColor(name));
    for (const item of this.meshes) item.color = item.lamp ? glow(item.mesh.emission) : clay(item.mesh.diffuse);
  }

  /** Replaces the lines of one name; thirteen floats each (strokes.js). */
  setStrokes(name, floats) {
    deleteArray(this.gl, this.strokes.get(name));
    this.strokes.set(name, floats.length > 0 ? makeArray(this.gl, floats, kStrokeLayout, true) : null);
  }

  /**
   * @param view {matrix, eye, axis, mirrored, opacity, pixelRatio}
   * @param lines [name, strength where seen, strength behind surfaces] in the order of drawing
   */
  draw(view, lines) {
    const gl = this.gl, { width, height } = this.canvas;
    gl.viewport(0, 0, width, height);
    gl.clear(gl.DEPTH_BUFFER_BIT | gl.COLOR_BUFFER_BIT);
    gl.disable(gl.BLEND);
    gl.disable(gl.DEPTH_TEST);
    this.use(this.ground);
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    if (view.opacity > 0) this.drawMeshes(view);
    this.drawStrokes(view, lines);
  }

  use({ program, uniforms }) {
    const gl = this.gl;
    gl.useProgram(program);
    if (!uniforms.uTop) return uniforms;
    gl.uniform3fv(uniforms.uTop, this["scene-top"]);
    gl.uniform3fv(uniforms.uBottom, this["scene-bottom"]);
    gl.uniform2f(uniforms.uViewport, this.canvas.width, this.canvas.height);
    return uniforms;
  }

  /** Surfaces hide each other; seen from behind they are a veil, so that one looks into a room from outside. */
  drawMeshes(view) {
    const gl = this.gl, u = this.use(this.surface);
    gl.uniformMatrix4fv(u.uMatrix, false, view.matrix);
    gl.uniform3fv(u.uEye, view.eye);
    gl.uniform3fv(u.uAxis, view.axis);
    gl.uniform3fv(u.uBack, this["mesh-back"]);
    gl.uniform1f(u.uOpacity, view.opacity);
    gl.uniform1f(u.uVeil, 0.16 * view.opacity);
    gl.frontFace(view.mirrored ? gl.CW : gl.CCW);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 2);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    for (const behind of [false, true]) {
      gl.cullFace(behind ? gl.FRONT : gl.BACK);
      gl.depthMask(!behind);
      if (behind) gl.enable(gl.BLEND);
      gl.uniform1i(u.uBackFaces, behind ? 1 : 0);
      for (const { array, color, lamp } of this.meshes) {
        gl.uniform3fv(u.uColor, color);
        gl.uniform1i(u.uLamp, lamp ? 1 : 0);
        gl.bindVertexArray(array.array);
        gl.drawArrays(gl.TRIANGLES, 0, array.count);
      }
    }
    gl.disable(gl.CULL_FACE);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }

  drawStrokes(view, lines) {
    const gl = this.gl, u = this.use(this.stroke);
    gl.uniformMatrix4fv(u.uMatrix, false, view.matrix);
    gl.uniform2f(u.uSize, this.canvas.width, this.canvas.height);
    gl.uniform1f(u.uScale, view.pixelRatio);
    gl.uniform3fv(u.uHalo, this.halo);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    for (const [name, seen, behind] of lines) {
      const array = this.strokes.get(name);
      if (!array) continue;
      gl.bindVertexArray(array.array);
      for (const [compare, strength] of [[gl.GREATER, behind], [gl.LEQUAL, seen]]) {
        gl.depthFunc(compare);
        gl.uniform1f(u.uStrength, strength);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, array.count);
      }
    }
    gl.depthMask(true);
  }
}

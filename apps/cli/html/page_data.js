// What the page holds (docs/html-export.md), ready to be drawn.
import { toNumber } from "./format.js";

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Numbers are little-endian, as are all machines that browsers run on. */
function decodeMesh(mesh) {
  const quantised = new Uint16Array(bytesOf(mesh.positions).buffer);
  const bytes = bytesOf(mesh.indices).buffer;
  const positions = new Float32Array(quantised.length);
  for (let i = 0; i < positions.length; ++i) positions[i] = toNumber(mesh.min[i % 3]) + toNumber(mesh.extent[i % 3]) * (quantised[i] / 65535);
  return {
    name: mesh.name, material: mesh.material, diffuse: mesh.diffuse.map(toNumber), emission: mesh.emission.map(toNumber),
    positions, indices: mesh.vertices > 65536 ? new Uint32Array(bytes) : new Uint16Array(bytes),
  };
}

function finitePoint(point) {
  const numbers = point ? point.map(toNumber) : null;
  return numbers && numbers.every(Number.isFinite) ? numbers : null;
}

function readPath(json, index, analysis, outliers) {
  return {
    index, json,
    origin: finitePoint(json.origin),
    /** Of each vertex: where it is drawn, or null. */
    points: json.vertices.map((v) => finitePoint(v.envmap || v.position)),
    segments: analysis.segments[index],
    events: analysis.events[index],
    luminance: analysis.luminance.values[index],
    outlier: outliers.has(index),
  };
}

export function readPageData(text) {
  const json = JSON.parse(text);
  const outliers = new Set(json.analysis.outliers.paths);
  return {
    json, analysis: json.analysis,
    camera: json.camera, image: json.image,
    paths: json.pixel.paths.map((path, i) => readPath(path, i, json.analysis, outliers)),
    meshes: json.scene ? json.scene.meshes.map(decodeMesh) : [],
    meshName: (mesh) => (json.meshNames[mesh] ? json.meshNames[mesh] : "mesh " + mesh),
  };
}

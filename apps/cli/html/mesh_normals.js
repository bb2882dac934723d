// Normals for shading: smooth where faces meet at small angles, sharp at creases.

const kCrease = Math.cos((38 * Math.PI) / 180);

/** Of each triangle, with its area as length. */
function faceNormals(positions, indices) {
  const normals = new Float32Array(indices.length);
  for (let t = 0; t < indices.length; t += 3) {
    const a = 3 * indices[t], b = 3 * indices[t + 1], c = 3 * indices[t + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1], uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
    normals[t] = uy * vz - uz * vy;
    normals[t + 1] = uz * vx - ux * vz;
    normals[t + 2] = ux * vy - uy * vx;
  }
  return normals;
}

/** Vertices at the same place count as one: many meshes do not share them. */
function places(positions) {
  const known = new Map(), place = new Uint32Array(positions.length / 3);
  for (let i = 0; i < place.length; ++i) {
    const key = positions[3 * i] + "," + positions[3 * i + 1] + "," + positions[3 * i + 2];
    if (!known.has(key)) known.set(key, known.size);
    place[i] = known.get(key);
  }
  return { place, count: known.size };
}

/** Corners of faces by place, as a list behind each place's first entry. */
function cornersByPlace(indices, place, count) {
  const first = new Uint32Array(count + 1);
  for (const v of indices) ++first[place[v] + 1];
  for (let i = 0; i < count; ++i) first[i + 1] += first[i];
  const next = first.slice(), corners = new Uint32Array(indices.length);
  for (let i = 0; i < indices.length; ++i) corners[next[place[indices[i]]]++] = i;
  return { first, corners };
}

/** Position and normal of each corner of each triangle: six floats each, three corners a triangle. */
export function shadedCorners(positions, indices) {
  const faces = faceNormals(positions, indices);
  const { place, count } = places(positions);
  const { first, corners } = cornersByPlace(indices, place, count);
  const out = new Float32Array(6 * indices.length);
  for (let corner = 0; corner < indices.length; ++corner) {
    const face = corner - (corner % 3), v = indices[corner];
    const nx = faces[face], ny = faces[face + 1], nz = faces[face + 2], length = Math.hypot(nx, ny, nz);
    let x = 0, y = 0, z = 0;
    for (let i = first[place[v]]; i < first[place[v] + 1]; ++i) {
      const other = corners[i] - (corners[i] % 3);
      const ox = faces[other], oy = faces[other + 1], oz = faces[other + 2];
      if (nx * ox + ny * oy + nz * oz < kCrease * length * Math.hypot(ox, oy, oz)) continue;
      x += ox;
      y += oy;
      z += oz;
    }
    const size = Math.hypot(x, y, z) || 1;
    out.set([positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], x / size, y / size, z / size], 6 * corner);
  }
  return out;
}

// Vectors are arrays of three numbers; matrices are sixteen numbers, column by column, as WebGL wants them.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const norm = (a) => Math.hypot(a[0], a[1], a[2]);
export const mix = (a, b, t) => add(scale(a, 1 - t), scale(b, t));

export function normalized(a, fallback = [0, 0, 1]) {
  const length = norm(a);
  return length > 0 && Number.isFinite(length) ? scale(a, 1 / length) : fallback;
}

/** `a` turned about a unit axis (Rodrigues). */
export function rotated(a, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(scale(a, c), scale(cross(axis, a), s)), scale(axis, dot(axis, a) * (1 - c)));
}

/** The point in homogeneous coordinates. */
export function transformed(m, p) {
  const out = [0, 0, 0, 0];
  for (let i = 0; i < 4; ++i) out[i] = m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i];
  return out;
}

/** Smallest box of points, as centre and radius. */
export function boundingSphere(points) {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  for (const p of points)
    for (let i = 0; i < 3; ++i) {
      min[i] = Math.min(min[i], p[i]);
      max[i] = Math.max(max[i], p[i]);
    }
  if (!(min[0] <= max[0])) return { center: [0, 0, 0], radius: 1 };
  return { center: mix(min, max, 0.5), radius: Math.max(norm(subtract(max, min)) / 2, 1e-6) };
}

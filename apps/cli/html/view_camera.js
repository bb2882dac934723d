// The eye of the 3D view: looks at a target from a distance, turns about it, moves and eases.
import { add, cross, dot, mix, normalized, norm, rotated, scale, subtract } from "./vector.js";

const kEaseMilliseconds = 330;

export class ViewCamera {
  /** @param home the renderer's camera, or null; @param bounds of the scene: {center, radius}; @param image [width, height] or null */
  constructor(home, bounds, image) {
    this.bounds = bounds;
    this.aspect = image && image[1] > 0 ? image[0] / image[1] : 4 / 3;
    this.mirrored = home ? !home.rightHanded : false;
    this.fieldOfView = home && home.kind === "perspective" ? Math.min(Math.max(home.verticalFieldOfView, 5), 120) : 50;
    this.home = this.homePose(home);
    this.pose = this.home;
    // Turning keeps the horizon: about the axis of the world that is nearest to the camera's up.
    this.axis = [0, 1, 2].map((i) => (Math.abs(this.home.up[i]) === Math.max(...this.home.up.map(Math.abs)) ? Math.sign(this.home.up[i]) : 0));
    if (norm(this.axis) !== 1) this.axis = this.home.up;
    this.easing = null;
  }

  homePose(home) {
    const { center, radius } = this.bounds;
    if (!home) return { target: center, distance: 2.6 * radius, back: normalized([0.5, 0.45, 1]), up: [0, 1, 0] };
    const direction = normalized(home.direction);
    // Turns about what it looks at: the depth of the scene's middle along its axis.
    const distance = Math.max(dot(subtract(center, home.position), direction), radius * 0.05);
    return { target: add(home.position, scale(direction, distance)), distance, back: scale(direction, -1), up: normalized(home.up, [0, 1, 0]) };
  }

  /** Where a turn goes around, without moving the eye. */
  setPivotDepth(point) {
    const depth = dot(subtract(this.eye(), point), this.pose.back);
    if (!(depth > this.bounds.radius * 1e-3)) return;
    this.pose = { ...this.pose, target: subtract(this.eye(), scale(this.pose.back, depth)), distance: depth };
  }

  eye() {
    return add(this.pose.target, scale(this.pose.back, this.pose.distance));
  }

  right() {
    return normalized(cross(this.pose.up, this.pose.back), [1, 0, 0]);
  }

  /** Angles in radians; positive ones turn the scene to the right and downwards. */
  turn(yaw, pitch) {
    const sign = this.mirrored ? -1 : 1;
    let { back, up } = this.pose;
    back = rotated(back, this.axis, -yaw * sign);
    up = rotated(up, this.axis, -yaw * sign);
    const right = normalized(cross(up, back), [1, 0, 0]);
    const next = rotated(back, right, -pitch);
    if (Math.abs(dot(next, this.axis)) < 0.998 || Math.abs(dot(next, this.axis)) < Math.abs(dot(back, this.axis))) {
      back = next;
      up = rotated(up, right, -pitch);
    }
    this.set({ ...this.pose, back: normalized(back), up: normalized(up) });
  }

  /** In pixels of a view of this height. */
  pan(x, y, height) {
    const perPixel = (2 * this.pose.distance * Math.tan((this.fieldOfView * Math.PI) / 360)) / height;
    const move = add(scale(this.right(), -x * perPixel * (this.mirrored ? -1 : 1)), scale(this.pose.up, y * perPixel));
    this.set({ ...this.pose, target: add(this.pose.target, move) });
  }

  dolly(factor) {
    const distance = Math.min(Math.max(this.pose.distance * factor, this.bounds.radius * 1e-4), this.bounds.radius * 100);
    this.set({ ...this.pose, distance });
  }

  set(pose) {
    this.easing = null;
    this.pose = pose;
  }

  goHome() {
    this.easeTo(this.home);
  }

  /** Brings points into view without turning. */
  show(points) {
    const { center, radius } = points;
    const half = (Math.min(this.fieldOfView, this.fieldOfView * this.viewAspect()) * Math.PI) / 360;
    this.easeTo({ ...this.pose, target: center, distance: (1.15 * radius) / Math.sin(half) });
  }

  viewAspect() {
    return this.lastAspect || 1;
  }

  easeTo(pose) {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.easing = still ? null : { from: this.pose, to: pose, start: performance.now() };
    if (still) this.pose = pose;
  }

  /** Goes on with a move. True while there is more to come. */
  step(now) {
    if (!this.easing) return false;
    const { from, to, start } = this.easing;
    const t = Math.min(Math.max((now - start) / kEaseMilliseconds, 0), 1), s = t * t * (3 - 2 * t);
    const back = normalized(mix(from.back, to.back, s), to.back);
    const up = normalized(mix(from.up, to.up, s), to.up);
    const distance = Math.exp(Math.log(from.distance) * (1 - s) + Math.log(to.distance) * s);
    this.pose = { target: mix(from.target, to.target, s), distance, back, up: normalized(subtract(up, scale(back, dot(up, back))), to.up) };
    if (t < 1) return true;
    this.set(to);
    return false;
  }

  /** World to clip space; the whole image of the renderer fits into the view. */
  matrix(width, height) {
    this.lastAspect = width / height;
    const eye = this.eye(), right = this.right(), back = this.pose.back;
    const up = normalized(cross(back, right), this.pose.up);
    const tan = Math.tan((this.fieldOfView * Math.PI) / 360) * Math.max(1, this.aspect / this.lastAspect);
    const reach = norm(subtract(eye, this.bounds.center)) + this.bounds.radius;
    const far = reach * 4, near = Math.max(this.pose.distance * 0.02, far * 1e-5);
    const sx = (this.mirrored ? -1 : 1) / (tan * this.lastAspect), sy = 1 / tan;
    const a = (far + near) / (near - far), b = (2 * far * near) / (near - far);
    const rows = [scale(right, sx), scale(up, sy), scale(back, a), scale(back, -1)];
    const shift = [-dot(right, eye) * sx, -dot(up, eye) * sy, -dot(back, eye) * a + b, dot(back, eye)];
    const m = new Float32Array(16);
    for (let row = 0; row < 4; ++row) {
      for (let column = 0; column < 3; ++column) m[4 * column + row] = rows[row][column];
      m[12 + row] = shift[row];
    }
    return m;
  }
}

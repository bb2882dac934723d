// What a person looks at: the one model that all views read. Paths and vertices are positions in the data, -1 for none.

export class Selection {
  constructor(paths, order) {
    this.paths = paths;
    this.order = order;
    this.path = -1;
    this.vertex = -1;
    this.hovered = -1;
    this.listeners = [];
  }

  listen(listener) {
    this.listeners.push(listener);
  }

  select(path, vertex = -1) {
    const known = path >= 0 && path < this.paths.length;
    const last = known ? this.paths[path].json.vertices.length - 1 : -1;
    this.change(known ? path : -1, known ? Math.min(vertex, last) : -1, this.hovered);
  }

  hover(path) {
    this.change(this.path, this.vertex, path);
  }

  /** The next path in the order of the table. */
  stepPath(step) {
    const at = this.order.indexOf(this.path);
    const next = at < 0 ? 0 : Math.min(Math.max(at + step, 0), this.order.length - 1);
    if (this.order.length > 0) this.select(this.order[next], this.vertex < 0 ? -1 : 0);
  }

  stepVertex(step) {
    if (this.path < 0) return;
    const count = this.paths[this.path].json.vertices.length;
    this.select(this.path, Math.min(Math.max(this.vertex + step, 0), count - 1));
  }

  change(path, vertex, hovered) {
    if (path === this.path && vertex === this.vertex && hovered === this.hovered) return;
    Object.assign(this, { path, vertex, hovered });
    for (const listener of this.listeners) listener();
  }
}

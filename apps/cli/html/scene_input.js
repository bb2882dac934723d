// Mouse, touch and keys of the 3D view.

const kTurn = 0.0075, kKeyTurn = 0.09;

/**
 * Left button or one finger turns, right or middle button (or Shift) and two fingers move, wheel and pinch come closer.
 * @param camera a ViewCamera
 * @param on {changed(), click([x, y]), hover([x, y] or null)}
 */
export function listenToInput(canvas, camera, on) {
  const pointers = new Map();
  let moved = 0, pinch = 0;
  const at = (event) => [event.offsetX, event.offsetY];

  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at(event));
    if (pointers.size === 1) moved = 0;
    pinch = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId), here = at(event);
    if (!last) {
      if (event.pointerType === "mouse") on.hover(here);
      return;
    }
    const dx = here[0] - last[0], dy = here[1] - last[1];
    moved += Math.abs(dx) + Math.abs(dy);
    pointers.set(event.pointerId, here);
    if (pointers.size > 1) {
      const [a, b] = [...pointers.values()], span = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (pinch > 0 && span > 0) camera.dolly(pinch / span);
      pinch = span;
      camera.pan(dx / 2, dy / 2, canvas.clientHeight);
    } else if (moved > 3) {
      if (event.buttons & 6 || event.shiftKey) camera.pan(dx, dy, canvas.clientHeight);
      else camera.turn(dx * kTurn, dy * kTurn);
    }
    on.changed();
  });
  const release = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    pinch = 0;
    if (event.type === "pointerup" && pointers.size === 0 && moved <= 3 && event.button === 0) on.click(at(event));
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointerleave", () => on.hover(null));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? event.deltaY * 33 : event.deltaY;
    camera.dolly(Math.exp(Math.min(Math.max(lines, -300), 300) * 0.0016));
    on.changed();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (step && event.shiftKey) camera.pan(step[0] * 30, step[1] * 30, canvas.clientHeight);
    else if (step) camera.turn(step[0] * kKeyTurn, step[1] * kKeyTurn);
    else if (event.key === "+" || event.key === "=") camera.dolly(0.88);
    else if (event.key === "-") camera.dolly(1.136);
    else return;
    event.preventDefault();
    on.changed();
  });
}

// SPDX-License-Identifier: MIT
// Drag, wheel, pinch and keys on a flat map. Mouse and fingers are both pointers: one moves the
// map, two also spread it.
import { type FlatView } from "./flat";

export class FlatGestures {
  on = false;
  private readonly pointers = new Map<number, { x: number; y: number }>();

  constructor(private readonly canvas: HTMLCanvasElement, private readonly flat: FlatView,
              private readonly onChange: () => void) {
    canvas.addEventListener("pointerdown", (e) => {
      if (!this.on) return;
      this.pointers.set(e.pointerId, this.at(e));
      canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener("pointermove", (e) => this.move(e));
    for (const end of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(end, (e) => this.pointers.delete(e.pointerId));
    }
    canvas.addEventListener("wheel", (e) => {
      if (!this.on) return;
      e.preventDefault();
      const { x, y } = this.at(e);
      this.act(() => flat.zoomAt(Math.exp(-e.deltaY * 0.0016), x, y));
    }, { passive: false });
    canvas.addEventListener("dblclick", () => { if (this.on) this.act(() => flat.reset()); });
  }

  /** Arrows, plus, minus and 0 on the focused picture. */
  key(key: string): boolean {
    const step = 0.12;
    const moves: Record<string, () => void> = {
      ArrowLeft: () => this.flat.pan(step, 0), ArrowRight: () => this.flat.pan(-step, 0),
      ArrowUp: () => this.flat.pan(0, -step), ArrowDown: () => this.flat.pan(0, step),
      "+": () => this.flat.zoomAt(1.25, 0, 0), "=": () => this.flat.zoomAt(1.25, 0, 0),
      "-": () => this.flat.zoomAt(0.8, 0, 0), "0": () => this.flat.reset(),
    };
    const act = moves[key];
    if (!this.on || !act) return false;
    this.act(act);
    return true;
  }

  private move(e: PointerEvent): void {
    const last = this.pointers.get(e.pointerId);
    if (!this.on || !last) return;
    const now = this.at(e), others = [...this.pointers.entries()].filter(([id]) => id !== e.pointerId);
    this.pointers.set(e.pointerId, now);
    const other = others[0]?.[1];
    this.act(() => {
      if (!other) { this.flat.pan(now.x - last.x, now.y - last.y); return; }
      const spread = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y) || 1e-3;
      this.flat.zoomAt(spread(now) / spread(last), other.x, other.y);
    });
  }

  private act(what: () => void): void {
    what();
    this.onChange();
  }

  private at(e: MouseEvent): { x: number; y: number } {
    const box = this.canvas.getBoundingClientRect();
    return { x: ((e.clientX - box.left) / box.width) * 2 - 1, y: 1 - ((e.clientY - box.top) / box.height) * 2 };
  }
}

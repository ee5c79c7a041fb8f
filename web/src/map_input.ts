// Input on the map: one pointer drags, two pinch; the wheel zooms with Ctrl or when the map has the
// focus; everything also works from the keyboard.
import { byId } from "./dom";
import type { Live } from "./live";
import type { GridShape } from "./record";
import type { Viewport } from "./viewport";

export interface MapHands {
  grid: GridShape;
  view: Viewport;
  live(): Live | null;
  heading_rad(): number;
  turnBy(steps: number): void;
  cross: [number, number] | null;
  /** The cross, or what is held, has moved. */
  pointed(): void;
  /** The map shows another part of the world. */
  moved(): void;
  /** A click, with no live tool to take it. */
  picked(): void;
}

export class MapInput {
  private readonly map = byId("map");
  private readonly pointers = new Map<number, [number, number]>();
  private pressed: [number, number] | null = null;
  private beside = 0;  // where the map begins that a pointer is on

  constructor(private readonly hands: MapHands) {
    const { map } = this;
    map.addEventListener("pointerdown", (event) => this.press(event));
    map.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const) map.addEventListener(end, (event) => this.release(event));
    map.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    map.addEventListener("keydown", (event) => {
      if (event.target === map && this.key(event)) event.preventDefault();
    });
    byId("zoom-in").addEventListener("click", () => this.zoom(1.6));
    byId("zoom-out").addEventListener("click", () => this.zoom(1 / 1.6));
    byId("zoom-fit").addEventListener("click", () => { hands.view.fit(); hands.moved(); });
  }

  /** On a touch screen the page scrolls under a map that has nothing to pan. */
  showTouchAction(): void { this.map.style.touchAction = this.hands.view.zoomedIn || this.hands.live() ? "none" : "pan-y"; }

  /** On the map, or on the one of two side by side that it lies on; while something is held, on that where it was pressed. */
  private place(event: MouseEvent): [number, number] {
    const box = this.map.getBoundingClientRect();
    const px = event.clientX - box.left - this.map.clientLeft;
    if (this.pointers.size === 0) this.beside = this.map.classList.contains("split") && px > this.hands.view.width ? this.hands.view.width : 0;
    return [px - this.beside, event.clientY - box.top - this.map.clientTop];
  }

  private press(event: PointerEvent): void {
    if ((event.target as HTMLElement).closest(".zoom")) return;
    const { hands } = this;
    const at = this.place(event);
    this.pointers.set(event.pointerId, at);
    hands.cross = hands.view.toWorld(...at);
    this.pressed = this.pointers.size === 1 && !hands.live() ? at : null;
    if (this.pointers.size === 1 && hands.live()?.takes(hands.cross, hands.view)) {
      this.map.setPointerCapture(event.pointerId);
    } else if (hands.view.zoomedIn) {
      this.map.setPointerCapture(event.pointerId);
      this.map.classList.add("pans");
    }
    hands.pointed();
  }

  private move(event: PointerEvent): void {
    const { hands, pointers } = this;
    const [px, py] = this.place(event);
    const before = pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType !== "mouse") return;
      hands.cross = hands.view.toWorld(px, py);
      hands.pointed();
      return;
    }
    if (hands.live()?.drags(hands.view.toWorld(px, py), hands.view)) {
      hands.pointed();
      return;
    }
    const other = [...pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const apart = (p: [number, number]) => Math.max(1, Math.hypot(p[0] - other[0], p[1] - other[1]));
      hands.view.zoomAt((px + other[0]) / 2, (py + other[1]) / 2, apart([px, py]) / apart(before));
    } else {
      hands.view.pan(px - before[0], py - before[1]);
    }
    pointers.set(event.pointerId, [px, py]);
    hands.moved();
  }

  private release(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    this.map.classList.remove("pans");
    const { pressed } = this;
    this.pressed = null;
    const [px, py] = this.place(event);
    if (event.type === "pointerup" && pressed && Math.hypot(px - pressed[0], py - pressed[1]) < 4) this.hands.picked();
    this.hands.live()?.releases();
  }

  private wheel(event: WheelEvent): void {
    if (!event.ctrlKey && !event.metaKey && document.activeElement !== this.map) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE;
    this.hands.view.zoomAt(...this.place(event), Math.exp(-event.deltaY * (lines ? 0.05 : 0.0016)));
    this.hands.moved();
  }

  private zoom(factor: number, about: [number, number] | null = null): void {
    const { view } = this.hands;
    view.zoomAt(...(about ? view.toScreen(...about) : [view.width / 2, view.height / 2] as [number, number]), factor);
    this.hands.moved();
  }

  /** True when the key means something here. */
  private key(event: KeyboardEvent): boolean {
    const { hands } = this;
    const step = (event.shiftKey ? 10 : 1) * Math.max(hands.grid.cell_m, 3 / hands.view.scale);
    const keys: Record<string, () => void> = {
      ArrowLeft: () => this.moveCross(-step, 0), ArrowRight: () => this.moveCross(step, 0),
      ArrowUp: () => this.moveCross(0, step), ArrowDown: () => this.moveCross(0, -step),
      "+": () => this.zoom(1.4, hands.cross), "=": () => this.zoom(1.4, hands.cross), "-": () => this.zoom(1 / 1.4, hands.cross),
      0: () => { hands.view.fit(); hands.moved(); },
      "[": () => hands.turnBy(-1), "]": () => hands.turnBy(1),
    };
    const live = hands.live();
    if (hands.cross) keys.Enter = () => live ? live.flyFrom(hands.cross!, hands.heading_rad()) : hands.picked();
    keys[event.key]?.();
    return event.key in keys;
  }

  private moveCross(dx: number, dy: number): void {
    const { hands } = this;
    const { nx, ny, x0_m, y0_m, cell_m } = hands.grid;
    const from = hands.cross ?? hands.view.toWorld(hands.view.width / 2, hands.view.height / 2);
    const within = (value: number, origin: number, cells: number) =>
      Math.min(Math.max(value, origin + 1e-6 * cells * cell_m), origin + (1 - 1e-6) * cells * cell_m);
    hands.cross = [within(from[0] + dx, x0_m, nx), within(from[1] + dy, y0_m, ny)];
    hands.view.show(...hands.cross);
    hands.moved();
  }
}

import type { PageRecord } from "./record";
import type { Viewport } from "./viewport";
export interface Live { draw(c: CanvasRenderingContext2D, v: Viewport): void; takes(p: [number, number]): boolean; drags(p: [number, number]): boolean; releases(): void; flyFrom(p: [number, number], h: number): void }
export async function connect(_r: PageRecord, _p: { redraw(): void; heading(): number; turnTo(rad: number): void }): Promise<Live | null> { return null; }

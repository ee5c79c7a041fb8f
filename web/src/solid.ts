import type { VerdictLayers, Tiles } from "./layers";
import type { PageRecord } from "./record";
export function showSolid(_r: PageRecord, _v: VerdictLayers, _t: Tiles, _h: () => number): (heading: number) => void { return () => {}; }

// The map's size, and where the flights table goes.
import { byId, isPrinting } from "./dom";

export const wide_window = "(min-width: 62.01rem)";  // as in style.css
const panel_px = 304;  // least width of the panel next to the map, with the gap
const least_map_px = 500;
const paper_px = 500;  // the height of a printed map: the rest of the sheet fits above and below it

function isWide(): boolean { return window.matchMedia(wide_window).matches && !isPrinting(); }

/** As high as the window allows with heading and replay in view, and as wide as the map then is. */
export function mapSize(aspect: number): { width: number; height: number } {
  const stage = byId("stage").getBoundingClientRect();
  const map = byId("map").getBoundingClientRect();
  const wide = isWide();
  const room = byId("stage").clientWidth - (wide ? panel_px : 0);
  const replay = byId("replay").offsetHeight;
  const below = (replay > 0 ? replay + 12 : 0) + 10;
  const from_top = window.innerHeight - (map.top + window.scrollY) - below;
  const scrolled_to = window.innerHeight - (map.top - stage.top) - below;
  const allowed = isPrinting() ? paper_px : wide ? Math.max(from_top, Math.min(scrolled_to, 360)) : scrolled_to;
  const height = Math.max(Math.min(room / aspect, allowed), Math.min(room / aspect, 220));
  const width = wide ? Math.min(Math.max(height * aspect, least_map_px), room) : isPrinting() ? height * aspect : room;
  return { width: Math.round(width), height: Math.round(height) };
}

/** Legend and table next to the map, or below it, where two maps side by side take the width. */
export function placeExplained(below: boolean): void {
  const part = byId("explained");
  const to = below && isWide() ? byId("below-map") : document.querySelector<HTMLElement>(".panel-parts")!;
  if (part.parentElement !== to) to.append(part);
}

/** Puts the flights table next to the map, where there is room, so that both are in view; else below. */
export function placeTable(): void {
  byId(isWide() ? "table-beside" : "table-below").append(byId("flight-table"));
}

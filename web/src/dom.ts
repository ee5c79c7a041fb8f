// Builds elements: text is always inserted as text, never as markup.

type Attributes = Record<string, string | number | boolean | undefined>;

export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/** A canvas of the element's size in the screen's pixels; true when its size changed. */
export function fitted(canvas: HTMLCanvasElement, ratio = pixelRatio()): boolean {
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width === width && canvas.height === height) return false;
  canvas.width = width;
  canvas.height = height;
  return true;
}

let printing = false;
/** While the page is laid out for paper: narrow, light, without what only a screen can use. */
export function setPrinting(on: boolean): void {
  printing = on;
  document.documentElement.toggleAttribute("data-printing", on);
}
export function isPrinting(): boolean { return printing; }
export function isDark(): boolean { return !printing && window.matchMedia("(prefers-color-scheme: dark)").matches; }

export function pixelRatio(): number { return printing ? 2 : Math.min(window.devicePixelRatio || 1, 2); }

export function cssVariable(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** One term and its meaning, for a description list. */
export function term(name: string, ...value: (Node | string)[]): HTMLElement {
  return el("div", {}, el("dt", {}, name), el("dd", {}, ...value));
}

const plain = new Intl.NumberFormat("en", { maximumFractionDigits: 2, useGrouping: false });
export function short(value: number): string {
  return (Math.abs(value) >= 1000 ? Math.round(value).toString() : plain.format(value)).replace("-", "−");
}
export const grouped = (n: number): string => n.toLocaleString("en").replace(/,/g, "\u202f");

/** "97.2 %", never rounded up to all or down to nothing. */
export function percent(share: number, digits = 1): string {
  const least = 10 ** -digits;
  const shown = Math.round(share * 100 / least) * least;
  if (share < 1 && shown >= 100) return `> ${(100 - least).toFixed(digits)} %`;
  if (share > 0 && shown < least / 2) return `< ${least.toFixed(digits)} %`;
  return `${shown.toFixed(digits)} %`;
}

const winds = ["east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east"];
export const degrees = (rad: number): number => ((rad * 180 / Math.PI) % 360 + 360) % 360;
export function wind(rad: number): string { return winds[Math.round(degrees(rad) / 45) % 8]; }
export function turnOf(degrees: number): number { return degrees * Math.PI / 180; }
export function headingWords(rad: number): string { return `${Math.round(degrees(rad) * 10) / 10}°`; }

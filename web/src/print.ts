// The page on paper: laid out for a sheet before the browser prints, and restored afterwards.
import { setPrinting } from "./dom";

export function preparePrinting(relayout: () => void): void {
  const turn = (on: boolean) => () => {
    setPrinting(on);
    relayout();
  };
  window.addEventListener("beforeprint", turn(true));
  window.addEventListener("afterprint", turn(false));
}

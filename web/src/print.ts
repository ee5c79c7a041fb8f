// The page on paper: laid out as narrow as a sheet before the browser prints, and then as it was.
import { setPrinting } from "./dom";

export function preparePrinting(relayout: () => void): void {
  const turn = (on: boolean) => () => {
    setPrinting(on);
    relayout();
  };
  window.addEventListener("beforeprint", turn(true));
  window.addEventListener("afterprint", turn(false));
}

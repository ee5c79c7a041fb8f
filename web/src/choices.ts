// What is chosen by radio buttons, check boxes and rows of buttons.
import { el } from "./dom";

export function radios<Value extends string>(box: HTMLElement, name: string, items: [Value, string][], chosen: Value, choose: (value: Value) => void): void {
  for (const [value, words] of items) {
    const input = el("input", { type: "radio", name, value, checked: value === chosen });
    input.addEventListener("change", () => choose(value));
    box.append(el("label", { class: "choice" }, input, words));
  }
}

export function checkBox(box: HTMLElement, value: string, words: (Node | string)[], on: boolean, choose: (on: boolean) => void): HTMLInputElement {
  const input = el("input", { type: "checkbox", value, checked: on });
  input.addEventListener("change", () => choose(input.checked));
  box.append(el("label", { class: "choice" }, input, ...words));
  return input;
}

/** A row of buttons, one of them pressed; initially the first. */
export function oneOf(names: readonly string[], label: string, choose: (k: number) => void): HTMLElement {
  const row = el("div", { role: "group", "aria-label": label });
  const buttons = names.map((name, k) => {
    const button = el("button", { type: "button", "aria-pressed": k === 0 ? "true" : "false" }, name);
    button.addEventListener("click", () => {
      buttons.forEach((other) => other.setAttribute("aria-pressed", String(other === button)));
      choose(k);
    });
    return button;
  });
  row.append(...buttons);
  return row;
}

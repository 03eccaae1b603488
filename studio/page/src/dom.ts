// Elements of the page, made by small functions.
import { iconOf, type IconName } from "./icons";

type Child = Node | string | null | undefined | false;
type Handlers = { [K in keyof HTMLElementEventMap as `on${K}`]?: (event: HTMLElementEventMap[K]) => void };
type Attributes = Handlers & { [name: string]: unknown };

/** An element with attributes (on... are listeners; true: present; false, null, undefined: absent) and children. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    if (name.startsWith("on") && typeof value === "function") element.addEventListener(name.slice(2), value as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** A button with words. */
export function button(label: string, action: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return el("button", { type: "button", onclick: () => action(), ...attributes }, label);
}

/** A button that shows an icon; the label is its name for screen readers and its tooltip, with a key if there is one. */
export function iconButton(icon: IconName, label: string, action: () => void, key = ""): HTMLButtonElement {
  const title = key === "" || matchMedia("(hover: none)").matches ? label : `${label} (${key})`;
  const made = el("button", { type: "button", class: "icon", "aria-label": label, title, onclick: () => action() });
  made.append(iconOf(icon));
  return made;
}

/** Puts a short word below the icon of a button. */
export function withWord(made: HTMLButtonElement, word: string): HTMLButtonElement {
  made.classList.add("with-word");
  made.append(el("span", { "aria-hidden": "true" }, word));
  return made;
}

/** A slider with a typed number. input: while it moves; change: at the end. */
export function slider(options: {
  label: string;
  min: number;
  max: number;
  step: number;
  value: number;
  unit?: string;
  input?: (value: number) => void;
  change?: (value: number) => void;
}): { element: HTMLElement; set(value: number): void; get(): number } {
  const name = options.unit ? `${options.label} (${options.unit})` : options.label;
  const range = el("input", { type: "range", min: options.min, max: options.max, step: options.step, "aria-label": name });
  const number = el("input", { type: "number", min: options.min, max: options.max, step: options.step, "aria-label": `${name}, typed` });
  const set = (value: number) => {
    range.value = String(value);
    number.value = String(Math.round(value * 1000) / 1000);
  };
  const clamped = (text: string) =>
    Math.min(options.max, Math.max(options.min, Number.isFinite(Number(text)) && text !== "" ? Number(text) : options.value));
  range.addEventListener("input", () => {
    number.value = range.value;
    options.input?.(Number(range.value));
  });
  range.addEventListener("change", () => options.change?.(Number(range.value)));
  number.addEventListener("change", () => {
    const value = clamped(number.value);
    set(value);
    options.input?.(value);
    options.change?.(value);
  });
  set(options.value);
  const label = el("span", { class: "slider-label", "aria-hidden": "true" }, options.label);
  return { element: el("div", { class: "slider" }, label, range, number), set, get: () => Number(range.value) };
}

/** A switch: a button with aria-pressed. */
export function toggle(label: string, value: boolean, change: (value: boolean) => void, icon?: IconName, key = ""): HTMLButtonElement {
  const made = icon ? iconButton(icon, label, flip, key) : button(label, flip);
  function flip(): void {
    const next = made.getAttribute("aria-pressed") !== "true";
    made.setAttribute("aria-pressed", String(next));
    change(next);
  }
  made.setAttribute("aria-pressed", String(value));
  return made;
}

/** A select with a label. */
export function choice(
  label: string,
  options: readonly { value: string; title: string }[],
  value: string,
  change: (value: string) => void,
): HTMLLabelElement {
  const list = el("select", { onchange: () => change(list.value) });
  for (const option of options) list.append(el("option", { value: option.value, selected: option.value === value }, option.title));
  return el("label", { class: "field" }, el("span", {}, label), list);
}

/** Saves bytes under a name, as a download. */
export function download(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  const link = el("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

/** With a capital letter and a full stop. */
export function sentence(text: string): string {
  const trimmed = text.trim();
  return trimmed.charAt(0).toUpperCase() + trimmed.slice(1) + (/[.?!]$/.test(trimmed) ? "" : ".");
}

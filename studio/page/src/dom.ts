// Elements of the page, made by small functions.

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

const kIcons = {
  undo: "M9 7 4.5 11.5 9 16M5 11.5h9a5.5 5.5 0 0 1 0 11h-3",
  redo: "M15 7l4.500 4.500L15 16M19 11.500h-9a5.500 5.500 0 0 0 0 11h3",
  sun: "M12 4V2M12 22v-2M4 12H2M22 12h-2M6.300 6.300 4.900 4.900M19.100 19.100l-1.400-1.400M6.300 17.700l-1.400 1.400M19.100 4.900l-1.400 1.400M16 12a4 4 0 1 1-8 0 4 4 0 0 1 8 0",
  moon: "M20 14.500A8.500 8.500 0 0 1 9.500 4a8.500 8.500 0 1 0 10.500 10.500",
  help: "M9 9a3 3 0 1 1 4.500 2.600c-1 .6-1.500 1.200-1.500 2.400M12 17.500v.1M22 12a10 10 0 1 1-20 0 10 10 0 0 1 20 0",
  pen: "M4 20l1-4L16 5l3 3L8 19zM13.500 7.500l3 3",
  eraser: "M8 20h12M5 15l8.500-8.500a2 2 0 0 1 2.800 0l3.200 3.200a2 2 0 0 1 0 2.800L12 20H9l-4-4a.7.7 0 0 1 0-1M9.500 10.500l6 6",
  mirror: "M12 3v18M9 7 3 18h6zM15 7l6 11h-6z",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  picture: "M4 5h16v14H4zM4 16l5-5 4 4 3-3 4 4M15.500 9.500v.1",
  pin: "M9 4h6l-1 6 3 3v2H7v-2l3-3zM12 15v6",
  trash: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13M10.500 11v5M13.500 11v5",
  rename: "M4 20h16M6 16l1-3.500L15.500 4l2.500 2.500L9.500 15z",
  folder: "M3 7a1 1 0 0 1 1-1h5l2 2h9a1 1 0 0 1 1 1v9a1 1 0 0 1-1 1H4a1 1 0 0 1-1-1z",
  close: "M6 6l12 12M18 6 6 18",
  brush: "M20 4c-5 2-9 6-10.500 9.500l2 2C15 14 18 9 20 4M9 14c-2 0-3.500 1.500-3.500 3.500 0 1-.7 1.800-1.500 2.500 4 .5 7-.8 7-3.500",
  lasso:
    "M8 15.500c-3-1-4-2.800-4-4.800C4 7 7.500 5 12 5s8 2 8 5.500-3.500 6-8 6c-1.500 0-2.500-.2-4-1M8 15.500a2 2 0 1 0-2 2.500c1.500 0 2-1 2-2.500M6 18c0 1.500.5 2.500 1.500 3.500",
  move: "M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3",
  roll: "M3 18h18M6 18a6 6 0 0 1 12 0M12 8V3M9.500 5.500 12 3l2.500 2.500",
  pull: "M5 21c0-6 6-6 6-11 0-3-2-5-6-7M14 12h7M18 9l3 3-3 3",
  gesture: "M3 15c3-8 6-8 6-3s-3 7-3 3 6-9 9-6 1 8-1 7 0-5 7-6",
  turn: "M20 12c0 2.200-3.600 4-8 4s-8-1.800-8-4 3.600-4 8-4c2 0 3.800.4 5.200 1M17.500 5l.5 4-4 .5",
  unbrush: "M5 12h14M22 12a10 10 0 1 1-20 0 10 10 0 0 1 20 0",
  settings: "M4 8h9M17 8h3M4 16h3M11 16h9M15 6v4a2 2 0 0 0 0-4M9 14a2 2 0 1 0 0 4 2 2 0 1 0 0-4M15 6a2 2 0 1 0 0 4",
  download: "M12 4v11M7.500 11 12 15.500 16.500 11M4 20h16",
} as const;
export type IconName = keyof typeof kIcons;

/** A line drawing in the colour of the text, in a square of a side; no screen reader sees it. */
export function lineIcon(line: string, side: number): SVGSVGElement {
  const kSvg = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(kSvg, "svg");
  svg.setAttribute("viewBox", `0 0 ${side} ${side}`);
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(kSvg, "path");
  path.setAttribute("d", line);
  svg.append(path);
  return svg;
}

export function iconOf(name: IconName): SVGSVGElement {
  return lineIcon(kIcons[name], 24);
}

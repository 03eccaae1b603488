// A slider by name with a typed number, and a pair of them for the two sides of a face.
import { el } from "./dom";
import { button, newId } from "./widgets";

export interface SliderOptions {
  /** The whole name, as a screen reader reads it. */
  name: string;
  /** What is written in front of it; the name where it is absent. */
  label?: string;
  least: number;
  greatest: number;
  step?: number;
  /** The value of a double click, from which the bar is filled. */
  neutral?: number;
  unit?: string;
  /** Called while the value changes (done = false) and when a person lets go (done = true). */
  change(value: number, done: boolean): void;
}

export interface Slider {
  readonly element: HTMLElement;
  get(): number;
  /** Shows a value; `change` is not called. */
  set(value: number): void;
}

export function slider(options: SliderOptions): Slider {
  const { least, greatest, neutral = 0 } = options;
  const step = options.step ?? 0.01;
  const digits = Math.max(0, Math.ceil(-Math.log10(step)));
  const id = newId("slider");
  const shared = { min: least, max: greatest, step };
  const range = el("input", { type: "range", id, class: "p-range", ...shared, title: "Double click: back to " + neutral });
  range.setAttribute("aria-label", options.name);
  const number = el("input", { type: "number", class: "p-number", ...shared, "aria-label": `${options.name}, typed` });
  const label = el("label", { for: id, class: "p-slider-label", title: options.name }, options.label ?? options.name);
  const element = el("div", { class: "p-slider" }, label, range, number);
  if (options.unit) {
    element.classList.add("p-with-unit");
    element.append(el("span", { class: "p-unit" }, options.unit));
  }

  let value = neutral;
  const share = (at: number) => (100 * (at - least)) / (greatest - least);
  const show = (typing = false) => {
    range.value = String(value);
    if (!typing) number.value = String(Number(value.toFixed(digits)));
    const ends = [share(neutral), share(value)].sort((a, b) => a - b);
    range.style.setProperty("--from", `${ends[0]}%`);
    range.style.setProperty("--to", `${ends[1]}%`);
    element.classList.toggle("p-changed", value !== neutral);
  };
  const take = (next: number, done: boolean, typing = false) => {
    value = Math.min(greatest, Math.max(least, next));
    show(typing);
    options.change(value, done);
  };

  range.addEventListener("input", () => take(range.valueAsNumber, false));
  range.addEventListener("change", () => take(range.valueAsNumber, true));
  range.addEventListener("dblclick", () => take(neutral, true));
  label.addEventListener("dblclick", () => take(neutral, true));
  range.addEventListener("keydown", (event) => {
    if (event.key !== "Delete" && event.key !== "Backspace") return;
    event.preventDefault();
    take(neutral, true);
  });
  number.addEventListener("input", () => {
    const typed = number.valueAsNumber;
    if (Number.isFinite(typed) && typed >= least && typed <= greatest) take(typed, false, true);
  });
  number.addEventListener("change", () => take(Number.isFinite(number.valueAsNumber) ? number.valueAsNumber : neutral, true));
  show();
  return {
    element,
    get: () => value,
    set: (next) => {
      value = next;
      show();
    },
  };
}

export interface SidesOptions extends Omit<SliderOptions, "change"> {
  /** Left and right are those of the head. */
  change(sides: { left: number; right: number }, done: boolean): void;
  /** Whether one slider moves both sides at first. */
  linked: boolean;
  onLink(linked: boolean): void;
}

export interface SidesSlider {
  readonly element: HTMLElement;
  /** Shows two values; sides that differ are unlinked, unless the values pass by (a clip plays). */
  set(sides: { left: number; right: number }, passing?: boolean): void;
}

/** One slider for both sides, or one for each, by a switch. */
export function sidesSlider(options: SidesOptions): SidesSlider {
  const { name, label } = options;
  const value = { left: options.neutral ?? 0, right: options.neutral ?? 0 };
  const both = slider({
    ...options,
    change: (next, done) => {
      value.left = value.right = next;
      options.change({ ...value }, done);
    },
  });
  const one = (side: "left" | "right") =>
    slider({
      ...options,
      name: `${name}, ${side}`,
      label: `${label ?? name}, ${side}`,
      change: (next, done) => {
        value[side] = next;
        options.change({ ...value }, done);
      },
    });
  const left = one("left");
  const right = one("right");
  const link = button("", () => setLinked(link.getAttribute("aria-pressed") !== "true", true), {
    icon: "link",
    kind: "quiet",
    name: `${name}: both sides together`,
  });
  const rows = el("div", { class: "p-sides-rows" }, both.element, left.element, right.element);
  const element = el("div", { class: "p-sides" }, rows, link);

  const setLinked = (linked: boolean, byHand: boolean) => {
    link.setAttribute("aria-pressed", String(linked));
    both.element.hidden = !linked;
    left.element.hidden = right.element.hidden = linked;
    if (!byHand) return;
    options.onLink(linked);
    if (!linked || value.left === value.right) return;
    value.left = value.right = (value.left + value.right) / 2;
    show();
    options.change({ ...value }, true);
  };
  const show = () => {
    both.set((value.left + value.right) / 2);
    left.set(value.left);
    right.set(value.right);
  };
  setLinked(options.linked, false);
  return {
    element,
    set: (sides, passing = false) => {
      Object.assign(value, sides);
      show();
      if (sides.left !== sides.right && !passing) setLinked(false, false);
    },
  };
}

// Elements of the panels: buttons, sections, sliders with a typed number, switches, choices.

import { el, lineIcon } from "./dom";

let lastId = 0;
/** An id that no other element of the page has. */
export function newId(prefix: string): string {
  lastId += 1;
  return `${prefix}-${lastId}`;
}

export interface ButtonOptions {
  kind?: "primary" | "plain" | "quiet" | "danger";
  icon?: IconName;
  /** What a screen reader says where the label is an icon alone. */
  name?: string;
  title?: string;
}

export function button(label: string, act: () => void, options: ButtonOptions = {}): HTMLButtonElement {
  return el(
    "button",
    {
      type: "button",
      class: `p-button p-${options.kind ?? "plain"}${label ? "" : " p-icon-only"}`,
      "aria-label": options.name,
      title: options.title ?? (label ? null : options.name),
      onclick: act,
    },
    options.icon && icon(options.icon),
    label && el("span", {}, label),
  );
}

/** A button that stays down while its state is on. */
export function toggle(label: string, on: boolean, change: (on: boolean) => void, options: ButtonOptions = {}) {
  const element = button(label, () => set(element.getAttribute("aria-pressed") !== "true", true), options);
  const set = (value: boolean, byHand = false) => {
    element.setAttribute("aria-pressed", String(value));
    if (byHand) change(value);
  };
  set(on);
  return { element, set };
}

export function checkbox(label: string, on: boolean, change: (on: boolean) => void): HTMLLabelElement {
  const input = el("input", { type: "checkbox", checked: on, onchange: () => change(input.checked) });
  return el("label", { class: "p-check" }, input, el("span", {}, label));
}

export interface Section {
  element: HTMLDetailsElement;
  body: HTMLElement;
  /** A remark on the right of the title, such as "3 changed". */
  note(text: string): void;
}

/** A part of a panel that folds. `onFold` receives whether it is open. */
export function section(title: string, open: boolean, onFold?: (open: boolean) => void): Section {
  const note = el("span", { class: "p-note" });
  const body = el("div", { class: "p-section-body" });
  const element = el(
    "details",
    { class: "p-section", open },
    el("summary", {}, icon("chevron"), el("span", { class: "p-section-title" }, title), note),
    body,
  );
  element.addEventListener("toggle", () => onFold?.(element.open));
  return { element, body, note: (text) => note.replaceChildren(text) };
}

/** A list of choices with a label. `set` replaces the choices and keeps the chosen one where it still exists. */
export function choice(label: string, change: (value: string) => void) {
  const id = newId("choice");
  const select = el("select", { id, class: "p-select", onchange: () => change(select.value) });
  const element = el("div", { class: "p-field" }, el("label", { for: id }, label), select);
  const set = (choices: { value: string; label: string; group?: string }[], value: string) => {
    const groups = new Map<string, HTMLOptGroupElement>();
    select.replaceChildren();
    for (const each of choices) {
      const option = el("option", { value: each.value }, each.label);
      if (!each.group) {
        select.append(option);
        continue;
      }
      const group = groups.get(each.group) ?? el("optgroup", { label: each.group });
      if (!groups.has(each.group)) select.append(group);
      groups.set(each.group, group);
      group.append(option);
    }
    select.value = value;
  };
  return { element, select, set };
}

/** One of a few values as buttons in a row. */
export function segments<T extends string>(
  label: string,
  values: readonly { value: T; label: string }[],
  value: T,
  change: (value: T) => void,
) {
  const name = newId("segments");
  const inputs = values.map((each) => {
    const input = el("input", { type: "radio", name, value: each.value, checked: each.value === value });
    input.addEventListener("change", () => input.checked && change(each.value));
    return { input, element: el("label", {}, input, el("span", {}, each.label)) };
  });
  const element = el(
    "fieldset",
    { class: "p-segments" },
    el("legend", {}, label),
    el("div", { class: "p-segments-row" }, ...inputs.map((each) => each.element)),
  );
  const set = (chosen: T) => {
    for (const each of inputs) each.input.checked = each.input.value === chosen;
  };
  return { element, set };
}

/** Bytes in the unit that a person reads. */
export function fileSize(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 1e6) return `${Math.round(bytes / 1000)} kB`;
  return `${(bytes / 1e6).toFixed(1)} MB`;
}

const kIcons = {
  chevron: "M6 4l4 4-4 4",
  link: "M6.5 9.5l3-3M7 5l1.5-1.5a2.5 2.5 0 0 1 4 4L11 9M9 11l-1.5 1.5a2.5 2.5 0 0 1-4-4L5 7",
  remove: "M4 4l8 8M12 4l-8 8",
  reset: "M3 3v4h4M3.5 7a5 5 0 1 1-.3 3",
  dice: "M3 3h10v10H3zM5.8 5.8h.01M10.2 5.8h.01M8 8h.01M5.8 10.2h.01M10.2 10.2h.01",
  pin: "M8 10v4M5 10h6M6 2h4l-.5 4L11 8v2H5V8l1.5-2z",
  play: "M5 3l8 5-8 5z",
  pause: "M5 3v10M11 3v10",
  plus: "M8 3v10M3 8h10",
  minus: "M3 8h10",
  fit: "M3 6V3h3M10 3h3v3M13 10v3h-3M6 13H3v-3",
  download: "M8 2v8M4.5 7L8 10.5 11.5 7M3 13.5h10",
  upload: "M8 11V3M4.5 6L8 2.5 11.5 6M3 13.5h10",
  copy: "M6 6h7v7H6zM10 6V3H3v7h3",
  point: "M8 5.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5M8 1v2M8 13v2M1 8h2M13 8h2",
  search: "M7 3a4 4 0 1 0 0 8 4 4 0 0 0 0-8M10 10l3.5 3.5",
  undo: "M6 3L3 6l3 3M3 6h6a4 4 0 0 1 0 8H7",
  redo: "M10 3l3 3-3 3M13 6H7a4 4 0 0 0 0 8h2",
  mesh: "M8 2l5.5 10h-11zM8 2v10M5.2 7h5.6",
  cube: "M8 2l5 3v6l-5 3-5-3V5zM3 5l5 3 5-3M8 8v6",
  person: "M8 2.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5M3 13.5c0-3 2-4.5 5-4.5s5 1.5 5 4.5",
  layers: "M8 2l6 3-6 3-6-3zM2 8l6 3 6-3M2 11l6 3 6-3",
  film: "M2.5 3h11v10h-11zM5 3v10M11 3v10M2.5 8h11",
  pen: "M3 13l1-3.5L11 2.5 13.5 5 6.5 12z",
} as const;
export type IconName = keyof typeof kIcons;

/** A small icon of panels. */
export function icon(name: IconName): SVGSVGElement {
  const element = lineIcon(kIcons[name], 16);
  element.setAttribute("class", "p-icon");
  return element;
}

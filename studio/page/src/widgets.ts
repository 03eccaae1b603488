// Elements of the panels: buttons, sections, sliders with a typed number, switches, choices.

import { el } from "./dom";
import { iconOf, type IconName } from "./icons";

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

/** A small icon of panels. */
export function icon(name: IconName): SVGSVGElement {
  const element = iconOf(name);
  element.setAttribute("class", "p-icon");
  return element;
}

// Sliders of the anatomical controls, a folding section a group of them.
import type { Shape, ShapeInfo } from "../api_types";
import { slider, sidesSlider } from "../slider";
import { section } from "../widgets";
import { matches, withValues, type Editor, type Part } from "./editor";

type Control = ShapeInfo["controls"][number];

interface Row {
  element: HTMLElement;
  words: string;
  changed(document: Shape): boolean;
  show(document: Shape): void;
}

export interface Memory {
  get(key: string): boolean | undefined;
  set(key: string, value: boolean): void;
}

export function controlsPart(info: ShapeInfo, editor: Editor, folded: Memory, unlinked: Memory): Part[] {
  const groups = new Map<string, Control[]>();
  for (const control of info.controls) groups.set(control.group, [...(groups.get(control.group) ?? []), control]);
  return [...groups].map(([group, controls], index) => groupPart(group, controls, index === 0, editor, folded, unlinked));
}

function groupPart(group: string, controls: Control[], first: boolean, editor: Editor, folded: Memory, unlinked: Memory): Part {
  const isOpen = () => folded.get(group) ?? first;
  let searching = false;
  const part = section(group, isOpen(), (open) => {
    if (!searching) folded.set(group, open);
  });
  const rows = controls.map((control) => rowOf(control, editor, unlinked));
  part.body.append(...rows.map((row) => row.element));
  return {
    element: part.element,
    show: (document) => {
      for (const row of rows) row.show(document);
      const changed = rows.filter((row) => row.changed(document)).length;
      part.note(changed ? `${changed} changed` : "");
    },
    search: (words) => {
      searching = words !== "";
      let found = false;
      for (const row of rows) {
        const hit = matches(`${group} ${row.words}`, words);
        row.element.hidden = !hit;
        found ||= hit;
      }
      part.element.hidden = !found;
      part.element.open = searching ? found : isOpen();
      return found;
    },
  };
}

function rowOf(control: Control, editor: Editor, unlinked: Memory): Row {
  const { name, least, greatest } = control;
  // The group's title is above: "nose width" is "width" there.
  const label = control.title.charAt(0).toUpperCase() + control.title.slice(1);
  const value = (document: Shape, key: string) => document.controls?.[key] ?? 0;
  if (control.sides === 1) {
    const row = slider({
      name: control.title,
      label,
      least,
      greatest,
      change: (next, done) => editor.change({ controls: withValues(editor.document.controls, { [name]: next }) }, name, done),
    });
    return {
      element: row.element,
      words: control.title,
      changed: (document) => value(document, name) !== 0,
      show: (document) => row.set(value(document, name)),
    };
  }
  const left = `${name}_left`;
  const right = `${name}_right`;
  const row = sidesSlider({
    name: control.title,
    label,
    least,
    greatest,
    linked: unlinked.get(name) !== true,
    onLink: (linked) => unlinked.set(name, !linked),
    change: (sides, done) =>
      editor.change({ controls: withValues(editor.document.controls, { [left]: sides.left, [right]: sides.right }) }, name, done),
  });
  return {
    element: row.element,
    words: control.title,
    changed: (document) => value(document, left) !== 0 || value(document, right) !== 0,
    show: (document) => row.set({ left: value(document, left), right: value(document, right) }),
  };
}

// The list of handles: points of the surface that a person moved, with typed numbers.
import type { Shape } from "../api_types";
import { el } from "../dom";
import { button, section, toggle } from "../widgets";
import type { Memory } from "./controls_part";
import type { Handle } from "./document";
import { matches, type Editor, type Part } from "./editor";

export interface HandlesPart extends Part {
  /** The switch that lets presses on the face make points, for the top of the panel. */
  readonly picking: HTMLElement;
  /** Turns the picking of new points on or off, as the button does. */
  setPicking(on: boolean): void;
}

const kAxes = [
  { name: "to the head's left", short: "x" },
  { name: "up", short: "y" },
  { name: "forward", short: "z" },
] as const;

/** `pick` receives whether a press on the face makes a new handle; `point` which handle is under the pointer in the list. */
export function handlesPart(editor: Editor, folded: Memory, pick: (on: boolean) => void, point: (at: number | null) => void): HandlesPart {
  const adding = toggle("Move points", false, (on) => {
    if (on) part.element.open = true;
    pick(on);
  }, { icon: "point", title: "Drag places of the face in the view" });
  const list = el("ol", { class: "p-handles" });
  const hint = el("p", { class: "p-hint" });
  const clear = button("Remove all", () => editor.change({ handles: [] }, "handles", true), { kind: "quiet" });
  const part = section("moved points", folded.get("points") ?? false, (open) => folded.set("points", open));
  const clearRow = el("div", { class: "p-row" }, clear);
  part.body.append(hint, list, clearRow);

  const field = (handle: Handle, index: number, axis: 0 | 1 | 2) => {
    const input = el("input", {
      type: "number",
      class: "p-number",
      step: 0.1,
      value: String(Number(handle.move[axis].toFixed(2))),
      "aria-label": `point ${index + 1}, ${kAxes[axis].name}, cm`,
      title: `${kAxes[axis].name}, cm`,
    });
    input.addEventListener("change", () => {
      const handles = (editor.document.handles ?? []).map((each): Handle => ({ ...each, move: [...each.move] }));
      const own = handles[index];
      if (!own || !Number.isFinite(input.valueAsNumber)) return;
      own.move[axis] = input.valueAsNumber;
      editor.change({ handles }, `handle ${own.vertex}`, true);
    });
    return el("label", { class: "p-axis" }, kAxes[axis].short, input);
  };
  const row = (handle: Handle, index: number) =>
    el(
      "li",
      { onpointerenter: () => point(index), onpointerleave: () => point(null) },
      el("span", { class: "p-handle-name" }, String(index + 1)),
      field(handle, index, 0),
      field(handle, index, 1),
      field(handle, index, 2),
      button("", () => {
        editor.change({ handles: (editor.document.handles ?? []).filter((_, at) => at !== index) }, "handles", true);
      }, { kind: "quiet", icon: "close", name: `Remove point ${index + 1}` }),
    );

  let shown = "";
  const show = (document: Shape) => {
    const handles = document.handles ?? [];
    const active = list.contains(window.document.activeElement) ? window.document.activeElement?.getAttribute("aria-label") : null;
    const now = JSON.stringify(handles);
    if (now !== shown) list.replaceChildren(...handles.map(row));
    shown = now;
    // A number that was typed keeps the focus.
    if (active) list.querySelector<HTMLElement>(`[aria-label="${active}"]`)?.focus();
    clearRow.hidden = handles.length === 0;
    part.note(handles.length ? `${handles.length} moved` : "");
    hint.replaceChildren(
      adding.element.getAttribute("aria-pressed") === "true"
        ? "Press a place of the face and drag it. A press without a drag holds the place where it is. Dots can be dragged again."
        : handles.length
          ? "Centimetres from where each point was: x to the head's left, y up, z forward."
          : "Turn on “Move points”, then drag a place of the face in the view.",
    );
  };
  return {
    element: part.element,
    picking: adding.element,
    show,
    setPicking: (on) => {
      adding.set(on);
      show(editor.document);
    },
    search: (words) => {
      const hit = matches("points handles move drag", words);
      part.element.hidden = !hit;
      return hit;
    },
  };
}

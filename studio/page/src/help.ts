// The help overlay.
import { button, el } from "./dom";

const kKeys: readonly (readonly [string, string])[] = [
  ["Ctrl+Z, Ctrl+Shift+Z", "Undo, redo"],
  ["1, 2, 3", "Sketch, redraw, sculpt"],
  ["B, E", "Pen, eraser"],
  ["M", "Mirror"],
  ["T, B, V, P, R", "Sculpt: turn, brush, move, pull, region"],
  ["+, −, 0", "Zoom in, zoom out, show all"],
  ["Space and drag, two fingers", "Move the paper"],
  ["Arrow keys on the 3-D view", "Turn the face"],
  ["?", "This help"],
];

export function makeHelp(): HTMLDialogElement {
  const dialog = el("dialog", { class: "help", "aria-labelledby": "help-title" });
  dialog.append(
    el("h2", { id: "help-title" }, "How it works"),
    el(
      "ol",
      {},
      el("li", {}, el("b", {}, "Draw"), ": sketch a face with a few lines. The 3-D face follows every stroke."),
      el("li", {}, el("b", {}, "Redraw"), " a line of that face: erase it, then draw its new path from dot to dot."),
      el("li", {}, el("b", {}, "Sculpt"), ": mark a part with the brush, then move it, bulge it or pull an outline."),
      el("li", {}, el("b", {}, "Shape"), " the face with sliders: its parts, its expression, a caricature of it."),
      el("li", {}, el("b", {}, "Avatar"), ": a portrait or a drawing becomes a head with hair and 52 expressions."),
      el("li", {}, el("b", {}, "Take away"), " the head as a file for a game, a film, a print or a web page."),
      el("li", {}, "Pin faces that you like. They wait in the tray at the bottom of the page."),
    ),
    el("h3", {}, "Keys"),
    el("dl", {}, ...kKeys.flatMap(([keys, what]) => [el("dt", {}, keys), el("dd", {}, what)])),
    button("Close", () => dialog.close(), { class: "primary", autofocus: true }),
  );
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  return dialog;
}

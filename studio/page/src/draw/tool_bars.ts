// The bars around the paper: modes above, tools on the left, hint and zoom below, settings of the pen in a pop-up.
import type { Mode, SessionState } from "../api_types";
import { button, el, iconButton, sentence, slider, toggle, withWord } from "../dom";
import { iconOf } from "../icons";
import { checkbox } from "../widgets";
import { hintOf, kModes, toolsOf, usesHandles, withoutKeys, type ToolName } from "./tools";

export interface PenSettings {
  stabiliser: number;
  weight: number;
  /** Lines of a pen are thinner where it is pressed less. */
  pressure: boolean;
  mirror: boolean;
  /** Pixels of the screen. */
  brushRadius: number;
  /** Who has rubbed out a line of the face draws the new one next. */
  penAfterEraser: boolean;
}
export const kFirstSettings: PenSettings = { stabiliser: 0, weight: 0, pressure: true, mirror: false, brushRadius: 18, penAfterEraser: true };

export interface BarsHost {
  readonly settings: PenSettings;
  readonly gestures: boolean;
  setMode(mode: Mode): void;
  setTool(tool: ToolName): void;
  settingsChanged(): void;
  look(yaw: number): void;
  roll(level: number): void;
  clearHandles(): void;
  menu(): void;
  /** Shows a long remark as a message. */
  remark(text: string): void;
  rename(name: string): void;
  zoom(factor: number): void;
  fit(): void;
  reference: { choose(): void; remove(): void; opacity(value: number): void; readonly present: boolean; readonly value: number };
}

/** Lines of a drawing from which on its warnings are worth a remark. */
const kFewLines = 4;

const kRollTools: readonly ToolName[] = ["brush", "unbrush", "translate"];

export class ToolBars {
  readonly top: HTMLElement;
  readonly rail = el("div", { class: "draw-rail", role: "toolbar", "aria-label": "Tools", "aria-orientation": "vertical" });
  readonly float = el("div", { class: "draw-float", hidden: true });
  readonly bottom: HTMLElement;
  private readonly name: HTMLInputElement;
  private readonly modes = new Map<Mode, HTMLButtonElement>();
  private readonly hint = el("p", { class: "draw-hint" });
  private readonly warnings = el("div", { class: "draw-warnings", role: "status", "aria-live": "polite" });
  private readonly busy = el("span", { class: "draw-busy", hidden: true }, "Working …");
  private readonly mirror: HTMLButtonElement;
  private readonly settingsPanel: HTMLElement;
  private shown = "";
  private railShown = "";
  private floatShown = "";

  constructor(private readonly host: BarsHost) {
    this.name = el("input", {
      type: "text",
      class: "draw-name",
      "aria-label": "Name of the drawing",
      maxlength: 80,
      onchange: () => host.rename(this.name.value.trim()),
    });
    this.name.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.name.blur();
    });
    const group = el("div", { class: "draw-modes", role: "group", "aria-label": "Mode" });
    for (const { mode, label, key, about } of kModes) {
      const made = button(label, () => host.setMode(mode), { title: `${about} (${key})`, "aria-pressed": "false" });
      this.modes.set(mode, made);
      group.append(made);
    }
    this.top = el(
      "div",
      { class: "draw-top" },
      el(
        "button",
        { type: "button", class: "draw-menu", title: "New drawing, earlier drawings", onclick: () => host.menu() },
        iconOf("folder"),
        el("span", {}, "Drawings"),
      ),
      this.name,
      group,
    );
    const mirror = toggle(
      "Mirror",
      host.settings.mirror,
      (on) => {
        host.settings.mirror = on;
        host.settingsChanged();
      },
      "mirror",
      "M",
    );
    this.mirror = withWord(mirror, "Mirror");
    this.settingsPanel = this.makeSettings();
    this.bottom = el(
      "div",
      { class: "draw-bottom" },
      el("div", { class: "draw-words" }, this.hint, this.warnings),
      this.busy,
      el(
        "div",
        { class: "draw-zoom", role: "group", "aria-label": "Zoom" },
        iconButton("minus", "Zoom out", () => host.zoom(1 / 1.25), "−"),
        iconButton("fit", "Show all", () => host.fit(), "0"),
        iconButton("plus", "Zoom in", () => host.zoom(1.25), "+"),
      ),
    );
  }

  flipMirror(): void {
    this.mirror.click();
  }
  /** The buttons over the paper make way for a face that looks to the right. */
  setYaw(yaw: number): void {
    this.float.classList.toggle("flipped", yaw < -20 && yaw > -160);
  }
  setBusy(busy: boolean): void {
    this.busy.hidden = !busy;
  }

  update(state: SessionState, tool: ToolName, erased: boolean): void {
    if (document.activeElement !== this.name) this.name.value = state.name;
    for (const [mode, made] of this.modes) made.setAttribute("aria-pressed", String(mode === state.mode));
    const draw = this.modes.get("draw");
    const isPast = state.mode !== "draw";
    draw?.setAttribute("aria-disabled", String(isPast));
    if (draw) draw.title = isPast ? "The lines are those of a face now. Free strokes need a new drawing" : "Draw a face with a few lines (1)";
    this.hint.textContent = withoutKeys(hintOf(state, tool, erased));
    this.updateWarnings(state);
    this.updateRail(state, tool);
  }

  /** One line below the hint, so that the paper stays where it is; a click shows all of it. */
  private updateWarnings(state: SessionState): void {
    // A face of the first lines is one of many anyway.
    const isBeginning = state.mode === "draw" && state.lines.length < kFewLines;
    const text = isBeginning ? "" : [...new Set(state.warnings)].map(sentence).join(" ");
    if (text === this.shown) return;
    this.shown = text;
    this.warnings.replaceChildren();
    if (text !== "") this.warnings.append(button(text, () => this.host.remark(text), { title: text }));
  }

  private updateRail(state: SessionState, tool: ToolName): void {
    this.updateFloat(state, tool);
    const shown = [state.mode, tool, this.host.gestures].join();
    if (shown === this.railShown) return;
    this.railShown = shown;
    const focused = this.rail.contains(document.activeElement) ? document.activeElement?.getAttribute("aria-label") : null;
    const tools = toolsOf(state.mode, this.host.gestures).map((each) => {
      const made = withWord(iconButton(each.icon, each.label, () => this.host.setTool(each.name), each.key), each.word);
      made.setAttribute("aria-pressed", String(each.name === tool));
      made.dataset["tool"] = each.name;
      return made;
    });
    const rest = state.mode === "refine" ? [] : [el("hr", { class: "rail-line" }), this.mirror, this.settingsPanel];
    this.rail.replaceChildren(...tools, ...rest);
    if (focused) this.rail.querySelector<HTMLElement>(`[aria-label="${focused}"]`)?.focus();
  }

  /** What acts on the face in 3-D: sides to look from, the size of the brush, bulging of the handles. */
  private updateFloat(state: SessionState, tool: ToolName): void {
    this.float.hidden = state.mode !== "refine";
    const hasHandles = state.handles.length > 0;
    const shown = [tool, hasHandles].join();
    if (this.float.hidden || shown === this.floatShown) return;
    this.floatShown = shown;
    const focused = this.float.contains(document.activeElement) ? document.activeElement?.getAttribute("aria-label") : null;
    const word = (label: string, name: string, act: () => void) => button(label, act, { "aria-label": name, title: name });
    const group = (name: string, ...content: (HTMLElement | string)[]) =>
      el("div", { class: "float-group", role: "group", "aria-label": name }, ...content);
    const groups = [
      group(
        "Look from",
        word("Right", "Its right side", () => this.host.look(-90)),
        word("Front", "Front view", () => this.host.look(0)),
        word("Left", "Its left side", () => this.host.look(90)),
      ),
    ];
    if (hasHandles && kRollTools.includes(tool)) {
      const roll = (label: string, name: string, level: number) => word(label, name, () => this.host.roll(level));
      groups.push(
        group(
          "Bulge or hollow the handles",
          el("span", {}, "Bulge"),
          roll("++", "Bulge by 4 mm", 2),
          roll("+", "Bulge by 2 mm", 1),
          roll("−", "Hollow by 2 mm", -1),
          roll("−−", "Hollow by 4 mm", -2),
          el("span", {}, "Hollow"),
        ),
      );
    }
    if (hasHandles && usesHandles(tool)) groups.push(group("Handles", word("Clear", "Clear all handles", () => this.host.clearHandles())));
    if (tool === "brush" || tool === "unbrush") {
      const size = group("Brush", el("span", {}, "Brush"), this.brushSize());
      size.classList.add("float-size");
      groups.push(size);
    }
    this.float.replaceChildren(...groups);
    if (focused) this.float.querySelector<HTMLElement>(`[aria-label="${focused}"]`)?.focus();
  }
  private brushSize(): HTMLElement {
    const field = el("input", {
      type: "range",
      min: 4,
      max: 60,
      step: 1,
      value: this.host.settings.brushRadius,
      "aria-label": "Radius of the brush, pixels of the screen",
      title: "Radius of the brush",
    });
    field.addEventListener("input", () => {
      this.host.settings.brushRadius = Number(field.value);
      this.host.settingsChanged();
    });
    return field;
  }

  private makeSettings(): HTMLElement {
    const settings = this.host.settings;
    const reference = this.host.reference;
    const panel = el("div", { class: "pop", hidden: true, role: "group", "aria-label": "Options of pen and paper" });
    const removeButton = button("Remove", () => {
      reference.remove();
      show();
    });
    const opacity = slider({
      label: "Picture",
      min: 0.05,
      max: 1,
      step: 0.05,
      value: reference.value,
      input: (value) => reference.opacity(value),
    });
    const show = () => {
      removeButton.hidden = !reference.present;
      opacity.element.hidden = !reference.present;
    };
    panel.append(
      slider({
        label: "Stabiliser",
        unit: "pixels",
        min: 0,
        max: 60,
        step: 1,
        value: settings.stabiliser,
        input: (value) => {
          settings.stabiliser = value;
          this.host.settingsChanged();
        },
      }).element,
      slider({
        label: "Line weight",
        unit: "pixels, 0 is thin",
        min: 0,
        max: 24,
        step: 0.5,
        value: settings.weight,
        input: (value) => {
          settings.weight = value;
          this.host.settingsChanged();
        },
      }).element,
      checkbox("Lines follow the pressure of a pen", settings.pressure, (on) => {
        settings.pressure = on;
        this.host.settingsChanged();
      }),
      checkbox("Take the pen after the eraser", settings.penAfterEraser, (on) => {
        settings.penAfterEraser = on;
        this.host.settingsChanged();
      }),
      el("p", { class: "pop-note" }, "The stabiliser takes the tremor out of a slow hand. Weight and pressure change the line, not the face."),
      el(
        "div",
        { class: "pop-row" },
        button("Picture under the paper …", () => reference.choose()),
        removeButton,
      ),
      opacity.element,
    );
    const settingsButton = iconButton("settings", "Options of pen and paper", () => {
      panel.hidden = !panel.hidden;
      open.setAttribute("aria-expanded", String(!panel.hidden));
      show();
    });
    const open = withWord(settingsButton, "Options");
    open.setAttribute("aria-expanded", "false");
    document.addEventListener("pointerdown", (event) => {
      if (panel.hidden || holder.contains(event.target as Node)) return;
      panel.hidden = true;
      open.setAttribute("aria-expanded", "false");
    });
    const holder = el("div", { class: "pop-holder" }, open, panel);
    holder.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || panel.hidden) return;
      panel.hidden = true;
      open.focus();
    });
    return holder;
  }
}

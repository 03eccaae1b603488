// The tab Draw: a paper beside the 3-D face, in three modes.
import type { Mode, Point, SessionEvent, SessionState, View } from "../api_types";
import { isAbort } from "../api";
import { el } from "../dom";
import type { Studio, Tab } from "../tab";
import { Paper } from "./paper";
import type { LocalStroke, PaperContent } from "./paper_drawing";
import { ReferencePicture } from "./reference_picture";
import { SessionClient } from "./session_client";
import { SheetFace } from "./sheet_face";
import { StartScreen } from "./start_screen";
import { append, lengthOf, mirrored, pointsOf, pressureOf, removedParts, stabilised, type Sample } from "./stroke_path";
import { ToolBars, type PenSettings } from "./tool_bars";
import { cursorOf, toolsOf, type ToolName } from "./tools";

/** Sheet pixels: a shorter path of the pen is a slip, not a stroke. */
const kLeastLength = 2.5;
const kEmpty = "The face appears here with the first lines.";

export function createDrawTab(studio: Studio): Tab {
  return new DrawTab(studio);
}

class DrawTab implements Tab {
  readonly id = "draw";
  readonly title = "Draw";
  readonly useFaceLabel = "Begin with";
  readonly element: HTMLElement;
  private readonly session: SessionClient;
  private readonly paper: Paper;
  private readonly bars: ToolBars;
  private readonly start: StartScreen;
  private readonly reference: ReferencePicture;
  private readonly settings: PenSettings;
  private readonly file = el("input", { type: "file", accept: "image/*", hidden: true, "aria-label": "Picture under the paper" });
  private tool: ToolName = "pen";
  private path: Sample[] = [];
  private stroke: LocalStroke[] = [];
  /** Strokes that the server has not drawn yet, by the number of their event. */
  private pending = new Map<number, LocalStroke[]>();
  private events = 0;
  private ghosts: Point[][] = [];
  private pen: Point | null = null;
  private view: View = [0, 0];
  private face: SheetFace | null = null;
  private cameraRequest: AbortController | null = null;
  private mirrorAxis = 256;
  private vertices: Float32Array | null = null;
  private visible = false;
  private gestures = false;
  private turning: { x: number; y: number; view: View } | null = null;

  constructor(private readonly studio: Studio) {
    this.settings = studio.recall<PenSettings>("pen", { stabiliser: 0, weight: 0, mirror: false, brushRadius: 18 });
    this.session = new SessionClient(studio.api, {
      state: (state) => this.showState(state),
      vertices: (vertices) => this.showVertices(vertices),
      waiting: (count) => this.showWaiting(count),
      fail: (error) => studio.fail(error),
    });
    this.reference = new ReferencePicture(() => this.paper.invalidate("all"));
    this.paper = new Paper({
      content: () => this.content(),
      face: () => this.face,
      hovered: (at) => this.hovered(at),
      begin: (sample, event) => this.begin(sample, event),
      extend: (samples, event) => this.extend(samples, event),
      end: (event) => this.end(event),
      cancel: () => this.cancel(),
    });
    this.bars = this.makeBars();
    this.start = new StartScreen({
      api: studio.api,
      begin: (options) => void this.create(options),
      openSession: (id) => void this.openSession(id),
      changed: (id, name) => this.sessionChanged(id, name),
      close: () => this.start.hide(),
      fail: (error) => studio.fail(error),
    });
    this.file.addEventListener("change", () => {
      const chosen = this.file.files?.[0];
      if (chosen) this.reference.read(chosen).catch((error) => studio.fail(error));
      this.file.value = "";
    });
    this.element = el("div", { class: "draw" }, this.bars.top, this.bars.rail, this.paper.element, this.bars.float, this.bars.bottom, this.start.element, this.file);
    this.start.hide();
    addEventListener("keyup", (event) => { if (event.key === " ") this.setPanning(false); });
    addEventListener("blur", () => this.setPanning(false));
    studio.api.info().then((info) => {
      this.gestures = info.can.gestures;
      if (this.session.state) this.refreshTools();
    }, (error) => studio.fail(error));
  }

  private makeBars(): ToolBars {
    const tab = this;
    return new ToolBars({
      settings: this.settings,
      get gestures() { return tab.gestures; },
      setMode: (mode) => this.setMode(mode),
      setTool: (tool) => this.setTool(tool),
      settingsChanged: () => this.settingsChanged(),
      look: (yaw) => this.lookFrom([yaw, 0]),
      roll: (level) => void this.session.send({ do: "roll", level, view: this.view }),
      menu: () => void this.start.show(this.session.state !== null),
      rename: (name) => void this.rename(name),
      zoom: (factor) => this.paper.zoom(factor),
      fit: () => this.paper.fit(),
      reference: {
        choose: () => this.file.click(),
        remove: () => this.reference.remove(),
        opacity: (value) => this.reference.setOpacity(value),
        get present() { return tab.reference.picture !== null; },
        get value() { return tab.reference.opacity; },
      },
    });
  }

  // Tab.
  async show(): Promise<void> {
    this.visible = true;
    const state = this.session.state;
    if (state) {
      this.tellSubject(state);
      this.showVertices(this.vertices);
      this.studio.viewer.setHandles(state.mode === "refine" ? state.handles : []);
      return;
    }
    const last = this.studio.recall<string>("session", "");
    if (last !== "") {
      try {
        await this.session.open(await this.studio.api.session(last));
        return;
      } catch {
        // The session was deleted: the first screen offers the others.
        this.studio.remember("session", "");
      }
    }
    await this.showStart();
  }
  hide(): void {
    this.visible = false;
    this.cancel();
    this.session.stopPreview();
  }
  undo(): void {
    if (this.session.state?.can_undo) void this.session.send({ do: "undo" }).then(() => this.forgetGhosts());
  }
  redo(): void {
    if (this.session.state?.can_redo) void this.session.send({ do: "redo" }).then(() => this.forgetGhosts());
  }
  private forgetGhosts(): void {
    this.ghosts = [];
    this.paper.invalidate("ink");
  }
  canUndo(): boolean {
    return this.session.state?.can_undo ?? false;
  }
  canRedo(): boolean {
    return this.session.state?.can_redo ?? false;
  }
  useFace(face: { id: string; name: string }): Promise<void> {
    return this.create({ begin: face.id, name: `From ${face.name}` });
  }
  async drop(file: File): Promise<boolean> {
    if (!file.type.startsWith("image/") || !this.session.state) return false;
    await this.reference.read(file);
    this.studio.say("The picture lies under the paper. Pen and paper (beside the mirror) changes how strong it is.");
    return true;
  }

  key(event: KeyboardEvent): boolean {
    if (event.key === "Escape") {
      if (!this.start.element.hidden && this.session.state) this.start.hide();
      else this.cancel();
      return true;
    }
    const state = this.session.state;
    if (!state || !this.start.element.hidden) return false;
    const onButton = event.target instanceof HTMLButtonElement;
    if (event.key === " " && !onButton) {
      this.setPanning(true);
      return true;
    }
    if (state.mode === "refine" && this.turnByKey(event)) return true;
    const actions: Record<string, () => void> = {
      "1": () => this.setMode("draw"), "2": () => this.setMode("follow_up"), "3": () => this.setMode("refine"),
      "+": () => this.paper.zoom(1.25), "=": () => this.paper.zoom(1.25), "-": () => this.paper.zoom(0.8), "0": () => this.paper.fit(),
      m: () => { if (state.mode !== "refine") this.bars.flipMirror(); },
    };
    const act = actions[event.key.toLowerCase()];
    if (act) {
      act();
      return true;
    }
    const tool = toolsOf(state.mode, this.gestures).find((each) => each.key.toLowerCase() === event.key.toLowerCase());
    if (!tool) return false;
    this.setTool(tool.name);
    return true;
  }
  private turnByKey(event: KeyboardEvent): boolean {
    const turns: Record<string, View> = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] };
    const turn = turns[event.key];
    if (!turn) return false;
    this.lookFrom([this.view[0] + turn[0], this.view[1] + turn[1]]);
    return true;
  }
  private setPanning(on: boolean): void {
    this.paper.pointer.panning = on;
    this.paper.element.classList.toggle("panning", on);
  }

  // Sessions.
  private async showStart(): Promise<void> {
    await this.start.show(false);
    try {
      const vertices = await this.studio.api.shapeVertices({ base: "mean" });
      if (this.visible && !this.session.state && vertices) {
        this.studio.viewer.setVertices(vertices);
        this.studio.viewer.lookFrom("three-quarter");
      }
    } catch (error) {
      if (!isAbort(error)) this.studio.viewer.clear(kEmpty);
    }
  }
  private async create(options: { begin: string; name?: string; example?: string }): Promise<void> {
    try {
      this.bars.setBusy(true);
      await this.openState(await this.studio.api.createSession(options));
    } catch (error) {
      this.studio.fail(error);
    } finally {
      this.bars.setBusy(false);
    }
  }
  private async openSession(id: string): Promise<void> {
    try {
      await this.openState(await this.studio.api.session(id));
    } catch (error) {
      this.studio.fail(error);
    }
  }
  private async openState(state: SessionState): Promise<void> {
    this.session.close();
    this.pending.clear();
    this.vertices = null;
    this.view = [0, 0];
    this.start.hide();
    this.studio.viewer.lookFrom("front");
    this.chooseTool(state);
    await this.session.open(state);
    this.paper.fit();
    this.paper.element.focus({ preventScroll: true });
  }
  private sessionChanged(id: string, name: string | null): void {
    if (id !== this.session.id) return;
    const state = this.session.state;
    if (name !== null && state) {
      state.name = name;
      this.bars.update(state, this.tool);
      return;
    }
    this.session.close();
    this.studio.remember("session", "");
    this.studio.subject = null;
    void this.showStart();
  }
  private async rename(name: string): Promise<void> {
    const state = this.session.state;
    if (!state || name === "" || name === state.name) return;
    try {
      await this.studio.api.renameSession(state.id, name);
      this.sessionChanged(state.id, name);
      this.tellSubject(state);
    } catch (error) {
      this.studio.fail(error);
    }
  }
  private tellSubject(state: SessionState): void {
    this.studio.subject = state.has_face ? { kind: "session", title: state.name, body: { session: state.id } } : null;
  }

  // What arrives from the server.
  private modeShown: Mode | null = null;
  private showState(state: SessionState): void {
    this.studio.remember("session", state.id);
    if (this.visible) this.tellSubject(state);
    this.paper.setSheet(state.sheet);
    if (state.mode !== this.modeShown) this.chooseTool(state);
    const isNewMode = state.mode !== this.modeShown;
    this.modeShown = state.mode;
    if (isNewMode) this.ghosts = [];
    if (state.gesture) this.studio.say(`Understood: ${state.gesture}.`);
    else if (state.changed === false) this.studio.say("Nothing was there to change.");
    if (state.mode === "draw") this.mirrorAxis = state.sheet[0] / 2;
    else if (isNewMode) void this.fetchCamera();
    if (this.visible) this.studio.viewer.setHandles(state.mode === "refine" ? state.handles : []);
    this.refreshTools();
    this.paper.invalidate("all");
    this.studio.refresh();
  }
  private showVertices(vertices: Float32Array | null): void {
    this.vertices = vertices;
    if (!this.visible) return;
    if (vertices) this.studio.viewer.setVertices(vertices);
    else this.studio.viewer.clear(kEmpty);
    if (this.session.state?.mode === "refine") this.paper.invalidate("all");
  }
  private busyTimer = 0;
  private showWaiting(count: number): void {
    clearTimeout(this.busyTimer);
    if (count === 0) {
      this.pending.clear();
      this.bars.setBusy(false);
      this.paper.invalidate("ink");
    } else {
      this.busyTimer = window.setTimeout(() => this.bars.setBusy(true), 250);
    }
  }

  // Modes, tools, views.
  private setMode(mode: Mode): void {
    const state = this.session.state;
    if (!state || state.mode === mode) return;
    if (mode === "draw") {
      this.studio.say("A face that has left Draw comes back to it by undo: Ctrl+Z takes back one step.");
      return;
    }
    void this.session.send({ do: mode });
  }
  /** The tool that a person needs first in a mode. */
  private chooseTool(state: SessionState): void {
    if (state.mode === "draw") this.tool = "pen";
    else if (state.mode === "follow_up") this.tool = state.open_ends.length > 0 ? "pen" : "eraser";
    else this.tool = "brush";
    this.refreshTools();
  }
  private setTool(tool: ToolName): void {
    this.tool = tool;
    this.refreshTools();
  }
  private settingsChanged(): void {
    this.studio.remember("pen", this.settings);
    this.refreshTools(false);
    this.paper.invalidate("all");
  }
  private refreshTools(bars = true): void {
    const state = this.session.state;
    if (!state) return;
    if (bars) this.bars.update(state, this.tool);
    this.paper.element.style.cursor = cursorOf(this.tool);
    const radius = this.tool === "eraser" ? state.eraser_reach : this.tool === "brush" || this.tool === "unbrush" ? this.settings.brushRadius : 0;
    this.paper.setRing(radius);
  }
  private lookFrom(view: View): void {
    this.view = [((view[0] + 540) % 360) - 180, Math.min(85, Math.max(-85, view[1]))];
    void this.fetchCamera();
  }
  /** The sheet's view of the face; an older request is dropped. */
  private async fetchCamera(): Promise<void> {
    const state = this.session.state;
    if (!state || !state.has_face) return;
    this.cameraRequest?.abort();
    const control = new AbortController();
    this.cameraRequest = control;
    try {
      const view: View = state.mode === "refine" ? this.view : [0, 0];
      const camera = await this.studio.api.camera(state.id, view[0], view[1], control.signal);
      if (control.signal.aborted || this.session.id !== state.id) return;
      if (state.mode === "refine") {
        if (!this.face) {
          this.face = new SheetFace(this.studio.viewer, () => this.paper.invalidate("all"));
          this.paper.addFace(this.face.canvas);
        }
        this.face.setCamera(camera);
      } else {
        // The middle of the face has x = 0 cm.
        this.mirrorAxis = camera.pixel_from_cm[0][3] ?? state.sheet[0] / 2;
      }
      this.paper.invalidate("all");
    } catch (error) {
      this.studio.fail(error);
    }
  }

  // Strokes.
  private content(): PaperContent {
    const state = this.session.state;
    const mode = state?.mode;
    return {
      state,
      local: [...[...this.pending.values()].flat(), ...this.stroke],
      mirrorAxis: this.settings.mirror && mode !== "refine" ? this.mirrorAxis : null,
      reference: this.reference.content,
      ghosts: this.ghosts,
      pen: this.pen,
      faceBelow: mode === "refine" && this.face !== null,
    };
  }
  private hovered(at: Point | null): void {
    const needed = this.tool === "pen" && (this.session.state?.open_ends.length ?? 0) > 0;
    this.pen = at;
    if (needed) this.paper.invalidate("ink");
  }
  private begin(sample: Sample, event: PointerEvent): void {
    if (!this.session.state) return;
    const turns = this.session.state.mode === "refine" && (this.tool === "turn" || event.button === 2);
    if (turns) {
      this.turning = { x: event.clientX, y: event.clientY, view: this.view };
      return;
    }
    if (event.button !== 0 && event.button !== 5) return;
    this.path = [sample];
    this.updateStroke();
  }
  private extend(samples: Sample[], event: PointerEvent): void {
    if (this.turning) {
      const size = Math.min(...this.paper.view.size);
      this.lookFrom([this.turning.view[0] - (180 * (event.clientX - this.turning.x)) / size, this.turning.view[1] + (180 * (event.clientY - this.turning.y)) / size]);
      return;
    }
    if (this.path.length === 0) return;
    let grew = false;
    for (const sample of samples) grew = append(this.path, sample) || grew;
    const last = this.path[this.path.length - 1];
    if (last) this.pen = [last.x, last.y];
    if (!grew) return;
    this.updateStroke();
    if (this.tool === "pen" && this.session.state?.mode === "draw" && this.path.length > 4) this.session.preview(this.drawn());
  }
  /** The line as it will be, with the stabiliser. */
  private drawn(): Point[] {
    return stabilised(pointsOf(this.path), this.settings.stabiliser);
  }
  private updateStroke(): void {
    const state = this.session.state;
    if (!state) return;
    const points = pointsOf(this.path);
    const shown = (kind: LocalStroke["kind"], width: number, path = points): LocalStroke => ({ kind, points: path, width });
    switch (this.tool) {
      case "pen": {
        const line = shown("line", this.settings.weight, this.drawn());
        this.stroke = this.settings.mirror ? [line, { ...line, points: mirrored(line.points, this.mirrorAxis) }] : [line];
        break;
      }
      case "eraser": {
        const kind = state.mode === "draw" ? "erase" : "trail";
        this.stroke = [shown(kind, 2 * state.eraser_reach)];
        if (this.settings.mirror) this.stroke.push(shown(kind, 2 * state.eraser_reach, mirrored(points, this.mirrorAxis)));
        break;
      }
      case "brush": case "unbrush": this.stroke = [shown("trail", 2 * this.settings.brushRadius)]; break;
      case "translate": this.stroke = [shown("arrow", 0)]; break;
      case "region": this.stroke = [shown("loop", 0)]; break;
      default: this.stroke = [shown("line", 0)];
    }
    this.paper.invalidate("ink");
  }
  private cancel(): void {
    this.path = [];
    this.stroke = [];
    this.turning = null;
    this.session.stopPreview();
    this.paper.invalidate("ink");
  }
  private end(event: PointerEvent): void {
    const endedAt = performance.now();
    if (this.turning || this.path.length === 0) {
      this.turning = null;
      return;
    }
    const last = this.paper.toSheet(event.clientX, event.clientY);
    append(this.path, { ...last, pressure: this.path[this.path.length - 1]?.pressure ?? 1 });
    const made = this.eventOf(event.pointerType === "pen");
    const before = this.session.state?.mode === "follow_up" ? this.session.state.lines : [];
    const line = made?.do === "draw" && this.session.state?.mode === "draw" ? this.drawn() : null;
    const number = ++this.events;
    if (made) this.pending.set(number, this.stroke);
    this.path = [];
    this.stroke = [];
    this.paper.invalidate("ink");
    if (!made) {
      this.session.stopPreview();
      return;
    }
    void this.session.send(made, endedAt, line).then((state) => {
      this.pending.delete(number);
      if (state && made.do === "erase") this.ghosts.push(...removedParts(before.map((each) => each.points), state.lines.map((each) => each.points)));
      else this.ghosts = [];
      this.paper.invalidate("ink");
    });
  }
  private eventOf(isPen: boolean): SessionEvent | null {
    const points = pointsOf(this.path);
    const mirror = this.settings.mirror ? { mirror: true } : {};
    const view = { view: this.view };
    if (this.tool === "eraser") return { do: "erase", points, ...mirror };
    if (this.tool === "brush" || this.tool === "unbrush") return { do: this.tool, points, radius: this.settings.brushRadius, ...view };
    if (lengthOf(points) < kLeastLength) return null;
    switch (this.tool) {
      case "pen": return {
        do: "draw", points, ...mirror,
        ...(this.settings.stabiliser > 0 ? { stabiliser: this.settings.stabiliser } : {}),
        ...(this.settings.weight > 0 ? { weight: this.settings.weight } : {}),
        ...(this.settings.weight > 0 && isPen ? { pressure: pressureOf(this.path) } : {}),
      };
      case "translate": case "pull": case "region": case "gesture": return { do: this.tool, points, ...view };
      default: return null;
    }
  }
}

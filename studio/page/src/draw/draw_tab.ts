// The tab Draw: a paper next to the 3-D face, in three modes.
import type { Mode, SessionState } from "../api_types";
import { el } from "../dom";
import type { Studio, Tab } from "../tab";
import { Paper } from "./paper";
import type { PaperContent } from "./paper_drawing";
import { type KeyHost, pressKey } from "./draw_keys";
import { takePicture } from "./picture_drop";
import { ReferencePicture } from "./reference_picture";
import { SessionClient } from "./session_client";
import { clearHandles } from "./handles";
import { remarkShape } from "./shape_remark";
import { SheetTurn } from "./sheet_turn";
import { kNoFaceYet, SessionDesk } from "./session_desk";
import { PenInput } from "./pen_input";
import { kFirstSettings, ToolBars, type PenSettings } from "./tool_bars";
import { cursorOf, firstTool, gestureWords, usesHandles, type ToolName } from "./tools";

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
  private readonly keys = this.makeKeys();
  private readonly desk: SessionDesk;
  private readonly reference: ReferencePicture;
  private readonly settings: PenSettings;
  private readonly file = el("input", { type: "file", accept: "image/*", hidden: true, "aria-label": "Picture under the paper" });
  private tool: ToolName = "pen";
  private readonly turn: SheetTurn;
  private readonly pen: PenInput;
  private vertices: Float32Array | null = null;
  private visible = false;
  private gestures = false;

  constructor(private readonly studio: Studio) {
    this.settings = { ...kFirstSettings, ...studio.recall<Partial<PenSettings>>("pen", {}) };
    this.session = new SessionClient(studio.api, {
      state: (state) => this.showState(state),
      vertices: (vertices) => this.showVertices(vertices),
      waiting: (count) => this.showWaiting(count),
      fail: (error) => studio.fail(error),
    });
    this.reference = new ReferencePicture(() => this.paper.invalidate("all"));
    this.paper = new Paper({
      content: () => this.content(),
      face: () => this.turn.face,
      hovered: (at) => this.pen.hovered(at),
      begin: (sample, event) => this.pen.begin(sample, event),
      extend: (samples, event) => this.pen.extend(samples, event),
      end: (event) => this.pen.end(event),
      cancel: () => this.pen.cancel(),
    });
    const tab = this;
    this.turn = new SheetTurn({
      api: studio.api,
      viewer: studio.viewer,
      paper: this.paper,
      get state() {
        return tab.session.state;
      },
      turned: (yaw) => this.bars.setYaw(yaw),
      fail: (error) => studio.fail(error),
    });
    this.pen = this.makePen();
    this.bars = this.makeBars();
    this.desk = new SessionDesk({
      studio,
      session: this.session,
      get visible() {
        return tab.visible;
      },
      cleared: () => this.clear(),
      opened: () => this.paper.element.focus({ preventScroll: true }),
      renamed: (state) => {
        this.bars.update(state, this.tool, this.pen.sender.ghosts.length > 0);
        this.publishSubject(state);
      },
      busy: (is) => this.bars.setBusy(is),
      starting: (is) => this.element.classList.toggle("starting", is),
    });
    this.file.addEventListener("change", () => {
      const chosen = this.file.files?.[0];
      if (chosen) this.reference.read(chosen).catch((error) => studio.fail(error));
      this.file.value = "";
    });
    this.element = el(
      "div",
      { class: "draw" },
      this.bars.top,
      this.bars.rail,
      this.paper.element,
      this.bars.float,
      this.bars.bottom,
      this.desk.start.element,
      this.file,
    );
    this.desk.start.hide();
    addEventListener("keyup", (event) => {
      if (event.key === " ") this.setPanning(false);
    });
    addEventListener("blur", () => this.setPanning(false));
    studio.api.info().then(
      (info) => {
        this.gestures = info.can.gestures;
        if (this.session.state) this.refreshTools();
      },
      (error) => studio.fail(error),
    );
  }

  private makePen(): PenInput {
    const { studio, session, paper, turn, settings } = this;
    const tab = this;
    return new PenInput({
      studio,
      session,
      paper,
      turn,
      settings,
      get tool() {
        return tab.tool;
      },
      set tool(tool) {
        tab.tool = tool;
      },
      refreshTools: () => this.refreshTools(),
    });
  }
  private makeKeys(): KeyHost {
    const tab = this;
    return {
      get gestures() {
        return tab.gestures;
      },
      setMode: (mode) => this.setMode(mode),
      setTool: (tool) => this.setTool(tool),
      setPanning: (on) => this.setPanning(on),
      zoom: (factor) => this.paper.zoom(factor),
      fit: () => this.turn.fit(),
      flipMirror: () => this.bars.flipMirror(),
      turn: (event) => this.turn.key(event),
    };
  }
  private makeBars(): ToolBars {
    const tab = this;
    return new ToolBars({
      settings: this.settings,
      get gestures() {
        return tab.gestures;
      },
      setMode: (mode) => this.setMode(mode),
      setTool: (tool) => this.setTool(tool),
      settingsChanged: () => this.settingsChanged(),
      look: (yaw) => this.turn.look([yaw, 0]),
      roll: (level) => void this.session.send({ do: "roll", level, view: this.turn.view }),
      clearHandles: () => void clearHandles(this.session),
      remark: (text) => this.studio.say(text, "warning"),
      menu: () => void this.desk.start.show(this.session.state !== null),
      rename: (name) => void this.desk.rename(name),
      zoom: (factor) => this.paper.zoom(factor),
      fit: () => this.turn.fit(),
      reference: {
        choose: () => this.file.click(),
        remove: () => this.reference.remove(),
        opacity: (value) => this.reference.setOpacity(value),
        get present() {
          return tab.reference.picture !== null;
        },
        get value() {
          return tab.reference.opacity;
        },
      },
    });
  }

  // Tab.
  async show(): Promise<void> {
    this.visible = true;
    const state = this.session.state;
    if (state) {
      this.publishSubject(state);
      this.showVertices(this.vertices);
      this.showHandles(state);
      return;
    }
    await this.desk.resume();
  }
  hide(): void {
    this.visible = false;
    this.studio.viewer.setRegion([]);
    this.studio.viewer.remark(null);
    this.pen.cancel();
  }
  undo(): void {
    if (this.session.state?.can_undo || this.pen.sender.isWaiting) void this.session.send({ do: "undo" }).then(() => this.forgetGhosts());
  }
  redo(): void {
    if (this.session.state?.can_redo) void this.session.send({ do: "redo" }).then(() => this.forgetGhosts());
  }
  private forgetGhosts(): void {
    this.pen.sender.ghosts = [];
    this.paper.invalidate("ink");
  }
  canUndo(): boolean {
    return this.session.state?.can_undo ?? false;
  }
  canRedo(): boolean {
    return this.session.state?.can_redo ?? false;
  }
  useFace(face: { id: string; name: string }): Promise<void> {
    return this.desk.create({ begin: face.id, name: `From ${face.name}` });
  }
  async drop(file: File): Promise<boolean> {
    return this.visible && takePicture(file, this.studio, this.desk, this.reference);
  }

  key(event: KeyboardEvent): boolean {
    if (event.key === "Escape") {
      if (!this.desk.start.element.hidden && this.session.state) this.desk.start.hide();
      else this.pen.cancel();
      return true;
    }
    const state = this.session.state;
    if (!state || !this.desk.start.element.hidden) return false;
    return pressKey(event, state, this.keys);
  }
  private setPanning(on: boolean): void {
    this.paper.pointer.panning = on;
    this.paper.element.classList.toggle("panning", on);
  }

  /** Another drawing comes. */
  private clear(): void {
    this.pen.sender.clear();
    this.reference.remove();
    this.vertices = null;
    this.turn.view = [0, 0];
    this.bars.setYaw(0);
    this.modeShown = null;
    this.paper.fit();
  }
  private publishSubject(state: SessionState): void {
    remarkShape(this.studio, state.id);
    this.studio.subject = state.has_face ? { kind: "session", title: state.name, body: { session: state.id } } : null;
  }

  // What arrives from the server.
  private modeShown: Mode | null = null;
  private showState(state: SessionState): void {
    this.studio.remember("session", state.id);
    if (this.visible) this.publishSubject(state);
    this.paper.setSheet(state.sheet);
    const isOther = state.mode !== this.modeShown;
    if (isOther) {
      this.pen.sender.ghosts = [];
      this.tool = firstTool(state);
      const before = this.modeShown;
      this.modeShown = state.mode;
      this.turn.modeChanged(state, before);
    }
    if (state.gesture) this.studio.say(gestureWords(state.gesture));
    else if (state.changed === false) this.studio.say("Nothing was there to change.");
    this.showHandles(state);
    this.refreshTools();
    this.paper.invalidate(isOther ? "all" : "ink");
    this.studio.refresh();
  }
  private showVertices(vertices: Float32Array | null): void {
    this.vertices = vertices;
    if (!this.visible) return;
    if (vertices) this.studio.viewer.setVertices(vertices);
    else this.studio.viewer.clear(kNoFaceYet);
    this.turn.verticesChanged();
  }
  private showHandles(state: SessionState): void {
    if (!this.visible) return;
    this.studio.viewer.setHandles(state.mode === "refine" && usesHandles(this.tool) ? state.handles : []);
    this.studio.viewer.setRegion(state.mode === "refine" ? state.region : []);
  }
  private busyTimer = 0;
  private showWaiting(count: number): void {
    clearTimeout(this.busyTimer);
    this.studio.viewer.hold(count > 0);
    if (count === 0) {
      this.pen.sender.clear();
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
      void this.desk.offerNew();
      return;
    }
    if (state.mode === "draw") this.desk.sayOfLines();
    void this.session.send({ do: mode });
  }
  private setTool(tool: ToolName): void {
    this.tool = tool;
    this.refreshTools();
    if (this.session.state) this.showHandles(this.session.state);
    this.paper.invalidate("all");
  }
  private settingsChanged(): void {
    this.studio.remember("pen", this.settings);
    this.refreshTools(false);
    this.paper.invalidate("all");
  }
  private refreshTools(bars = true): void {
    const state = this.session.state;
    if (!state) return;
    if (bars) this.bars.update(state, this.tool, this.pen.sender.ghosts.length > 0);
    this.paper.element.style.cursor = cursorOf(this.tool);
    if (this.tool === "brush" || this.tool === "unbrush") this.paper.setRing(this.settings.brushRadius, "screen");
    else this.paper.setRing(this.tool === "eraser" ? state.eraser_reach : 0, "sheet");
  }

  // Strokes.
  private content(): PaperContent {
    const state = this.session.state;
    const mode = state?.mode;
    return {
      state,
      local: this.pen.shown,
      mirrorAxis: this.settings.mirror && mode !== "refine" ? this.turn.mirrorAxis : null,
      reference: this.reference.content,
      ghosts: this.pen.sender.ghosts,
      pen: this.pen.place,
      faceBelow: mode === "refine" && this.turn.face !== null,
    };
  }
}

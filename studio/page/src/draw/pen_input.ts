// From pointers over the paper to events of the drawing: the stroke under the pen, its previews, and what follows when it ends.
import type { Point, SessionEvent, SessionState } from "../api_types";
import type { Studio } from "../tab";
import type { Paper } from "./paper";
import type { LocalStroke } from "./paper_drawing";
import type { SessionClient } from "./session_client";
import type { SheetTurn } from "./sheet_turn";
import { StrokeInput, type StrokeContext } from "./stroke_input";
import type { Sample } from "./stroke_path";
import { StrokeSender } from "./stroke_sender";
import type { PenSettings } from "./tool_bars";
import type { ToolName } from "./tools";

/** Samples of the pen from which on a preview is worth a request. */
const kFewSamples = 4;

export interface PenHost {
  readonly studio: Studio;
  readonly session: SessionClient;
  readonly paper: Paper;
  readonly turn: SheetTurn;
  readonly settings: PenSettings;
  tool: ToolName;
  refreshTools(): void;
}

export class PenInput {
  readonly sender: StrokeSender;
  /** The end of the pen, sheet pixels. */
  place: Point | null = null;
  private readonly stroke = new StrokeInput();

  constructor(private readonly host: PenHost) {
    this.sender = new StrokeSender(host.session);
  }

  /** Strokes that the server has not drawn yet. */
  get shown(): readonly LocalStroke[] {
    return [...this.sender.shown, ...this.stroke.shown];
  }
  hovered(at: Point | null): void {
    this.place = at;
    if (this.host.tool === "pen" && this.host.session.state?.open_ends.length) this.host.paper.invalidate("ink");
  }

  begin(sample: Sample, event: PointerEvent): void {
    const { session, turn, tool, paper, studio } = this.host;
    const { state } = session;
    if (!state) return;
    if (state.mode === "refine" && (tool === "turn" || event.button === 2)) {
      turn.beginDrag(event);
      return;
    }
    if (event.button !== 0) return;
    if (tool === "translate" && state.handles.length === 0) {
      studio.say("Paint handles with the brush (B) first. Then a drag moves them.");
      return;
    }
    this.stroke.begin(sample, this.context(state, event));
    paper.invalidate("ink");
  }
  extend(samples: Sample[], event: PointerEvent): void {
    const { session, turn, paper } = this.host;
    if (turn.turning) turn.moveDrag(event);
    const { state } = session;
    if (!state || !this.stroke.active) return;
    const context = this.context(state, event);
    const grew = this.stroke.extend(samples, context);
    this.place = this.stroke.end;
    if (!grew) return;
    paper.invalidate("ink");
    const preview = this.stroke.length > kFewSamples ? this.stroke.preview(context) : null;
    if (preview) session.preview(preview);
  }
  cancel(): void {
    this.stroke.cancel();
    this.host.turn.endDrag();
    this.host.session.dropPreview();
    this.host.paper.invalidate("ink");
  }
  end(event: PointerEvent): void {
    const endedAt = event.timeStamp;
    const { session, turn, paper } = this.host;
    turn.endDrag();
    const { state } = session;
    if (!state || !this.stroke.active) return;
    const context = this.context(state, event);
    this.stroke.extend([{ ...paper.toSheet(event.clientX, event.clientY), pressure: this.stroke.pressure }], context);
    const made = this.stroke.event(context);
    const line = state.mode === "draw" ? this.stroke.preview(context) : null;
    const { shown } = this.stroke;
    const isFirst = state.open_ends.length === 0 && this.sender.ghosts.length === 0;
    this.stroke.cancel();
    if (!made) session.dropPreview();
    else void this.sender.send(made, shown, endedAt, line).then((next) => this.sent(made, isFirst, next));
    paper.invalidate("ink");
  }

  private context(state: SessionState, event: PointerEvent): StrokeContext {
    const { tool, settings, paper, turn } = this.host;
    // A brush has its size on the screen: zoom makes it finer on the face.
    const brushRadius = settings.brushRadius / paper.view.zoom;
    return { state, tool, settings, brushRadius, mirrorAxis: turn.mirrorAxis, view: turn.view, isPen: event.pointerType === "pen" };
  }
  /** isFirst: no line of the face was erased before. Who takes the eraser again keeps it. */
  private sent(event: SessionEvent, isFirst: boolean, next: SessionState | null): void {
    const isOpened = event.do === "erase" && next?.mode === "follow_up" && (next.open_ends.length > 0 || this.sender.ghosts.length > 0);
    if (isFirst && isOpened && this.host.settings.penAfterEraser) this.host.tool = "pen";
    this.host.refreshTools();
    this.host.paper.invalidate("ink");
  }
}

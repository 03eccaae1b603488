// The stroke under the pen: what is shown of it at once, and the event that it becomes.
import type { Point, SessionEvent, SessionState, View } from "../api_types";
import type { LocalStroke } from "./paper_drawing";
import { append, lengthOf, mirrored, pointsOf, pressureOf, stabilised, widthsOf, type Sample } from "./stroke_path";
import type { PenSettings } from "./tool_bars";
import type { ToolName } from "./tools";

/** Sheet pixels: a shorter path of the pen is a slip, not a stroke. */
const kLeastLength = 2.5;
/** Share of the sheet's longer side that a line of full pressure is wide, where no weight is chosen: twice as wide as a thin line. */
const kPenWeight = 5 / 512;

export interface StrokeContext {
  readonly state: SessionState;
  readonly tool: ToolName;
  readonly settings: PenSettings;
  /** Sheet pixels. */
  readonly brushRadius: number;
  /** x of the mirror, sheet pixels. */
  readonly mirrorAxis: number;
  readonly view: View;
  /** The pointer is a pen, which has pressure. */
  readonly isPen: boolean;
}

export class StrokeInput {
  /** What the paper shows of the stroke. */
  shown: LocalStroke[] = [];
  private path: Sample[] = [];

  get active(): boolean {
    return this.path.length > 0;
  }
  get end(): Point | null {
    const last = this.path[this.path.length - 1];
    return last ? [last.x, last.y] : null;
  }
  /** Of the last sample: a pen that is lifted reports none. */
  get pressure(): number {
    return this.path[this.path.length - 1]?.pressure ?? 1;
  }
  get length(): number {
    return this.path.length;
  }

  begin(sample: Sample, context: StrokeContext): void {
    this.path = [sample];
    this.show(context);
  }
  /** False if the samples add nothing. */
  extend(samples: readonly Sample[], context: StrokeContext): boolean {
    let grew = false;
    for (const sample of samples) grew = append(this.path, sample) || grew;
    if (grew) this.show(context);
    return grew;
  }
  cancel(): void {
    this.path = [];
    this.shown = [];
  }
  /** The line as it will be, with the stabiliser. */
  private line(context: StrokeContext): Sample[] {
    return stabilised(this.path, context.settings.stabiliser);
  }
  /** What shows the face while the pen is down; null: it shows at the end of the stroke. */
  preview(context: StrokeContext): SessionEvent | null {
    const { mode } = context.state;
    if (mode === "draw" && context.tool === "pen") return { do: "draw", points: pointsOf(this.line(context)) };
    if (mode === "refine" && (context.tool === "translate" || context.tool === "pull")) return this.event(context);
    return null;
  }
  private weight({ settings, state, isPen }: StrokeContext): number {
    return settings.weight > 0 || !isPen || !settings.pressure ? settings.weight : kPenWeight * Math.max(...state.sheet);
  }

  private show(context: StrokeContext): void {
    const { state, settings, mirrorAxis } = context;
    const points = pointsOf(this.path);
    const withImage = (stroke: LocalStroke): LocalStroke[] =>
      settings.mirror ? [stroke, { ...stroke, points: mirrored(stroke.points, mirrorAxis) }] : [stroke];
    switch (context.tool) {
      case "pen":
        this.shown = withImage(this.shownLine(context));
        break;
      case "eraser":
        this.shown = withImage({ kind: state.mode === "draw" ? "erase" : "trail", points, width: 2 * state.eraser_reach });
        break;
      case "brush":
      case "unbrush":
        this.shown = [{ kind: "trail", points, width: 2 * context.brushRadius }];
        break;
      case "translate":
        this.shown = [{ kind: "arrow", points, width: 0 }];
        break;
      case "region":
        this.shown = [{ kind: "loop", points, width: 0 }];
        break;
      default:
        this.shown = [{ kind: "line", points, width: 0 }];
    }
  }

  private shownLine(context: StrokeContext): LocalStroke {
    const line = this.line(context);
    const width = this.weight(context);
    const hasPressure = context.isPen && context.settings.pressure;
    return { kind: "line", points: pointsOf(line), width, ...(hasPressure ? { widths: widthsOf(line, width) } : {}) };
  }

  /** Null: the stroke is too short to mean anything. */
  event(context: StrokeContext): SessionEvent | null {
    const { tool, settings, isPen } = context;
    const weight = this.weight(context);
    const points = pointsOf(this.path);
    const mirror = settings.mirror ? { mirror: true } : {};
    const view = { view: context.view };
    if (tool === "eraser") return { do: "erase", points, ...mirror };
    if (tool === "brush" || tool === "unbrush") return { do: tool, points, radius: context.brushRadius, ...view };
    if (lengthOf(points) < kLeastLength) return null;
    switch (tool) {
      case "pen":
        return {
          do: "draw",
          points,
          ...mirror,
          ...(settings.stabiliser > 0 ? { stabiliser: settings.stabiliser } : {}),
          ...(weight > 0 ? { weight } : {}),
          ...(isPen && settings.pressure ? { pressure: pressureOf(this.path) } : {}),
        };
      case "translate":
      case "pull":
      case "region":
      case "gesture":
        return { do: tool, points, ...view };
      default:
        return null;
    }
  }
}

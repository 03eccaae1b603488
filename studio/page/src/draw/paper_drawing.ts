// What is on the paper: reference picture, lines, gaps with their ends, the stroke that is being drawn.
import type { Point, SessionState } from "../api_types";
import type { PaperView } from "./paper_view";

/** The paper is light in both themes, so ink has one set of colours. */
const kInk = {
  stroke: "#23282d",
  curve: "#1f5a68",
  wrinkle: "#8a4b2a",
  gap: "#c2500b",
  guide: "#155e6366",
  trail: "#c2500b55",
  arrow: "#1d6fd6",
  ghost: "#c2500b38",
};
/** Width in sheet pixels of a line without a weight, at a sheet of 512. */
const kWidth = 2.6 / 512;

/** The stroke under the pen, or one that the server has not drawn yet. */
export interface LocalStroke {
  kind: "line" | "erase" | "trail" | "arrow" | "loop";
  points: Point[];
  width: number;
  /** Of each point, where the pen's pressure changes it. */
  widths?: readonly number[];
}

export interface PaperContent {
  state: SessionState | null;
  local: readonly LocalStroke[];
  mirrorAxis: number | null;
  reference: { picture: CanvasImageSource; width: number; height: number; opacity: number } | null;
  /** Lines that were erased and wait to be drawn again. */
  ghosts: readonly Point[][];
  /** The end of the pen, where gaps show what would snap. */
  pen: Point | null;
  /** The face is drawn below instead of lines. */
  faceBelow: boolean;
}

export function drawUnder(context: CanvasRenderingContext2D, view: PaperView, content: PaperContent): void {
  const [width, height] = view.sheet;
  // draw.css gives the canvas the paper's colour of the theme as the colour of its text.
  const paperColour = getComputedStyle(context.canvas).color;
  context.save();
  context.translate(view.x, view.y);
  context.scale(view.zoom, view.zoom);
  if (!content.faceBelow) {
    context.shadowColor = "#0000002e";
    context.shadowBlur = 14;
    context.shadowOffsetY = 3;
    context.fillStyle = paperColour;
    context.fillRect(0, 0, width, height);
    context.shadowColor = "transparent";
    const reference = content.reference;
    if (reference) {
      const scale = Math.min(width / reference.width, height / reference.height);
      context.globalAlpha = reference.opacity;
      context.drawImage(
        reference.picture,
        (width - scale * reference.width) / 2,
        (height - scale * reference.height) / 2,
        scale * reference.width,
        scale * reference.height,
      );
      context.globalAlpha = 1;
    }
  }
  if (content.mirrorAxis !== null) {
    context.strokeStyle = kInk.guide;
    context.lineWidth = 1.5 / view.zoom;
    context.setLineDash([7 / view.zoom, 6 / view.zoom]);
    context.beginPath();
    context.moveTo(content.mirrorAxis, 0);
    context.lineTo(content.mirrorAxis, height);
    context.stroke();
  }
  context.restore();
}

export function drawInk(context: CanvasRenderingContext2D, view: PaperView, content: PaperContent): void {
  context.save();
  context.translate(view.x, view.y);
  context.scale(view.zoom, view.zoom);
  context.lineCap = "round";
  context.lineJoin = "round";
  const thin = kWidth * Math.max(...view.sheet);
  if (!content.faceBelow) {
    context.strokeStyle = kInk.ghost;
    context.lineWidth = thin;
    for (const ghost of content.ghosts) path(context, ghost);
    for (const line of content.state?.lines ?? []) {
      context.strokeStyle = kInk[line.kind];
      inkLine(context, line, thin);
    }
    if (content.state?.mode === "follow_up") gaps(context, view, content);
  }
  for (const stroke of content.local) local(context, view, stroke, thin, content.faceBelow);
  context.restore();
}

function path(context: CanvasRenderingContext2D, points: readonly Point[]): void {
  const first = points[0];
  if (!first) return;
  context.beginPath();
  context.moveTo(first[0], first[1]);
  if (points.length === 1) context.lineTo(first[0], first[1]);
  for (let i = 1; i < points.length; ++i) {
    const point = points[i];
    if (point) context.lineTo(point[0], point[1]);
  }
  context.stroke();
}

/** A line of one width, or of the widths of its points. */
function inkLine(context: CanvasRenderingContext2D, line: { points: readonly Point[]; width: number; widths?: readonly number[] }, thin: number): void {
  const widthAt = (i: number) => line.widths?.[i] || thin;
  context.lineWidth = line.width > 0 ? line.width : thin;
  if (!line.widths || line.points.length < 2) {
    path(context, line.points);
    return;
  }
  for (let i = 1; i < line.points.length; ++i) {
    const from = line.points[i - 1];
    const to = line.points[i];
    if (!from || !to) continue;
    context.lineWidth = (widthAt(i - 1) + widthAt(i)) / 2;
    path(context, [from, to]);
  }
}

function gaps(context: CanvasRenderingContext2D, view: PaperView, content: PaperContent): void {
  const reach = content.state?.snap_reach ?? 0;
  for (const ends of content.state?.open_ends ?? []) {
    context.strokeStyle = kInk.gap;
    context.lineWidth = 1.5 / view.zoom;
    context.setLineDash([4 / view.zoom, 5 / view.zoom]);
    path(context, ends);
    context.setLineDash([]);
    const stroke = content.local.find((each) => each.kind === "line")?.points[0] ?? null;
    for (const end of ends) {
      const near = [content.pen, stroke].some((place) => place && distance(place, end) <= reach);
      context.beginPath();
      context.arc(end[0], end[1], (near ? 3.5 : 2.5) / view.zoom, 0, 7);
      context.fillStyle = near ? kInk.gap : "#fffefb";
      context.fill();
      context.lineWidth = 1.5 / view.zoom;
      context.stroke();
    }
    snapLines(context, view, ends, reach, stroke, content.pen);
  }
}
/** Thin lines from the stroke's ends to those of the gap that they would snap to. */
function snapLines(
  context: CanvasRenderingContext2D,
  view: PaperView,
  ends: readonly [Point, Point],
  reach: number,
  begin: Point | null,
  pen: Point | null,
): void {
  if (!begin || !pen) return;
  const straight = distance(begin, ends[0]) + distance(pen, ends[1]) <= distance(begin, ends[1]) + distance(pen, ends[0]);
  const pairs: [Point, Point][] = straight
    ? [
        [begin, ends[0]],
        [pen, ends[1]],
      ]
    : [
        [begin, ends[1]],
        [pen, ends[0]],
      ];
  context.lineWidth = 1.2 / view.zoom;
  context.setLineDash([2 / view.zoom, 4 / view.zoom]);
  for (const [from, to] of pairs) if (distance(from, to) <= reach) path(context, [from, to]);
  context.setLineDash([]);
}

function local(context: CanvasRenderingContext2D, view: PaperView, stroke: LocalStroke, thin: number, faceBelow: boolean): void {
  context.lineWidth = stroke.width > 0 ? stroke.width : thin;
  if (stroke.kind === "erase") {
    context.globalCompositeOperation = "destination-out";
    context.strokeStyle = "#000";
    path(context, stroke.points);
    context.globalCompositeOperation = "source-over";
    return;
  }
  if (stroke.kind === "trail") context.strokeStyle = kInk.trail;
  else if (stroke.kind === "line" && !faceBelow) context.strokeStyle = kInk.stroke;
  else context.strokeStyle = kInk.arrow;
  if (stroke.kind === "arrow") {
    arrow(context, view, stroke.points);
    return;
  }
  if (stroke.kind === "loop") context.setLineDash([7 / view.zoom, 5 / view.zoom]);
  inkLine(context, stroke, thin);
  context.setLineDash([]);
}
function arrow(context: CanvasRenderingContext2D, view: PaperView, points: readonly Point[]): void {
  const from = points[0];
  const to = points[points.length - 1];
  if (!from || !to) return;
  context.lineWidth = 3 / view.zoom;
  path(context, [from, to]);
  const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const wing = (turn: number): Point => [
    to[0] - (12 / view.zoom) * Math.cos(angle + turn),
    to[1] - (12 / view.zoom) * Math.sin(angle + turn),
  ];
  path(context, [wing(0.5), to, wing(-0.5)]);
}

function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

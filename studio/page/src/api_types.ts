// Values that the server's API exchanges, as JSON.

export type Point = [number, number];
export type Colour = [number, number, number];

export interface Info {
  version: string;
  /** What the page is for; absent: the studio. */
  mode?: "studio" | "collect" | "study";
  can: { gestures: boolean; portraits: boolean; caricature: boolean };
  sheet: [number, number];
}

/** The head that is shown: one topology for all faces. Groups count triangles; lengths in cm; colours 0..255, sRGB. */
export interface Head {
  num_vertices: number;
  num_face_vertices: number;
  num_triangles: number;
  groups: { material: string; colour: Colour; gloss: number; first: number; count: number }[];
  centre: [number, number, number];
  half_height: number;
}

export type Mode = "draw" | "follow_up" | "refine";

export interface Line {
  kind: "stroke" | "curve" | "wrinkle";
  points: Point[];
  /** The greatest, pixels of the sheet; 0: as thin as lines are. */
  width: number;
  /** Of each point, where a pen drew with pressure. */
  widths?: number[];
}

export interface SessionState {
  id: string;
  name: string;
  revision: number;
  mode: Mode;
  sheet: [number, number];
  has_face: boolean;
  lines: Line[];
  open_ends: [Point, Point][];
  snap_reach: number;
  eraser_reach: number;
  handles: number[];
  region: number[];
  warnings: string[];
  /** In mode draw, what of "outline", "right eye", "left eye", "brows", "nose", "mouth", "ears" the lines show. */
  drawn_parts: string[];
  can_undo: boolean;
  can_redo: boolean;
  milliseconds: number;
  gesture?: string;
  changed?: boolean;
}

export interface SessionEntry {
  id: string;
  name: string;
  events: number;
  changed: number;
}

export interface Example {
  name: string;
  title: string;
}

export type View = [number, number];

export type SessionEvent =
  | { do: "draw"; points: Point[]; mirror?: boolean; stabiliser?: number; weight?: number; pressure?: number[] }
  | { do: "erase"; points: Point[]; mirror?: boolean }
  | { do: "follow_up" }
  | { do: "refine" }
  | { do: "undo" }
  | { do: "redo" }
  | { do: "region" | "translate" | "pull" | "gesture"; points: Point[]; view?: View }
  | { do: "brush" | "unbrush"; points: Point[]; radius: number; view?: View }
  | { do: "roll"; level: number; view?: View };

/** Rows give sheet pixel x, y and depth in cm of a point (x, y, z, 1) in cm. */
export interface SheetCamera {
  pixel_from_cm: [number[], number[], number[]];
}

export interface Face {
  id: string;
  name: string;
  shape?: Shape | null;
}

export interface Shape {
  base: string;
  toward?: { face: string; share: number };
  controls?: Record<string, number>;
  exaggeration?: number;
  caricature?: number;
  handles?: { vertex: number; move: [number, number, number] }[];
  expressions?: Record<string, number>;
  gains?: Record<string, number>;
}

export interface ShapeInfo {
  controls: { name: string; title: string; group: string; sides: 1 | 2; least: number; greatest: number }[];
  expressions: string[];
  expression_groups: Record<string, string[]>;
  caricature: [number, number];
  exaggeration: [number, number];
  labels: unknown[];
}

export interface Upload {
  id: string;
  name: string;
  kind: "picture" | "drawing" | "mesh" | "clip" | "session" | "other";
  looks_like: "portrait" | "drawing" | null;
}

export interface Job {
  id: string;
  do: string;
  state: "queued" | "running" | "done" | "failed" | "cancelled";
  seconds: number;
  progress: string;
  command: string;
  /** What the command does not do, or why there is none. */
  note: string;
  error?: string;
  warnings: string[];
  files: { name: string; size: number }[];
  result?: Record<string, unknown>;
}

// What the tabs of the page share: the server, the 3-D view, the tray of faces and messages.
import type { Api } from "./api";
import type { Viewer } from "./viewer";

/** One of Draw, Shape, Avatar, Take away. A tab owns its element, the panel next to the 3-D view, while it is shown. */
export interface Tab {
  readonly id: "draw" | "shape" | "avatar" | "take-away";
  readonly title: string;
  readonly element: HTMLElement;
  /** The 3-D view is this tab's from now on. */
  show(): void | Promise<void>;
  hide(): void;
  undo?(): void;
  redo?(): void;
  /** Whether the undo and redo buttons are enabled; call studio.refresh() when it changes. Absent: as long as undo and redo exist. */
  canUndo?(): boolean;
  canRedo?(): boolean;
  /** A key that no field had; true if the tab used it. */
  key?(event: KeyboardEvent): boolean;
  /** A file dropped anywhere on the page while this tab is shown; true if it was taken. */
  drop?(file: File): Promise<boolean>;
  /** A person chose a face of the tray. Absent: the tray offers no choice while this tab is shown. */
  useFace?(face: { id: string; name: string }): void | Promise<void>;
  /** A sentence why what this tab shows cannot be pinned; null or absent: the subject can. */
  whyNoPin?(): string | null;
  /** What useFace does, as the label of a face in the tray: "Begin with". */
  readonly useFaceLabel?: string;
}

/** What is edited now: a drawing session, a pinned face, or a shape document. */
export interface Subject {
  kind: "session" | "face" | "shape";
  title: string;
  /** As bodies of POST /api/jobs and /api/faces name it: {session: ID}, {face: ID} or {shape: SHAPE}. */
  body: { session: string } | { face: string } | { shape: unknown };
}

export interface Studio {
  readonly api: Api;
  readonly viewer: Viewer;
  /** Changes of the tray: pins the subject, or a face was added by a job. */
  readonly faces: FaceTray;
  say(message: string, kind?: "info" | "warning" | "error"): void;
  /** Says what went wrong, in the words of the server; an aborted request is no error. */
  fail(error: unknown): void;
  open(tab: Tab["id"]): void;
  /** The last thing a person worked on; Take away and Shape begin with it. */
  subject: Subject | null;
  /** Reads and writes what survives a reload (localStorage under one key, JSON). */
  remember(key: string, value: unknown): void;
  recall<T>(key: string, otherwise: T): T;
  /** Updates the undo and redo buttons. */
  refresh(): void;
}

export interface FaceTray {
  readonly faces: readonly { id: string; name: string; shape?: unknown }[];
  refresh(): Promise<void>;
  onChange(listener: () => void): void;
}

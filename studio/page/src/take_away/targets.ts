// What can be taken away: a drawing, a pinned face, the shape, the last avatar; and which files each of them can become.
import type { Shape } from "../api_types";
import { avatarBody, avatarKey, type AvatarState } from "../avatar/state";

export type Target =
  | { kind: "session"; id: string; title: string; changed: number }
  | { kind: "face"; id: string; title: string }
  | { kind: "shape"; shape: Shape; title: string }
  | { kind: "avatar"; state: AvatarState; title: string };

export type FormatId = "glb" | "obj" | "vrm" | "stl" | "turntable" | "session";

/** The same target after a reload. */
export function targetKey(target: Target): string {
  if (target.kind === "avatar") return avatarKey(target.state);
  return target.kind === "shape" ? "shape" : target.id;
}

/** A sentence why a target cannot become a format; null if it can. */
export function whyNot(target: Target, format: FormatId): string | null {
  return format === "session" && target.kind !== "session" ? "A recording belongs to a drawing. Choose a drawing above." : null;
}

/** The part of a job's body that names what is made into a file. */
export function targetBody(target: Target): Record<string, unknown> {
  if (target.kind === "avatar") {
    const { do: _, ...avatar } = avatarBody(target.state);
    return { avatar };
  }
  if (target.kind === "shape") return { shape: target.shape };
  return target.kind === "session" ? { session: target.id } : { face: target.id };
}

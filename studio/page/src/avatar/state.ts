// What the tab Avatar works on. It survives a reload; Take away begins with the last avatar.
import type { Point } from "../api_types";

export interface AvatarOptions {
  style: "none" | "toon";
  caricature: number;
  hair: string;
}

export type AvatarSource = { kind: "upload"; id: string; name: string; as: "portrait" | "drawing" } | { kind: "session"; id: string; name: string };

export interface AvatarState {
  source: AvatarSource;
  options: AvatarOptions;
  /** The landmarks that the network found, and where they are now; null: none were searched or found. */
  found: Point[] | null;
  landmarks: Point[] | null;
  /** The last job that made a head, and the body that it had. */
  job: string | null;
  made: string | null;
}

export const kAvatarKey = "avatar.state";
/** Heads of earlier pictures, newest first. */
export const kAvatarHeadsKey = "avatar.heads";
export const kMostHeads = 8;
/** The subject of the page when the last avatar was made: while it stays, the avatar is the last thing a person worked on. */
export const kAvatarSubjectKey = "avatar.subject";
/** The key of a target that Take away is opened for. */
export const kWantedKey = "take-away.wanted";
export const kNoPinOfAvatar = "A head of Avatar is not pinned, for a pinned face has no picture. It is kept in the list of Take away.";
export const kFirstOptions: AvatarOptions = { style: "none", caricature: 0, hair: "auto" };

export interface AvatarBody {
  do: "avatar";
  upload?: string;
  session?: string;
  options: Record<string, unknown>;
  landmarks?: Point[];
}

/** A portrait has landmarks and a texture of its own; a drawing has neither. */
export function isPortrait(source: AvatarSource): boolean {
  return source.kind === "upload" && source.as === "portrait";
}

/** The body of POST /api/jobs. Landmarks are sent only where a person moved one. */
export function avatarBody(state: AvatarState): AvatarBody {
  const { source, options, landmarks, found } = state;
  const portrait = isPortrait(source);
  const hair = options.hair === "auto" && !portrait ? "none" : options.hair;
  const body: AvatarBody = { do: "avatar", options: { hair } };
  if (source.kind === "session") {
    body.session = source.id;
  } else {
    body.upload = source.id;
    body.options["as"] = source.as;
  }
  if (portrait) {
    body.options["style"] = options.style;
    if (landmarks && JSON.stringify(landmarks) !== JSON.stringify(found)) body.landmarks = landmarks;
  }
  if (options.caricature > 0) body.options["caricature"] = options.caricature;
  return body;
}

/** Names the head of a state among what can be taken away. */
export function avatarKey(state: AvatarState): string {
  return `avatar ${state.job ?? ""}`;
}

// Clips: weights over time of a CSV of Live Link Face, a CSV of weights, or a JSON file of MediaPipe's FaceLandmarker.
import { plainName, type Weights } from "../expressions";

export interface Clip {
  kind: "Live Link Face" | "MediaPipe" | "table of weights";
  /** Seconds from the first frame, ascending; one a frame. */
  times: number[];
  frames: Weights[];
  /** Sentences about what was ignored or changed. */
  notes: string[];
}

/** Reads a clip. @throws Error with a sentence that names the file and the line. */
export function parseClip(fileName: string, text: string, names: readonly string[]): Clip {
  const body = text.replace(/^\uFEFF/, "").trim();
  if (!body) throw new Error(`${fileName} is empty. A clip is a CSV of Live Link Face or a JSON file of MediaPipe.`);
  const first = body[0];
  return first === "{" || first === "[" ? parseJson(fileName, body, names) : parseTable(fileName, body, names);
}

/** The weights at a time, linearly between frames; the ends are held. */
export function weightsAt(clip: Clip, seconds: number): Weights {
  const last = clip.times.length - 1;
  let low = 0;
  let high = last;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((clip.times[middle] ?? 0) <= seconds) low = middle;
    else high = middle - 1;
  }
  const a = clip.frames[low] ?? {};
  const b = clip.frames[Math.min(low + 1, last)] ?? a;
  const begin = clip.times[low] ?? 0;
  const length = (clip.times[low + 1] ?? begin) - begin;
  const share = length > 0 ? Math.min(1, Math.max(0, (seconds - begin) / length)) : 0;
  const result: Weights = {};
  for (const name of new Set([...Object.keys(a), ...Object.keys(b)])) {
    result[name] = (1 - share) * (a[name] ?? 0) + share * (b[name] ?? 0);
  }
  return result;
}

export function clipSeconds(clip: Clip): number {
  return clip.times.at(-1) ?? 0;
}

const kTurns = new Set(["head", "lefteye", "righteye"].flatMap((part) => ["yaw", "pitch", "roll"].map((turn) => part + turn)));
const kTimes = new Set(["timecode", "time", "t", "timestamp", "timestampms", "timems", "blendshapecount"]);

function parseTable(fileName: string, body: string, names: readonly string[]): Clip {
  const lines = body.split(/\r?\n/);
  const separator = [",", ";", "\t"].find((each) => lines[0]?.includes(each)) ?? ",";
  const header = (lines[0] ?? "").split(separator).map((cell) => cell.trim().replace(/^"|"$/g, ""));
  const known = new Map(names.map((name) => [plainName(name), name]));
  const columns = header.map((cell) => known.get(plainName(cell)));
  if (!columns.some(Boolean)) {
    throw new Error(`${fileName}: line 1 names no expression (expected Timecode,BlendshapeCount,EyeBlinkLeft,...).`);
  }
  const timecode = header.findIndex((cell) => plainName(cell) === "timecode");
  const time = header.findIndex((cell) => kTimes.has(plainName(cell)) && !/^(timecode|blendshapecount)$/.test(plainName(cell)));
  const notes = unknownNote(header.filter((cell, at) => cell && !columns[at] && !kTurns.has(plainName(cell)) && !kTimes.has(plainName(cell))));
  if (header.some((cell) => plainName(cell) === "headyaw")) notes.push("Turns of the head are not shown here; a .glb with this clip has them.");

  const frames: Weights[] = [];
  const stamps: string[] = [];
  let clamped = false;
  lines.slice(1).forEach((line, index) => {
    if (!line.trim()) return;
    const where = `${fileName}, line ${index + 2}`;
    const cells = line.split(separator);
    if (cells.length < header.length) throw new Error(`${where}: ${cells.length} cells (expected ${header.length}).`);
    const frame: Weights = {};
    columns.forEach((name, at) => {
      if (!name) return;
      const value = Number(cells[at]);
      if (!cells[at]?.trim() || !Number.isFinite(value)) throw new Error(`${where}: “${cells[at]}” of ${header[at]} is no number.`);
      clamped ||= value < 0 || value > 1;
      frame[name] = Math.min(1, Math.max(0, value));
    });
    frames.push(frame);
    stamps.push(cells[timecode >= 0 ? timecode : time]?.trim() ?? "");
  });
  if (!frames.length) throw new Error(`${fileName} has a header and no frame.`);
  if (clamped) notes.push("Weights beyond 0 to 1 are clamped.");
  const times =
    timecode >= 0 ? timecodeSeconds(fileName, stamps) : time >= 0 ? inSeconds(fileName, stamps.map(Number)) : everyFrame(frames.length, 60);
  return { kind: timecode >= 0 ? "Live Link Face" : "table of weights", times, frames, notes };
}

/** HH:MM:SS:FF.mmm; the largest FF gives the frames a second, 60 if no second passes. */
function timecodeSeconds(fileName: string, stamps: string[]): number[] {
  const parts = stamps.map((stamp, index) => {
    const match = /^(\d+):(\d+):(\d+)[:;](\d+(?:\.\d+)?)$/.exec(stamp);
    if (!match) throw new Error(`${fileName}, line ${index + 2}: “${stamp}” is no time code (expected HH:MM:SS:FF.mmm).`);
    const [hours = 0, minutes = 0, seconds = 0, frame = 0] = match.slice(1).map(Number);
    return { second: 3600 * hours + 60 * minutes + seconds, frame };
  });
  const passes = parts.some((each) => each.second !== parts[0]?.second);
  const rate = passes ? Math.floor(Math.max(...parts.map((each) => each.frame))) + 1 : 60;
  return ascending(fileName, parts.map((each) => each.second + each.frame / rate));
}

interface Category {
  categoryName: string;
  score: number;
}

function parseJson(fileName: string, body: string, names: readonly string[]): Clip {
  let value: unknown;
  try {
    value = JSON.parse(body);
  } catch (error) {
    const lines = body.split(/\r?\n/).filter((line) => line.trim());
    if (lines.length < 2) throw new Error(`${fileName} is no JSON: ${(error as Error).message}.`);
    value = lines.map((line, index) => {
      try {
        return JSON.parse(line) as unknown;
      } catch {
        throw new Error(`${fileName}, line ${index + 1}: no JSON. A clip is one JSON value, or one result a line.`);
      }
    });
  }
  const known = new Map(names.map((name) => [plainName(name), name]));
  const top = isRecord(value) ? value : {};
  const listKey = ["frames", "results", "data", "faceBlendshapes"].find((key) => Array.isArray(top[key]));
  const list: unknown[] = Array.isArray(value) ? (isCategories(value) ? [value] : value) : listKey && !isResult(top) ? (top[listKey] as unknown[]) : [value];

  const frames: Weights[] = [];
  const stamps: number[] = [];
  const unknown = new Set<string>();
  let without = 0;
  list.forEach((each, index) => {
    const scores = scoresOf(each);
    if (!scores) {
      without += 1;
      return;
    }
    const frame: Weights = {};
    for (const [key, score] of scores) {
      const name = known.get(plainName(key));
      if (!Number.isFinite(score)) throw new Error(`${fileName}, frame ${index + 1}: the score of ${key} is no number.`);
      if (name) frame[name] = Math.min(1, Math.max(0, score));
      else if (key !== "_neutral") unknown.add(key);
    }
    if (!Object.keys(frame).length) {
      without += 1;
      return;
    }
    frames.push(frame);
    stamps.push(stampOf(each, top, index));
  });
  if (!frames.length) {
    throw new Error(`${fileName} has no face with expressions (expected faceBlendshapes with categories, or {"jawOpen": 0.2}).`);
  }
  const notes = unknownNote([...unknown]);
  if (without) notes.push(`${without} of ${list.length} frames have no face and are skipped.`);
  const rate = typeof top["fps"] === "number" && top["fps"] > 0 ? top["fps"] : 30;
  const times = stamps.every(Number.isFinite) && frames.length > 1 ? inSeconds(fileName, stamps) : everyFrame(frames.length, rate);
  return { kind: "MediaPipe", times, frames, notes };
}

/** Names and scores of one result of MediaPipe, of a list of categories, or of {name: score}; null without a face. */
function scoresOf(value: unknown): [string, number][] | null {
  if (isCategories(value)) return value.map((each) => [each.categoryName, each.score]);
  if (Array.isArray(value)) return value.length ? scoresOf(value[0]) : null;
  if (!isRecord(value)) return null;
  const inner = value["faceBlendshapes"] ?? value["face_blendshapes"] ?? value["categories"] ?? value["blendshapes"] ?? value["weights"];
  if (inner !== undefined) return scoresOf(inner);
  const numbers = Object.entries(value).filter((entry): entry is [string, number] => typeof entry[1] === "number" && !kTimes.has(plainName(entry[0])));
  return numbers.length ? numbers : null;
}

function stampOf(value: unknown, top: Record<string, unknown>, index: number): number {
  const stamps = top["timestamps"];
  if (Array.isArray(stamps)) return Number(stamps[index]);
  if (!isRecord(value)) return NaN;
  const stamp = value["timestamp"] ?? value["timestampMs"] ?? value["time"] ?? value["t"];
  return typeof stamp === "number" ? stamp : NaN;
}

function isResult(value: Record<string, unknown>): boolean {
  const shapes = value["faceBlendshapes"];
  return Array.isArray(shapes) && (shapes.length === 0 || isCategories((shapes[0] as { categories?: unknown } | null)?.categories) || isCategories(shapes)) && shapes.length < 2;
}
function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
function isCategories(value: unknown): value is Category[] {
  return Array.isArray(value) && value.length > 0 && value.every((each) => isRecord(each) && typeof each["categoryName"] === "string" && typeof each["score"] === "number");
}

/** Seconds, milliseconds or microseconds become seconds, by the median step between frames. */
function inSeconds(fileName: string, stamps: number[]): number[] {
  const steps = stamps.slice(1).map((stamp, index) => stamp - (stamps[index] ?? 0)).sort((a, b) => a - b);
  const median = steps[steps.length >> 1] ?? 0;
  const unit = median > 2000 ? 1e6 : median > 2 ? 1000 : 1;
  return ascending(fileName, stamps.map((stamp) => stamp / unit));
}

function everyFrame(count: number, rate: number): number[] {
  return Array.from({ length: count }, (_, index) => index / rate);
}

function ascending(fileName: string, seconds: number[]): number[] {
  const begin = seconds[0] ?? 0;
  seconds.forEach((time, index) => {
    if (!Number.isFinite(time)) throw new Error(`${fileName}, frame ${index + 1}: its time is no number.`);
    if (time < (seconds[index - 1] ?? time)) throw new Error(`${fileName}, frame ${index + 1}: its time is before that of the frame above.`);
  });
  return seconds.map((time) => time - begin);
}

function unknownNote(unknown: string[]): string[] {
  if (!unknown.length) return [];
  const some = unknown.slice(0, 3).join(", ");
  return [`${unknown.length === 1 ? "One unknown column is" : `${unknown.length} unknown columns are`} ignored: ${some}${unknown.length > 3 ? ", ..." : ""}.`];
}

// The 52 expressions by Apple's names: titles, pairs, presets, spellings of other programs, limits of weights that are used together.

export type Weights = Record<string, number>;

/** "mouthSmileLeft" -> "mouth smile, left". */
export function expressionTitle(name: string): string {
  const side = /(Left|Right)$/.exec(name)?.[1];
  const stem = side && hasPair(name) ? name.slice(0, -side.length) : name;
  const words = stem.replace(/([A-Z])/g, " $1").toLowerCase().trim();
  return stem === name || !side ? words : `${words}, ${side.toLowerCase()}`;
}

// jawLeft, jawRight, mouthLeft and mouthRight are directions and no sides.
function hasPair(name: string): boolean {
  return !/^(jaw|mouth)(Left|Right)$/.test(name);
}

export interface ExpressionRow {
  title: string;
  /** One name, or those of the left and the right side. */
  names: [string] | [string, string];
}

/** The names as rows of a panel: the two sides of an expression are one row. */
export function expressionRows(names: readonly string[]): ExpressionRow[] {
  const all = new Set(names);
  const rows: ExpressionRow[] = [];
  for (const name of names) {
    const paired = hasPair(name);
    const left = name.replace(/Right$/, "Left");
    const right = name.replace(/Left$/, "Right");
    if (!paired || left === right || !all.has(left) || !all.has(right)) rows.push({ title: expressionTitle(name), names: [name] });
    else if (name === left) rows.push({ title: expressionTitle(name).replace(/, left$/, ""), names: [left, right] });
  }
  return rows;
}

/** A spelling that all programs share: "eyeBlink_L", "EyeBlinkLeft" and "eyeBlinkLeft" are "eyeblinkleft". */
export function plainName(name: string): string {
  return name.replace(/_L$/, "Left").replace(/_R$/, "Right").replace(/[^A-Za-z0-9]/g, "").toLowerCase();
}

/** Weights that a person plays by one press. */
export const kPresets: readonly { name: string; weights: Weights }[] = [
  { name: "Smile", weights: { mouthSmileLeft: 0.85, mouthSmileRight: 0.85, cheekSquintLeft: 0.4, cheekSquintRight: 0.4, eyeSquintLeft: 0.2, eyeSquintRight: 0.2 } },
  { name: "Surprise", weights: { browInnerUp: 0.9, browOuterUpLeft: 0.8, browOuterUpRight: 0.8, eyeWideLeft: 0.8, eyeWideRight: 0.8, jawOpen: 0.5, mouthFunnel: 0.25 } },
  { name: "Sad", weights: { browInnerUp: 0.8, mouthFrownLeft: 0.75, mouthFrownRight: 0.75, mouthShrugLower: 0.4, eyeSquintLeft: 0.2, eyeSquintRight: 0.2 } },
  { name: "Angry", weights: { browDownLeft: 1, browDownRight: 1, noseSneerLeft: 0.5, noseSneerRight: 0.5, eyeSquintLeft: 0.4, eyeSquintRight: 0.4, mouthPressLeft: 0.5, mouthPressRight: 0.5 } },
  { name: "Kiss", weights: { mouthPucker: 0.9, browInnerUp: 0.2 } },
  { name: "Wink", weights: { eyeBlinkLeft: 1, cheekSquintLeft: 0.6, mouthSmileLeft: 0.7, mouthSmileRight: 0.3 } },
];

/** Weights within what lids and lips allow together: closed lids just close, and a mouth closes no further than it is open. */
export function withinLimits(weights: Weights): Weights {
  const limited = { ...weights };
  const of = (name: string) => weights[name] ?? 0;
  for (const side of ["Left", "Right"]) {
    const most = 1 - 0.25 * of(`eyeSquint${side}`) - 0.35 * of(`eyeLookDown${side}`);
    if (of(`eyeBlink${side}`) > most) limited[`eyeBlink${side}`] = most;
  }
  const jaw = Math.min(of("jawOpen"), 1 - 0.3 * of("tongueOut"));
  if (of("jawOpen") > jaw) limited["jawOpen"] = jaw;
  if (of("mouthClose") > jaw) limited["mouthClose"] = jaw;
  return limited;
}

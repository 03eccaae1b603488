// Short clips that the page itself has: a blink, speech, a look around.
import type { Weights } from "../expressions";
import type { Clip } from "./clip";

type Key = [seconds: number, weights: Weights];

function clipOf(keys: Key[]): Clip {
  return { kind: "table of weights", times: keys.map(([seconds]) => seconds), frames: keys.map(([, weights]) => weights), notes: [] };
}
const blink = (weight: number): Weights => ({ eyeBlinkLeft: weight, eyeBlinkRight: weight });
const look = (aside: number, up: number): Weights => ({
  eyeLookOutLeft: Math.max(0, aside),
  eyeLookInRight: Math.max(0, aside),
  eyeLookInLeft: Math.max(0, -aside),
  eyeLookOutRight: Math.max(0, -aside),
  eyeLookUpLeft: Math.max(0, up),
  eyeLookUpRight: Math.max(0, up),
  eyeLookDownLeft: Math.max(0, -up),
  eyeLookDownRight: Math.max(0, -up),
});

/** Mouths of vowels and closed lips, in an order that looks like speech. */
const kMouths: Weights[] = [
  { jawOpen: 0.35, mouthLowerDownLeft: 0.2, mouthLowerDownRight: 0.2 },
  { mouthPressLeft: 0.5, mouthPressRight: 0.5 },
  { jawOpen: 0.2, mouthFunnel: 0.6 },
  { jawOpen: 0.15, mouthStretchLeft: 0.35, mouthStretchRight: 0.35, mouthUpperUpLeft: 0.2, mouthUpperUpRight: 0.2 },
  { jawOpen: 0.08, mouthPucker: 0.6 },
  { jawOpen: 0.45 },
  { mouthRollLower: 0.4, jawOpen: 0.05 },
];

export const kMotions: readonly { name: string; clip: Clip }[] = [
  { name: "Blink", clip: clipOf([[0, blink(0)], [0.12, blink(1)], [0.2, blink(1)], [0.4, blink(0)]]) },
  {
    name: "Talk",
    clip: clipOf([
      [0, {}],
      ...[0, 1, 2, 3, 5, 1, 4, 0, 6, 3, 2, 1, 5, 0].map((mouth, index): Key => [0.18 * (index + 1), kMouths[mouth] ?? {}]),
      [0.18 * 15, {}],
    ]),
  },
  {
    name: "Look around",
    clip: clipOf([[0, look(0, 0)], [0.4, look(0.9, 0)], [1, look(0.9, 0)], [1.5, look(-0.9, 0.1)], [2.1, look(-0.9, 0.1)], [2.6, look(0, 0.8)], [3.1, look(0, 0)]]),
  },
];

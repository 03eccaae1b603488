// Plays weights on a rigged head: expressions, clips, a live stream. Draws only while something moves.
import { Euler, type Mesh, type Object3D, Quaternion } from "three";
import { plainName, withinLimits, type Weights } from "../expressions";
import type { RiggedHead, Viewer } from "../viewer";
import { clipSeconds, weightsAt, type Clip } from "./clip";

/** Radians by which an eye turns at weight 1. */
const kEyeTurn = Math.PI / 6;

interface Eye {
  node: Object3D;
  rest: Quaternion;
  side: "Left" | "Right";
}

export class Player {
  private readonly names: Map<string, string>;
  private readonly eyes: Eye[];
  private frame = 0;

  constructor(private readonly viewer: Viewer, private readonly rig: RiggedHead) {
    this.names = new Map(rig.names.map((name) => [plainName(name), name]));
    this.eyes = (["Left", "Right"] as const).flatMap((side) => {
      const node = rig.object.getObjectByName(`${side}Eye`);
      return node && !turnsByTarget(node) ? [{ node, rest: node.quaternion.clone(), side }] : [];
    });
  }

  /** Which of these expressions the head has. */
  known(names: readonly string[]): string[] {
    return names.filter((name) => this.names.has(plainName(name)));
  }

  /** Weights by Apple's names, whatever the file calls them. */
  set(weights: Weights): void {
    const limited = withinLimits(weights);
    const own: Weights = {};
    for (const [name, weight] of Object.entries(limited)) {
      const target = this.names.get(plainName(name));
      if (target !== undefined) own[target] = weight;
    }
    this.rig.setWeights(own);
    const of = (name: string) => limited[name] ?? 0;
    for (const { node, rest, side } of this.eyes) {
      const out = of(`eyeLookOut${side}`) - of(`eyeLookIn${side}`);
      const down = of(`eyeLookDown${side}`) - of(`eyeLookUp${side}`);
      const yaw = side === "Left" ? out : -out;
      node.quaternion.copy(rest).multiply(new Quaternion().setFromEuler(new Euler(kEyeTurn * down, kEyeTurn * yaw, 0, "YXZ")));
    }
    this.viewer.invalidate();
  }

  /** Plays a clip from a time to its end. `tick` receives the seconds of each frame, and null at the end. */
  play(clip: Clip, from: number, tick: (seconds: number | null, weights: Weights) => void): void {
    this.stop();
    const begin = performance.now() - 1000 * from;
    const length = clipSeconds(clip);
    const next = () => {
      const seconds = Math.min(length, (performance.now() - begin) / 1000);
      const weights = weightsAt(clip, seconds);
      this.set(weights);
      const ended = seconds >= length;
      tick(ended ? null : seconds, weights);
      this.frame = ended ? 0 : requestAnimationFrame(next);
    };
    this.frame = requestAnimationFrame(next);
  }
  stop(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }
}

/** Eyes of Ready Player Me's names turn by their own targets. */
function turnsByTarget(node: Object3D): boolean {
  let found = false;
  node.traverse((each) => {
    const names = Object.keys((each as Mesh).morphTargetDictionary ?? {});
    found ||= names.some((name) => plainName(name).startsWith("eyelook"));
  });
  return found;
}

// A head of a .glb file: morph target weights by name, and its clips.
import { AnimationMixer, Box3, type AnimationClip, type Mesh, type Object3D, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

export class RiggedHead {
  private readonly meshes: Mesh[] = [];
  private readonly mixer: AnimationMixer;
  /** Names of the morph targets that any mesh has. */
  readonly names: string[];
  /** Centre and half height at rest, in the units of the file. */
  readonly frame: { centre: Vector3; halfHeight: number };

  constructor(
    readonly object: Object3D,
    readonly clips: readonly AnimationClip[],
    private readonly changed: () => void,
  ) {
    const names = new Set<string>();
    object.traverse((node) => {
      const mesh = node as Mesh;
      if (!mesh.isMesh) return;
      mesh.frustumCulled = false;
      if (!mesh.morphTargetDictionary) return;
      this.meshes.push(mesh);
      for (const name of Object.keys(mesh.morphTargetDictionary)) names.add(name);
    });
    this.names = [...names];
    this.mixer = new AnimationMixer(object);
    object.updateMatrixWorld(true);
    const box = new Box3().setFromObject(object, true);
    this.frame = { centre: box.getCenter(new Vector3()), halfHeight: Math.max(1e-3, box.getSize(new Vector3()).y / 2) };
  }

  /** Weights by name; a name that is absent is 0. */
  setWeights(weights: Readonly<Record<string, number>>): void {
    for (const mesh of this.meshes) {
      for (const [name, index] of Object.entries(mesh.morphTargetDictionary ?? {})) {
        if (mesh.morphTargetInfluences) mesh.morphTargetInfluences[index] = weights[name] ?? 0;
      }
    }
    this.changed();
  }

  /** The pose of a clip at a time in seconds. */
  pose(clip: AnimationClip, seconds: number): void {
    this.mixer.stopAllAction();
    this.mixer.clipAction(clip).play();
    this.mixer.setTime(seconds);
    this.changed();
  }
  rest(): void {
    this.mixer.stopAllAction();
    this.setWeights({});
  }
}

export async function readRiggedHead(bytes: ArrayBuffer, changed: () => void): Promise<RiggedHead> {
  const file = await new GLTFLoader().parseAsync(bytes, "");
  return new RiggedHead(file.scene, file.animations, changed);
}

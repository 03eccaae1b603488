// The display head as a three.js scene: one mesh of the server's groups, a rig of lights that follows the camera.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DynamicDrawUsage,
  Group,
  HemisphereLight,
  Mesh,
  MeshPhysicalMaterial,
  Scene,
  SRGBColorSpace,
  type Camera,
  type Object3D,
} from "three";
import type { Head } from "./api_types";
import { computeNormals } from "./vertex_normals";

export class HeadScene {
  readonly scene = new Scene();
  readonly geometry = new BufferGeometry();
  readonly mesh: Mesh;
  private readonly lights = new Group();
  private rigged: Object3D | null = null;

  constructor(
    readonly head: Head,
    private readonly triangles: Uint32Array,
  ) {
    const positions = new BufferAttribute(new Float32Array(3 * head.num_vertices), 3);
    positions.setUsage(DynamicDrawUsage);
    this.geometry.setAttribute("position", positions);
    this.geometry.setAttribute("normal", new BufferAttribute(new Float32Array(3 * head.num_vertices), 3).setUsage(DynamicDrawUsage));
    this.geometry.setIndex(new BufferAttribute(triangles, 1));
    const materials = head.groups.map((group, index) => {
      this.geometry.addGroup(3 * group.first, 3 * group.count, index);
      const [r, g, b] = group.colour;
      return new MeshPhysicalMaterial({
        color: new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace),
        roughness: 1 - 0.85 * Math.min(1, Math.max(0, group.gloss)),
        metalness: 0,
      });
    });
    this.mesh = new Mesh(this.geometry, materials);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    const light = (colour: number, intensity: number, x: number, y: number, z: number) => {
      const made = new DirectionalLight(colour, intensity);
      made.position.set(x, y, z);
      this.lights.add(made, made.target);
    };
    light(0xfff1e2, 2.3, -0.7, 0.75, 1);
    light(0xdfeaff, 0.75, 1, 0.1, 0.6);
    light(0xffffff, 0.9, 0.5, 0.8, -1);
    this.scene.add(this.mesh, this.lights, new HemisphereLight(0xf4f7ff, 0x9a877a, 1.1));
  }

  get positions(): Float32Array {
    return this.geometry.getAttribute("position").array as Float32Array;
  }
  get hasFace(): boolean {
    return this.mesh.visible;
  }
  get vertexCount(): number {
    return this.head.num_vertices;
  }

  setVertices(vertices: Float32Array): void {
    if (vertices.length !== this.positions.length)
      throw new Error(`The face has ${vertices.length / 3} vertices (expected ${this.head.num_vertices}).`);
    this.positions.set(vertices);
    this.geometry.getAttribute("position").needsUpdate = true;
    const normals = this.geometry.getAttribute("normal");
    computeNormals(this.positions, this.triangles, normals.array as Float32Array);
    normals.needsUpdate = true;
    this.geometry.boundingSphere = null;
    this.geometry.boundingBox = null;
    this.mesh.visible = this.rigged === null;
    this.filled = true;
  }
  private filled = false;

  clear(): void {
    this.filled = false;
    this.mesh.visible = false;
  }

  /** Shows another object in place of the display head; null: the display head again. */
  setRigged(object: Object3D | null): void {
    if (this.rigged) this.scene.remove(this.rigged);
    this.rigged = object;
    if (object) this.scene.add(object);
    this.mesh.visible = object === null && this.filled;
  }

  /** The lights move with the camera, so that every view is lit from the front. */
  lightFrom(camera: Camera): void {
    this.lights.quaternion.copy(camera.quaternion);
  }
}

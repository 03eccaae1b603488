// node three_portraits.mjs OUT COUNT: COUNT scenes of npm's three.js, a head of spheres, cones and rings in perspective, as
// OUT/NN.png with OUT/NN.txt. Known landmarks are points of the head, projected by the scene's camera: the ends of the brows
// (17, 21, 22, 26), the tip of the nose (30), the rims of the eyes (36-47), the ends of the mouth and its middle (48, 51, 54,
// 57).
import { mkdirSync } from 'node:fs';
import * as THREE from 'three';
import { render, seededRandom, writePortrait } from './shared.mjs';

/// As much of a DOM as SVGRenderer uses.
class Element {
  constructor(tag) {
    this.tag = tag;
    this.attributes = {};
    this.childNodes = [];
    this.style = {};
  }
  setAttribute(name, value) { this.attributes[name] = value; }
  appendChild(child) { this.childNodes.push(child); }
  removeChild(child) { this.childNodes.splice(this.childNodes.indexOf(child), 1); }
  toSvg() {
    const attributes = Object.entries(this.attributes).map(([name, value]) => ` ${name}="${value}"`).join('');
    const space = this.tag === 'svg' ? ' xmlns="http://www.w3.org/2000/svg"' : '';
    return `<${this.tag}${space}${attributes}>${this.childNodes.map((child) => child.toSvg()).join('')}</${this.tag}>`;
  }
}
globalThis.document = { createElementNS: (_, tag) => new Element(tag) };
const { SVGRenderer } = await import('three/addons/renderers/SVGRenderer.js');

const size = 512;
const skins = [0xf5d6c0, 0xe2b08c, 0xb9825a, 0x7c5136, 0x8fb98a, 0xc8a2c8];
const hairs = [0x2a1c14, 0x6b4423, 0xd8b45c, 0x8a8a8a, 0xb0442a];

/// A head that looks along +z, about 2 high, and its landmarks.
function makeHead(random) {
  const between = (low, high) => low + (high - low) * random();
  const pick = (list) => list[Math.floor(random() * list.length)];
  const head = new THREE.Group();
  const landmarks = {};
  const skin = new THREE.MeshLambertMaterial({ color: pick(skins) });
  const hair = new THREE.MeshLambertMaterial({ color: pick(hairs) });
  const add = (geometry, material, place, scale = [1, 1, 1]) => {
    const mesh = new THREE.Mesh(geometry, material);
    mesh.position.set(...place);
    mesh.scale.set(...scale);
    head.add(mesh);
    return mesh;
  };
  const radii = [between(0.72, 0.9), between(0.95, 1.15), 0.85];
  /// The depth of the surface of the skull.
  const depth = (x, y) => radii[2] * Math.sqrt(Math.max(0, 1 - (x / radii[0]) ** 2 - (y / radii[1]) ** 2));
  add(new THREE.SphereGeometry(1, 64, 48), skin, [0, 0, 0], radii);
  add(new THREE.SphereGeometry(1, 48, 24, 0, 2 * Math.PI, 0, 1.05), hair, [0, 0.08, -0.08], radii.map((radius) => 1.06 * radius));
  for (const side of [-1, 1]) add(new THREE.SphereGeometry(0.14, 16, 12), skin, [side * radii[0], 0.05, 0], [0.6, 1.2, 1]);

  const eyeX = between(0.27, 0.34), eyeY = between(0.08, 0.18), eyeRadius = between(0.1, 0.17);
  const white = new THREE.MeshLambertMaterial({ color: 0xffffff });
  const iris = new THREE.MeshBasicMaterial({ color: pick([0x2b1a10, 0x2d5a8a, 0x3c6e3c, 0x111111]) });
  const irisRadius = eyeRadius * between(0.45, 0.65), gaze = between(-0.25, 0.25) * eyeRadius;
  [-1, 1].forEach((side, eye) => {
    const centre = [side * eyeX, eyeY, depth(eyeX, eyeY)];
    add(new THREE.SphereGeometry(eyeRadius, 32, 24), white, centre, [1, 1, 0.5]);
    add(new THREE.SphereGeometry(irisRadius, 24, 16), iris, [centre[0] + gaze, centre[1], centre[2] + 0.45 * eyeRadius], [1, 1, 0.3]);
    // From the outer corner of the right eye on, and from the inner one of the left eye on, over the upper lid.
    [180, 120, 60, 0, -60, -120].forEach((degrees, k) => {
      const angle = (degrees * Math.PI) / 180;
      landmarks[36 + 6 * eye + k] = [centre[0] + eyeRadius * Math.cos(angle), centre[1] + eyeRadius * Math.sin(angle), centre[2]];
    });
  });

  const browY = eyeY + eyeRadius + between(0.07, 0.16), browHalf = between(0.12, 0.18), slope = between(-0.25, 0.25);
  [-1, 1].forEach((side, brow) => {
    const at = [side * eyeX, browY, depth(eyeX, browY) + 0.04];
    const mesh = add(new THREE.BoxGeometry(2 * browHalf, 0.06, 0.06, 8, 1, 1), hair, at);
    mesh.rotation.z = side * slope;
    [-1, 1].forEach((end, k) => {
      landmarks[(brow === 0 ? [17, 21] : [22, 26])[k]] =
        [at[0] + end * browHalf * Math.cos(side * slope), at[1] + end * browHalf * Math.sin(side * slope), at[2]];
    });
  });

  const noseLength = between(0.2, 0.4), noseY = -0.15;
  const nose = add(new THREE.ConeGeometry(between(0.09, 0.14), noseLength, 24), skin, [0, noseY, depth(0, noseY) + 0.5 * noseLength]);
  nose.rotation.x = Math.PI / 2;
  landmarks[30] = [0, noseY, depth(0, noseY) + noseLength];

  const mouthY = between(-0.55, -0.45), mouthHalf = between(0.2, 0.33), open = between(0.05, 0.16);
  const lip = new THREE.MeshLambertMaterial({ color: 0xb03040 }), dark = new THREE.MeshBasicMaterial({ color: 0x40101a });
  const mouthZ = depth(0, mouthY + open) + 0.03, thick = 0.035;  // In front of all of the skull behind it.
  add(new THREE.CircleGeometry(1, 32), dark, [0, mouthY, mouthZ], [mouthHalf, open, 1]);
  add(new THREE.TorusGeometry(1, thick / mouthHalf, 12, 48), lip, [0, mouthY, mouthZ], [mouthHalf, open, mouthHalf]);
  landmarks[48] = [-mouthHalf - thick, mouthY, mouthZ];
  landmarks[54] = [mouthHalf + thick, mouthY, mouthZ];
  landmarks[51] = [0, mouthY + open, mouthZ];
  landmarks[57] = [0, mouthY - open, mouthZ];
  return { head, landmarks };
}

const [out, count] = [process.argv[2], Number(process.argv[3])];
mkdirSync(out, { recursive: true });
for (let i = 0; i < count; ++i) {
  const random = seededRandom(2000 + i);
  const between = (low, high) => low + (high - low) * random();
  const scene = new THREE.Scene();
  const { head, landmarks } = makeHead(random);
  head.rotation.set(between(-0.15, 0.15), between(-0.6, 0.6), between(-0.15, 0.15));
  scene.add(head, new THREE.AmbientLight(0xffffff, 0.35));
  const sun = new THREE.DirectionalLight(0xffffff, 0.5);
  sun.position.set(between(-2, 2), between(0, 2), 3);
  scene.add(sun);
  const camera = new THREE.PerspectiveCamera(35, 1, 0.1, 20);
  camera.position.set(between(-0.3, 0.3), between(-0.3, 0.3), between(4.2, 6));
  scene.updateMatrixWorld(true);
  camera.updateMatrixWorld(true);
  const renderer = new SVGRenderer();
  renderer.setSize(size, size);
  renderer.render(scene, camera);
  const pixels = {};
  for (const [number, point] of Object.entries(landmarks)) {
    const seen = new THREE.Vector3(...point).applyMatrix4(head.matrixWorld).project(camera);
    pixels[number] = [(0.5 + 0.5 * seen.x) * size, (0.5 - 0.5 * seen.y) * size];
  }
  const ground = new THREE.Color().setHSL(random(), 0.35, between(0.35, 0.9)).getStyle();
  writePortrait(out, String(i + 1).padStart(2, '0'), render(renderer.domElement.toSvg(), ground).asPng(), pixels);
}
console.log(`${out}: ${count} scenes of three.js`);

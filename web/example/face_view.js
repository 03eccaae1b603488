import * as THREE from "three";

/** A face in a canvas, drawn when it changes: there is no loop. */
export class FaceView {
  constructor(canvas, { triangles, closingTriangles, neutral }) {
    this.geometry = new THREE.BufferGeometry().setIndex([...triangles, ...closingTriangles]);
    this.scene = new THREE.Scene().add(new THREE.Mesh(this.geometry, new THREE.MeshStandardMaterial({ color: 0xd8a888, side: THREE.DoubleSide })));
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x665544, 2), new THREE.DirectionalLight(0xffffff, 2));
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.camera = new THREE.PerspectiveCamera(30, canvas.width / canvas.height, 1, 200);
    this.camera.position.set(20, -1, 58);
    this.camera.lookAt(0, 1, -4);
    this.show(neutral);
  }

  show(vertices) {
    this.geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
    this.geometry.computeVertexNormals();
    this.renderer.render(this.scene, this.camera);
  }
}

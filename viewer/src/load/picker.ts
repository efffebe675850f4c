import * as THREE from "three";
import { numberMaterial } from "./box_geometry";

/** Finds the box under the pointer by drawing the boxes' numbers into one pixel, on the GPU where there is one. */
export class Picker {
  private readonly target = new THREE.WebGLRenderTarget(1, 1);
  private readonly material = numberMaterial();
  private readonly scene = new THREE.Scene();
  private readonly pixel = new Uint8Array(4);

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    geometry: THREE.BufferGeometry,
  ) {
    const mesh = new THREE.Mesh(geometry, this.material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  /** Box at a pixel of a picture of the given size; null: none. */
  at(
    x: number,
    y: number,
    width: number,
    height: number,
    camera: THREE.PerspectiveCamera,
    clip: number,
  ): number | null {
    const { renderer, pixel } = this;
    this.material.uniforms.clip.value = clip;
    camera.setViewOffset(width, height, Math.floor(x), Math.floor(y), 1, 1);
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(this.scene, camera);
    renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, pixel);
    renderer.setRenderTarget(null);
    camera.clearViewOffset();
    const number = pixel[0] + 256 * pixel[1] + 65536 * pixel[2];
    return number === 0 ? null : number - 1;
  }

  dispose(): void {
    this.target.dispose();
    this.material.dispose();
  }
}

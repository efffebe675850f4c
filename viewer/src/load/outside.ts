import * as THREE from "three";
import { departureOf } from "../box/departure";
import type { Results, World } from "../data/results";

/** Corners around the boxes that end outside the container, but no farther from it than two of its lengths, and not below the ground. */
export function outside(results: Results, world: World): THREE.Vector3[] {
  const { size: container, openings } = world.container;
  const { boxes } = world;
  const places: THREE.Vector3[] = [];
  const far = 2 * container[0];
  const least = new THREE.Vector3(-far, -far, -openings.bedHeight);
  const most = new THREE.Vector3(...container).addScalar(far);
  for (const box of boxes.id.keys()) {
    if (!departureOf(results, world, box)) continue;
    const place = new THREE.Vector3().fromArray(boxes.reference, 3 * box);
    place.add(new THREE.Vector3().fromArray(boxes.endDisplacement, 3 * box));
    const half = new THREE.Vector3().fromArray(boxes.size, 3 * box).length() / 2;
    for (const x of [-half, half])
      for (const y of [-half, half])
        for (const z of [-half, half]) places.push(new THREE.Vector3(x, y, z).add(place).clamp(least, most));
  }
  return places;
}

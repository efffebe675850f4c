import * as THREE from "three";

/** Where a ray meets a box that is turned, or null. */
export function hitBox(
  ray: THREE.Ray,
  { place, rotation, size }: { place: THREE.Vector3; rotation: THREE.Quaternion; size: THREE.Vector3 },
): THREE.Vector3 | null {
  const back = rotation.clone().invert();
  const inside = new THREE.Ray(
    ray.origin.clone().sub(place).applyQuaternion(back),
    ray.direction.clone().applyQuaternion(back),
  );
  const half = size.clone().multiplyScalar(0.5);
  const hit = inside.intersectBox(new THREE.Box3(half.clone().negate(), half), new THREE.Vector3());
  return hit ? hit.applyQuaternion(rotation).add(place) : null;
}

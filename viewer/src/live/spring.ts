import type * as THREE from "three";
import { GRAVITY } from "../data/push";

/** 1/m: weights of the box that a metre of pull pulls with. */
const STIFFNESS = 10;
/** weights of the box, at most */
const STRONGEST = 30;
/** 1/s: how soon the pull slows down what it has set in motion, as a share of that of a spring that does not swing */
const DAMPING = 0.5;

/**
 * The force of a spring from a point of a box to the pointer: N.
 * @param reach from the point of the box to the pointer, m
 * @param velocity of that point, m/s
 */
export function pullForce(reach: THREE.Vector3, velocity: THREE.Vector3, mass: number): THREE.Vector3 {
  const stiffness = STIFFNESS * GRAVITY * mass;
  const damping = DAMPING * 2 * Math.sqrt(stiffness * mass);
  return reach
    .clone()
    .multiplyScalar(stiffness)
    .addScaledVector(velocity, -damping)
    .clampLength(0, STRONGEST * GRAVITY * mass);
}

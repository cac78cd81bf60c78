// From the front, as goals are.
import type { Vector3 } from "three";

export const FROM_THE_FRONT = { x: 0, y: 0.05, z: 1 };

/** As wide and high as a tree is from the front; what comes nearer than the trunk looks larger. */
export const frontDistance = (extent: Vector3, aspect: number) =>
  Math.max(extent.y * 0.56, (extent.x * 0.58) / aspect) + extent.z * 0.08;

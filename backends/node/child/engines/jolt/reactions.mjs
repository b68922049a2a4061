// What Jolt's constraints did to their second body in a step.
import { BALL, DISTANCE, FIXED, HINGE, SLIDER } from '../../rows.mjs';
import { add, cross, length, rotate, scale, sub } from '../../algebra.mjs';
import { refuse } from '../../base.mjs';

const array = (v) => [v.GetX(), v.GetY(), v.GetZ()];

/** Impulse and angular impulse, in the axes that Jolt's parts of constraints take. a, b: the joint's frames. */
export function impulsesOf(type, joint, a, b) {
  const axesOf = ({ orientation }) => [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => rotate(orientation, axis)), [one, two] = [axesOf(a), axesOf(b)];
  const sum = (...parts) => parts.reduce((total, [factor, v]) => add(total, scale(factor, v)), [0, 0, 0]), pair = (v) => [v.GetComponent(0), v.GetComponent(1)];
  let force, torque = [0, 0, 0];
  switch (type) {
    case BALL: force = array(joint.GetTotalLambdaPosition()); break;
    case DISTANCE: {
      const way = sub(b.position, a.position);
      force = scale(joint.GetTotalLambdaPosition() / length(way), way);
      break;
    }
    case HINGE: {
      const [p, q] = pair(joint.GetTotalLambdaRotation()), across = perpendicular(two[0]), axis = one[0];
      force = array(joint.GetTotalLambdaPosition());
      torque = sum([p, cross(across, axis)], [q, cross(cross(two[0], across), axis)], [joint.GetTotalLambdaRotationLimits() + joint.GetTotalLambdaMotor(), axis]);
      break;
    }
    case SLIDER: {
      const [p, q] = pair(joint.GetTotalLambdaPosition());
      force = sum([p, one[1]], [q, one[2]], [joint.GetTotalLambdaPositionLimits() + joint.GetTotalLambdaMotor(), one[0]]);
      torque = array(joint.GetTotalLambdaRotation());
      break;
    }
    case FIXED:
      force = array(joint.GetTotalLambdaPosition());
      torque = array(joint.GetTotalLambdaRotation());
      break;
    default: refuse(`reactions of joints of type ${type}`);
  }
  return [...force, ...torque];
}

/** Jolt's Vec3::GetNormalizedPerpendicular. */
function perpendicular([x, y, z]) {
  const across = Math.abs(x) > Math.abs(y) ? [z, 0, -x] : [0, z, -y];
  return scale(1 / length(across), across);
}

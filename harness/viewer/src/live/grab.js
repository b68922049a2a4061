// Bodies taken with the pointer: a damped spring from where one was taken to where the pointer is, in the plane that
// faces the camera, as a force of the run. As stiff as the step allows, so light bodies come along and heavy ones lag.
import { BufferAttribute, BufferGeometry, Line, LineBasicMaterial, Plane, Raycaster, Vector2, Vector3 } from 'three';
import { centreOf, rotationOf } from './accounts.js';

const kStiffness = 0.4; // of a radian a step: the frequency of the spring
const kFastest = 25; // rad/s, however short the step
const kDamping = 0.7; // of the critical
const kStill = 4; // pixels within which a press is a click

export class Grab {
  constructor(viewer) {
    this.viewer = viewer;
    this.raycaster = new Raycaster();
    this.plane = new Plane();
    this.target = new Vector3();
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(6), 3));
    this.line = new Line(geometry, new LineBasicMaterial({ depthTest: false, transparent: true }));
    Object.assign(this.line, { visible: false, frustumCulled: false, renderOrder: 20 });
  }

  /** To a view that was just opened; before the camera hears of a press. */
  attach(view) {
    view.scene.scene.add(this.line);
    this.line.material.color.copy(view.scene.theme?.mark ?? this.line.material.color);
    view.element.addEventListener('pointerdown', (event) => this.press(view, event), { capture: true });
  }

  point(view, event) {
    const { left, top, width, height } = view.port.getBoundingClientRect();
    return new Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
  }

  camera(view) {
    const { cameras, follow } = this.viewer;
    return cameras.shifted(follow.offsetOf(view));
  }

  press(view, event) {
    if (event.button !== 0 || !view.port.contains(event.target)) return;
    const hit = view.scene.hit(this.point(view, event), this.camera(view));
    if (!hit || !(this.viewer.run.form.masses[hit.body][0] > 0)) return; // the camera's
    event.stopPropagation();
    this.take(hit.body, hit.point, view);
    const from = [event.clientX, event.clientY];
    const move = (moved) => this.move(view, moved);
    const up = (released) => {
      view.port.removeEventListener('pointermove', move);
      this.letGo();
      if (Math.hypot(released.clientX - from[0], released.clientY - from[1]) < kStill) this.viewer.pick(view, released);
    };
    view.port.setPointerCapture(event.pointerId);
    view.port.addEventListener('pointermove', move);
    view.port.addEventListener('lostpointercapture', up, { once: true });
  }

  take(body, point, view) {
    const { run } = this.viewer,
      p = body * 7,
      r = rotationOf(...run.poses.subarray(p + 3, p + 7)),
      away = [point.x, point.y, point.z].map((x, i) => x - run.poses[p + i]);
    this.body = body;
    this.anchor = [0, 1, 2].map((c) => r[c] * away[0] + r[c + 3] * away[1] + r[c + 6] * away[2]);
    this.target.copy(point);
    this.plane.setFromNormalAndCoplanarPoint(this.camera(view).getWorldDirection(new Vector3()), point);
    this.line.visible = true;
    run.pull = () => this.pull(run);
    this.viewer.touch();
  }

  move(view, event) {
    this.raycaster.setFromCamera(this.point(view, event), this.camera(view));
    this.raycaster.ray.intersectPlane(this.plane, this.target);
    this.viewer.touch();
  }

  letGo() {
    this.viewer.run.pull = null;
    this.line.visible = false;
    this.viewer.touch();
  }

  /** Where the body is held, in the world. */
  held(poses) {
    const p = this.body * 7,
      r = rotationOf(...poses.subarray(p + 3, p + 7));
    return [0, 3, 6].map(
      (row, i) => poses[p + i] + r[row] * this.anchor[0] + r[row + 1] * this.anchor[1] + r[row + 2] * this.anchor[2],
    );
  }

  pull({ world, bodies, poses, velocities, form, dt, needs }) {
    const at = this.held(poses),
      row = form.masses[this.body],
      centre = centreOf(row, poses, this.body * 7),
      arm = at.map((x, i) => x - centre[i]);
    const [vx, vy, vz, wx, wy, wz] = velocities.subarray(this.body * 6, this.body * 6 + 6);
    const velocity = [vx + wy * arm[2] - wz * arm[1], vy + wz * arm[0] - wx * arm[2], vz + wx * arm[1] - wy * arm[0]];
    // What the body weighs there at least, however it turns away.
    const least = Math.min(...row.slice(4, 7)),
      mass = 1 / (1 / row[0] + (least > 0 ? arm.reduce((sum, x) => sum + x * x, 0) / least : 0));
    const frequency = Math.min(kStiffness / dt, kFastest);
    const force = this.target
      .toArray()
      .map((to, i) => mass * frequency * (frequency * (to - at[i]) - 2 * kDamping * velocity[i]));
    if (needs.includes('sleeping')) world.write('awake', bodies[this.body], [1]);
    world.write('forceAtPoint', bodies[this.body], [...force, ...at]);
  }

  /** Draws the spring. */
  update() {
    if (!this.line.visible) return;
    const { position } = this.line.geometry.attributes;
    position.array.set([...this.held(this.viewer.run.poses), ...this.target.toArray()]);
    position.needsUpdate = true;
  }
}

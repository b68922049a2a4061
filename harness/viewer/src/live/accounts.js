// What a live run is measured by, in float64 from poses, velocities and the referee's masses, as the harness defines it
// (referee/mechanics.hpp).

/** Row-major, of a quaternion x y z w, whose length the engine rounded. */
export function rotationOf(x, y, z, w) {
  const s = 2 / (x * x + y * y + z * z + w * w);
  return [
    1 - s * (y * y + z * z),
    s * (x * y - z * w),
    s * (x * z + y * w),
    s * (x * y + z * w),
    1 - s * (x * x + z * z),
    s * (y * z - x * w),
    s * (x * z - y * w),
    s * (y * z + x * w),
    1 - s * (x * x + y * y),
  ];
}

/** Of the centre of mass of a body, from its row of masses and its row of poses at p. */
export function centreOf([, cx, cy, cz], poses, p) {
  const r = rotationOf(poses[p + 3], poses[p + 4], poses[p + 5], poses[p + 6]);
  return [0, 3, 6].map((row, i) => poses[p + i] + r[row] * cx + r[row + 1] * cy + r[row + 2] * cz);
}

/** {kinetic, potential (J), momentum (kg m/s, [3]), momenta: the sum of their sizes} of all bodies. */
export function accountsOf(masses, poses, velocities, gravity) {
  let kinetic = 0,
    potential = 0,
    momenta = 0;
  const momentum = [0, 0, 0];
  masses.forEach((row, body) => {
    const [mass, , , , xx, yy, zz, xy, xz, yz] = row;
    if (mass === 0) return;
    const p = body * 7,
      v = body * 6;
    const [vx, vy, vz, wx, wy, wz] = velocities.subarray(v, v + 6);
    const r = rotationOf(poses[p + 3], poses[p + 4], poses[p + 5], poses[p + 6]);
    // The angular velocity in the body's axes.
    const x = r[0] * wx + r[3] * wy + r[6] * wz,
      y = r[1] * wx + r[4] * wy + r[7] * wz,
      z = r[2] * wx + r[5] * wy + r[8] * wz;
    kinetic += 0.5 * mass * (vx * vx + vy * vy + vz * vz);
    kinetic += 0.5 * (xx * x * x + yy * y * y + zz * z * z) + xy * x * y + xz * x * z + yz * y * z;
    const c = centreOf(row, poses, p);
    potential -= mass * (gravity[0] * c[0] + gravity[1] * c[1] + gravity[2] * c[2]);
    momentum[0] += mass * vx;
    momentum[1] += mass * vy;
    momentum[2] += mass * vz;
    momenta += mass * Math.hypot(vx, vy, vz);
  });
  return { kinetic, potential, momentum, momenta };
}

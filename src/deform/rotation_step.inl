// One Newton step of several rotations, for the loops of rotation_batch.cpp and its AVX2 and AVX-512 builds. Lane is a
// double or a vector of doubles. The operations and their order are the same for both, so the bits are too.
//
//     H u = a   with   tr(exp([u])' B) = tr B + u.a - u' H u / 2 + O(u^3),   B = S R'
//
// It solves H u = a for the rotation vector u of the step, by L D L'.
template <class Lane>
inline void find_step(const Lane (&s)[9], const Lane (&q)[4], Lane (&u)[3], Lane (&pivot)[3]) noexcept {
  const Lane xx = q[0] * q[0], yy = q[1] * q[1], zz = q[2] * q[2], ww = q[3] * q[3];
  const Lane xy = q[0] * q[1], xz = q[0] * q[2], yz = q[1] * q[2], xw = q[0] * q[3], yw = q[1] * q[3], zw = q[2] * q[3];
  const Lane unit = 1.0 / ((xx + yy) + (zz + ww)), twice = 2.0 * unit;
  Lane r[3][3];
  r[0][0] = unit * ((ww + xx) - (yy + zz));
  r[0][1] = twice * (xy - zw);
  r[0][2] = twice * (xz + yw);
  r[1][0] = twice * (xy + zw);
  r[1][1] = unit * ((ww + yy) - (xx + zz));
  r[1][2] = twice * (yz - xw);
  r[2][0] = twice * (xz - yw);
  r[2][1] = twice * (yz + xw);
  r[2][2] = unit * ((ww + zz) - (xx + yy));
  Lane b[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) b[i][j] = s[3 * i] * r[j][0] + s[3 * i + 1] * r[j][1] + s[3 * i + 2] * r[j][2];
  }
  const Lane ax = b[2][1] - b[1][2], ay = b[0][2] - b[2][0], az = b[1][0] - b[0][1];
  const Lane h01 = -0.5 * (b[0][1] + b[1][0]), h02 = -0.5 * (b[0][2] + b[2][0]), h12 = -0.5 * (b[1][2] + b[2][1]);
  pivot[0] = b[1][1] + b[2][2];
  const Lane i0 = 1.0 / pivot[0], l10 = h01 * i0, l20 = h02 * i0;
  pivot[1] = (b[0][0] + b[2][2]) - l10 * h01;
  const Lane i1 = 1.0 / pivot[1], e21 = h12 - l20 * h01, l21 = e21 * i1;
  pivot[2] = (b[0][0] + b[1][1]) - l20 * h02 - l21 * e21;
  const Lane y1 = ay - l10 * ax;
  u[2] = (az - l20 * ax - l21 * y1) / pivot[2];
  u[1] = y1 * i1 - l21 * u[2];
  u[0] = ax * i0 - l10 * u[1] - l20 * u[2];
}

// Turns q by the angle 2 atan(|u| / 2), which is as good as |u| and needs no sine. q is not normalised: its square
// grows by the factor 1 + |u|^2 / 4.
template <class Lane>
inline void take_step(const Lane (&u)[3], Lane (&q)[4]) noexcept {
  const Lane x = q[0], y = q[1], z = q[2], w = q[3];
  const Lane hx = 0.5 * u[0], hy = 0.5 * u[1], hz = 0.5 * u[2];
  q[0] = x + (hx * w + hy * z - hz * y);
  q[1] = y + (hy * w + hz * x - hx * z);
  q[2] = z + (hz * w + hx * y - hy * x);
  q[3] = w - (hx * x + hy * y + hz * z);
}

// Finds or takes the Newton step of eight rotations, as many at once as Lane holds. step: written when the step is
// found. A lane that must not move has a zero step.
template <class Lane>
inline void step_lanes(const double* s, double* q, RotationStep& step, bool take) noexcept {
  constexpr int width = static_cast<int>(sizeof(Lane) / sizeof(double));
  const auto load = [](const double* from) {
    Lane lane;
    std::memcpy(&lane, from, sizeof lane);
    return lane;
  };
  const auto store = [](double* to, const Lane& lane) { std::memcpy(to, &lane, sizeof lane); };
  for (int l = 0; l < 8; l += width) {
    Lane here[4], u[3];
    for (int k = 0; k < 4; ++k) here[k] = load(q + 8 * k + l);
    if (take) {
      for (int k = 0; k < 3; ++k) u[k] = load(step.u[k] + l);
      take_step(u, here);
      for (int k = 0; k < 4; ++k) store(q + 8 * k + l, here[k]);
    } else {
      Lane matrix[9], pivot[3];
      for (int k = 0; k < 9; ++k) matrix[k] = load(s + 8 * k + l);
      find_step(matrix, here, u, pivot);
      for (int k = 0; k < 3; ++k) {
        store(step.u[k] + l, u[k]);
        store(step.pivot[k] + l, pivot[k]);
      }
      store(step.square + l, u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    }
  }
}

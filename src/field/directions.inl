// The loop of directions.h; includes no header whose inline functions could leak from one instruction set into another.
namespace {

// With Channels known the loops over channels become vector code.
template <int Channels>
inline void add_one(const hf::DirectionSums& job, std::int64_t t, std::int32_t channels) noexcept {
  const int count = Channels > 0 ? Channels : channels;
  const hf::TriangleFrame frame = job.frame[t];
  const std::int32_t* v = job.triangle + 3 * t;
  const double* u0 = job.heat + static_cast<std::int64_t>(job.position[v[0]]) * count;
  const double* u1 = job.heat + static_cast<std::int64_t>(job.position[v[1]]) * count;
  const double* u2 = job.heat + static_cast<std::int64_t>(job.position[v[2]]) * count;
  const double* weight = job.weight + static_cast<std::int64_t>(job.component[v[0]]) * count;
  double x[8], y[8];
  for (int c = 0; c < count; ++c) {
    // scaled first: far from the source the heat is 1e-200 and its square nothing
    const double d1 = u1[c] - u0[c], d2 = u2[c] - u0[c];
    const double a1 = __builtin_fabs(d1), a2 = __builtin_fabs(d2), larger = a1 > a2 ? a1 : a2;
    const double scale = 1 / (larger > 1e-300 ? larger : 1e-300);
    // grad v times twice the area: d1 n x (p0 - p2) + d2 n x (p1 - p0), and n x (x, y) = (-y, x)
    const double gx = scale * d1 * frame.py;
    const double gy = scale * d2 * frame.along - scale * d1 * frame.px;
    const double squared = gx * gx + gy * gy;
    const double factor = -weight[c] / __builtin_sqrt(squared > 1e-100 ? squared : 1e-100);
    x[c] = factor * gx, y[c] = factor * gy;
  }
  double sum_x = 0, sum_y = 0;
  for (int c = 0; c < count; ++c) sum_x += x[c], sum_y += y[c];
  job.sums[2 * t] += sum_x, job.sums[2 * t + 1] += sum_y;
}

void add_directions_range(const hf::DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept {
  for (std::int64_t t = begin; t < end; ++t) {
    if (!(job.frame[t].py > 0)) continue;
    if (job.channels == 8) {
      add_one<8>(job, t, 8);
    } else {
      add_one<0>(job, t, job.channels);
    }
  }
}

}  // namespace

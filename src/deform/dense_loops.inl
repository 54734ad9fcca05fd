// The two sweeps of dense.cpp and of its AVX2 and AVX-512 builds. Lane is a vector of rows or columns, and `sides`
// right-hand sides of all are summed at once: as many as the registers hold. A sum takes its terms in the same order
// whatever the lanes, so the bits are the same.

// Forward: y = L^-1 b. Each row is summed in four parts, by column modulo 4; columns after the last whole four go to
// the first part.
template <class Lane, std::size_t sides, std::size_t all>
inline void add_rows(const double* panel, std::size_t columns, const double* x, double (&sum)[all][4][8]) noexcept {
  constexpr std::size_t width = sizeof(Lane) / sizeof(double);
  for (std::size_t part = 0; part < 8; part += width) {
    for (std::size_t side = 0; side < all; side += sides) {
      Lane own[sides][4] = {};
      for (std::size_t j = 0; j < columns; j += 4) {
        for (std::size_t u = 0; u < 4; ++u) {
          Lane row;
          std::memcpy(&row, panel + 8 * (j + u) + part, sizeof row);
          for (std::size_t k = 0; k < sides; ++k) own[k][u] += row * x[4 * (j + u) + side + k];
        }
      }
      for (std::size_t k = 0; k < sides; ++k) {
        for (std::size_t u = 0; u < 4; ++u) std::memcpy(&sum[side + k][u][part], &own[k][u], sizeof(Lane));
      }
    }
  }
}

template <class Lane, std::size_t sides, std::size_t all>
inline void solve_rows(const DensePanels& factor, double* x) noexcept {
  for (std::size_t first = 0; first < factor.size; first += 8) {
    const double* const panel = factor.rows + DensePanels::rows_at(first / 8);
    const double* const tile = panel + 8 * first;
    double sum[all][4][8];
    add_rows<Lane, sides, all>(panel, first, x, sum);
    const std::size_t count = factor.size - first < 8 ? factor.size - first : 8;
    for (std::size_t r = 0; r < count; ++r) {
      double* const own = x + 4 * (first + r);
      const std::size_t whole = r < 4 ? 0 : 4;
      for (std::size_t k = 0; k < all; ++k) {
        for (std::size_t c = 0; c < r; ++c) sum[k][c < whole ? c : 0][r] += tile[8 * c + r] * x[4 * (first + c) + k];
        own[k] = (own[k] - ((sum[k][0][r] + sum[k][1][r]) + (sum[k][2][r] + sum[k][3][r]))) *
                 factor.inverse_pivot[first + r];
      }
    }
  }
}

// Backward: x = L'^-1 y. Takes the rows of L off the unknowns before them, from the last row on and two at a time.
template <class Lane, std::size_t sides, std::size_t all>
inline void subtract_rows(const double* panel, std::size_t from, std::size_t size, const double* x, std::size_t first,
                          double (&own)[all][8]) noexcept {
  constexpr std::size_t width = sizeof(Lane) / sizeof(double);
  for (std::size_t part = 0; part < 8; part += width) {
    for (std::size_t side = 0; side < all; side += sides) {
      Lane rest[sides], one, other;
      for (std::size_t k = 0; k < sides; ++k) std::memcpy(&rest[k], &own[side + k][part], sizeof(Lane));
      std::size_t i = size;
      if (i % 2 == 1 && i > from) {
        --i;
        std::memcpy(&one, panel + 8 * (i - first) + part, sizeof one);
        for (std::size_t k = 0; k < sides; ++k) rest[k] -= one * x[4 * i + side + k];
      }
      while (i > from) {
        i -= 2;
        std::memcpy(&one, panel + 8 * (i - first) + part, sizeof one);
        std::memcpy(&other, panel + 8 * (i + 1 - first) + part, sizeof other);
        for (std::size_t k = 0; k < sides; ++k)
          rest[k] -= one * x[4 * i + side + k] + other * x[4 * i + 4 + side + k];
      }
      for (std::size_t k = 0; k < sides; ++k) std::memcpy(&own[side + k][part], &rest[k], sizeof(Lane));
    }
  }
}

template <class Lane, std::size_t sides, std::size_t all>
inline void solve_columns(const DensePanels& factor, double* x) noexcept {
  const std::size_t panels = DensePanels::count(factor.size);
  for (std::size_t p = panels; p-- > 0;) {
    const std::size_t first = 8 * p, count = factor.size - first < 8 ? factor.size - first : 8;
    const double* const tile = factor.columns + DensePanels::columns_at(p, panels);
    const double* const inverse = factor.inverse_pivot + first;
    double own[all][8] = {};
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t k = 0; k < all; ++k) own[k][c] = x[4 * (first + c) + k];
    }
    if (first + 8 < factor.size) subtract_rows<Lane, sides, all>(tile, first + 8, factor.size, x, first, own);
    std::size_t i = count;
    if (i % 2 == 1) {
      --i;
      for (std::size_t k = 0; k < all; ++k) {
        const double y = own[k][i] *= inverse[i];
        for (std::size_t c = 0; c < i; ++c) own[k][c] -= tile[8 * i + c] * y;
      }
    }
    while (i > 0) {
      i -= 2;
      for (std::size_t k = 0; k < all; ++k) {
        const double z = own[k][i + 1] *= inverse[i + 1];
        const double y = own[k][i] = (own[k][i] - tile[8 * (i + 1) + i] * z) * inverse[i];
        for (std::size_t c = 0; c < i; ++c) own[k][c] -= tile[8 * i + c] * y + tile[8 * (i + 1) + c] * z;
      }
    }
    for (std::size_t c = 0; c < count; ++c) {
      for (std::size_t k = 0; k < all; ++k) x[4 * (first + c) + k] = own[k][c];
    }
  }
}

template <class Lane, std::size_t sides, std::size_t all>
inline void solve_panels(const DensePanels& factor, double* x) noexcept {
  solve_rows<Lane, sides, all>(factor, x);
  solve_columns<Lane, sides, all>(factor, x);
}

#include "deform/free_turns.h"

#include <algorithm>

namespace hf_inner::deform {
namespace {

// Rounds in which the handles of free rotation find their rotations one after the other. A round is exact for one
// handle; neighbours that pull on each other need more. Fewer take less time; the next iteration continues from there.
constexpr int turn_rounds = 4;

// Writes J_h L_hj for handle h of the set and handle j of the pose: block[b][a] is its row a and column b. Subspace
// holds L_hj for j <= h.
void centred_block(const Subspace& subspace, std::size_t handle_count, const FreeTurns& turns, std::size_t h,
                   std::size_t j, double (&block)[4][3]) noexcept {
  const std::size_t own = static_cast<std::size_t>(turns.handle[h]), stride = 4 * handle_count;
  const double* first = subspace.between.data() + 4 * std::max(own, j) * stride + 4 * std::min(own, j);
  const double c[3] = {turns.centroid[h].x, turns.centroid[h].y, turns.centroid[h].z};
  for (std::size_t b = 0; b < 4; ++b) {
    const auto at = [&](std::size_t a) { return own < j ? first[b * stride + a] : first[a * stride + b]; };
    for (std::size_t a = 0; a < 3; ++a) block[b][a] = at(a) - c[a] * at(3);
  }
}

// Adds U' r, three rows and columns.
void add_product(const double* u, const double* r, std::size_t size, Mat3& sum) noexcept {
  double total[3][3] = {};
  for (std::size_t row = 0; row < size; ++row) {
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) total[a][b] += u[4 * row + a] * r[4 * row + b];
    }
  }
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) sum(a, b) += total[a][b];
  }
}

// Writes X_h: rows 0 to 2 are R_h', row 3 is (d_h - R_h c_h)'.
void write_turned(const FreeTurns& turns, std::size_t k, const FreeTurnsState& state, double* rows) noexcept {
  double* x = rows + 16 * static_cast<std::size_t>(turns.handle[k]);
  const Mat3 rotation = state.rotation[k].toRotationMatrix();
  const Vec3 last = state.place[k] - rotation * turns.centroid[k];
  const double place[3] = {last.x, last.y, last.z};
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) x[4 * a + i] = rotation(i, a);
    x[12 + i] = place[i];
  }
}

class Preparation {
 public:
  Preparation(const Subspace& subspace, const Holds* holds, FreeTurns& out, Memory& memory)
      : subspace_(subspace),
        holds_(holds),
        size_(static_cast<std::size_t>(subspace.factor.size())),
        out_(out),
        memory_(memory),
        pull_(memory, out.count() * 4 * size_) {
    out.response.allocate(memory, out.count() * 4 * size_);
  }

  void run() {
    for (std::size_t k = 0; k < out_.count(); ++k) respond(k);
    list_moments();
    for (std::size_t h = 0; h < out_.count(); ++h) {
      for (std::size_t k = 0; k < out_.count(); ++k) out_.cross.push_back(h == k ? Mat3() : cross(h, k));
    }
    if (holds_) add_holds();
  }

 private:
  // pull = L_fh J_h', response = U_h
  void respond(std::size_t k) noexcept {
    const Vec3 c = out_.centroid[k];
    double* const pull = pull_.data() + 4 * size_ * k;
    double* const response = out_.response.data() + 4 * size_ * k;
    for (std::size_t row = 0; row < size_; ++row) {
      const double* block =
          subspace_.coupling.data() + row * 4 * out_.handle_count + 4 * static_cast<std::size_t>(out_.handle[k]);
      pull[4 * row] = block[0] - block[3] * c.x;
      pull[4 * row + 1] = block[1] - block[3] * c.y;
      pull[4 * row + 2] = block[2] - block[3] * c.z;
      pull[4 * row + 3] = 0;
    }
    std::copy(pull, pull + 4 * size_, response);
    if (size_ > 0) subspace_.factor.solve(response);
  }

  Mat3 cross(std::size_t h, std::size_t k) const noexcept {
    Mat3 sum;
    add_product(pull_.data() + 4 * size_ * h, out_.response.data() + 4 * size_ * k, size_, sum);
    double block[4][3];
    centred_block(subspace_, out_.handle_count, out_, h, static_cast<std::size_t>(out_.handle[k]), block);
    const double c[3] = {out_.centroid[k].x, out_.centroid[k].y, out_.centroid[k].z};
    Mat3 result;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) result(a, b) = block[b][a] - block[3][a] * c[b] - sum(a, b);
    }
    return result;
  }

  // The pins: J_h V_h T, and J_h V_h T V_k' J_k' to the cross terms.
  void add_holds() {
    const std::size_t m = holds_->count(), all = 4 * m;
    out_.hold_count = m;
    out_.hold_pull.allocate(memory_, out_.count() * all);
    std::fill(out_.hold_pull.begin(), out_.hold_pull.end(), 0.0);
    for (std::size_t k = 0; k < out_.count(); ++k) see_pins(k, out_.hold_pull.data() + k * all);
    Buffer<double> seen(memory_, out_.hold_pull.size());
    std::copy(out_.hold_pull.begin(), out_.hold_pull.end(), seen.begin());
    for (std::size_t k = 0; k < out_.count(); ++k) holds_->system.solve(out_.hold_pull.data() + k * all);
    for (std::size_t h = 0; h < out_.count(); ++h) {
      for (std::size_t k = 0; k < out_.count(); ++k) {
        if (h != k)
          add_product(out_.hold_pull.data() + h * all, seen.data() + k * all, m, out_.cross[h * out_.count() + k]);
      }
    }
  }

  // (J_k V_k)'
  void see_pins(std::size_t k, double* seen) const noexcept {
    const std::size_t m = holds_->count();
    const double c[3] = {out_.centroid[k].x, out_.centroid[k].y, out_.centroid[k].z};
    for (std::size_t j = 0; j < m; ++j) {
      for (std::int32_t e = holds_->row_start[j]; e < holds_->row_start[j + 1]; ++e) {
        const Holds::Part& part = holds_->row[e];
        if (part.cluster != out_.handle[k]) continue;
        for (std::size_t a = 0; a < 3; ++a) seen[4 * j + a] += part.z[a] - c[a] * part.z[3];
      }
    }
    const double* pull = pull_.data() + 4 * size_ * k;
    for (std::size_t row = 0; row < size_; ++row) {
      for (std::size_t j = 0; j < m; ++j) {
        for (std::size_t a = 0; a < 3; ++a) seen[4 * j + a] -= pull[4 * row + a] * holds_->response[row * m + j];
      }
    }
  }

  void list_moments() {
    out_.moment_start.push_back(0);
    for (std::size_t k = 0; k < out_.count(); ++k) {
      const double c[3] = {out_.centroid[k].x, out_.centroid[k].y, out_.centroid[k].z};
      for (std::size_t g = 0; g < subspace_.group.size(); ++g) {
        for (std::int32_t e = subspace_.entry_start[g]; e < subspace_.entry_start[g + 1]; ++e) {
          const Subspace::Entry& entry = subspace_.entry[e];
          if (entry.cluster != out_.handle[k]) continue;
          FreeTurns::Moment moment{static_cast<std::int32_t>(g), {}};
          for (int a = 0; a < 3; ++a) {
            for (int j = 0; j < 3; ++j) moment.q[a][j] = entry.q[a][j] - c[a] * entry.q[3][j];
          }
          out_.moment.push_back(moment);
        }
      }
      out_.moment_start.push_back(static_cast<std::int32_t>(out_.moment.size()));
    }
  }

  const Subspace& subspace_;
  const Holds* holds_;
  std::size_t size_;
  FreeTurns& out_;
  Memory& memory_;
  Buffer<double> pull_;
};

// Handles of given rotation count as much as their fields overlap the field of the free handle.
void list_follow(const Vector<double>& seed_field, Span<const std::uint8_t> free_turn, FreeTurns& out) {
  const std::size_t handles = free_turn.size();
  out.follow.assign(out.count() * handles, 0.0);
  for (std::size_t k = 0; k < out.count(); ++k) {
    double* const share = out.follow.data() + k * handles;
    double sum = 0;
    for (std::size_t first = 0; first < seed_field.size(); first += handles) {
      const double own = seed_field[first + static_cast<std::size_t>(out.handle[k])];
      for (std::size_t i = 0; i < handles; ++i) {
        if (!free_turn[i]) share[i] += own * seed_field[first + i];
      }
    }
    for (std::size_t i = 0; i < handles; ++i) sum += share[i];
    for (std::size_t i = 0; i < handles; ++i) share[i] = sum > 0 ? share[i] / sum : 0;
  }
}

}  // namespace

FreeTurns make_free_turns(const Subspace& subspace, const Handles& handles, Span<const std::uint8_t> free_turn,
                          const Vector<double>& seed_field, const Holds* holds, Memory& memory) {
  FreeTurns turns(memory);
  for (std::size_t i = 0; i < handles.size(); ++i) {
    if (!free_turn[i]) continue;
    turns.handle.push_back(static_cast<std::int32_t>(i));
    turns.centroid.push_back(handles[i].region->centroid);
  }
  turns.handle_count = handles.size();
  Preparation(subspace, holds, turns, memory).run();
  list_follow(seed_field, free_turn, turns);
  return turns;
}

void begin_turns(const FreeTurns& turns, const Subspace& subspace, double* rows, FreeTurnsState& state) noexcept {
  const std::size_t handles = turns.handle_count;
  for (std::size_t k = 0; k < turns.count(); ++k) {
    double* x = rows + 16 * static_cast<std::size_t>(turns.handle[k]);
    const double place[3] = {state.place[k].x, state.place[k].y, state.place[k].z};
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < 3; ++a) x[4 * a + i] = 0;
      x[12 + i] = place[i];
    }
  }
  for (std::size_t k = 0; k < turns.count(); ++k) {
    state.constant[k] = Mat3();
    for (std::size_t j = 0; j < handles; ++j) {
      double block[4][3];
      centred_block(subspace, handles, turns, k, j, block);
      for (int b = 0; b < 4; ++b) {
        for (int a = 0; a < 3; ++a) {
          for (int i = 0; i < 3; ++i)
            state.constant[k](a, i) += block[b][a] * rows[16 * j + static_cast<std::size_t>(4 * b + i)];
        }
      }
    }
  }
}

void find_turns(const FreeTurns& turns, const double* r, std::size_t size, const double* columns, const double* gap,
                double* rows, FreeTurnsState& state) noexcept {
  const std::size_t count = turns.count();
  for (std::size_t h = 0; h < count; ++h) {
    Mat3& fixed = state.fixed[h];
    fixed = state.constant[h];
    add_product(turns.response.data() + 4 * size * h, r, size, fixed);
    for (std::int32_t m = turns.moment_start[h]; m < turns.moment_start[h + 1]; ++m) {
      const FreeTurns::Moment& moment = turns.moment[m];
      const double* target = columns + 12 * static_cast<std::size_t>(moment.group);
      for (int a = 0; a < 3; ++a) {
        for (int i = 0; i < 3; ++i)
          fixed(a, i) -= moment.q[a][0] * target[i] + moment.q[a][1] * target[4 + i] + moment.q[a][2] * target[8 + i];
      }
    }
    if (turns.hold_count == 0) continue;
    Mat3 held;
    add_product(turns.hold_pull.data() + 4 * turns.hold_count * h, gap, turns.hold_count, held);
    fixed += -held;
  }
  for (int round = 0; round < (count > 1 ? turn_rounds : 1); ++round) {
    for (std::size_t h = 0; h < count; ++h) {
      Mat3 sum = state.fixed[h];
      for (std::size_t k = 0; k < count; ++k) {
        if (k != h) sum += turns.cross[h * count + k] * state.rotation[k].toRotationMatrix().transpose();
      }
      state.rotation[h] = best_rotation_from(-sum.transpose(), state.rotation[h]);
    }
  }
  for (std::size_t h = 0; h < count; ++h) write_turned(turns, h, state, rows);
}

void respond_to_turns(const FreeTurns& turns, const FreeTurnsState& state, double* solved, std::size_t size) noexcept {
  for (std::size_t k = 0; k < turns.count(); ++k) {
    const Mat3 rotation = state.rotation[k].toRotationMatrix();
    const double* u = turns.response.data() + 4 * size * k;
    for (std::size_t row = 0; row < size; ++row) {
      for (int i = 0; i < 3; ++i)
        solved[4 * row + i] -=
            u[4 * row] * rotation(i, 0) + u[4 * row + 1] * rotation(i, 1) + u[4 * row + 2] * rotation(i, 2);
    }
  }
}

}  // namespace hf_inner::deform

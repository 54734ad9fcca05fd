#include "factor/factor_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/timer.h"
#include "factor/bytes_hash.h"
#include "factor/numeric.h"
#include "factor/supernodal_factor.h"

namespace hf_inner::factor {
namespace {

constexpr std::uint64_t magic = 0x524F544341464648ull;  // "HFFACTOR"
constexpr std::uint32_t version = 2;
// One job copies this many bytes: smaller jobs balance the threads better but cost more. Half and
// twice the value take the same time within the noise of 10 %. No result depends on it.
constexpr std::uint64_t copy_step = std::uint64_t{1} << 22;
// Refuses larger counts in saved bytes as damaged, before a sum of sizes can overflow.
constexpr std::uint64_t most_count = std::uint64_t{1} << 48;
// Refuses larger numbers of entries and flops in saved bytes as damaged.
constexpr double most_work = 1e300;
// One thread's job checks this many supernodes. Half and twice the value take the same time within
// 10 %. No result depends on it.
constexpr std::int32_t list_step = 2048;
constexpr std::uint32_t byte_order = 0x01020304u;

struct Header {
  std::uint64_t magic;
  std::uint32_t version;
  std::uint32_t byte_order;
  std::int32_t unknowns;
  std::int32_t supernodes;
  std::int32_t ordering;
  std::uint32_t reserved;
  std::uint64_t row_count;
  std::uint64_t value_count;
  std::uint64_t pattern_hash;
  std::uint64_t matrix_hash;
  double entries, flops;
  std::uint64_t length;
  std::uint64_t checksum;  // of all bytes after the header
  std::uint64_t unused[3];
  std::uint64_t header_check;  // hash of the fields above
};
static_assert(sizeof(Header) == 128);

std::uint64_t check_of(const Header& header) noexcept {
  return hash_piece(reinterpret_cast<const std::uint8_t*>(&header), offsetof(Header, header_check));
}

constexpr std::uint64_t padded(std::uint64_t bytes) noexcept { return (bytes + 63) & ~std::uint64_t{63}; }

// The places where the sections of the saved bytes begin. No sum overflows for counts below 2^48.
struct Layout {
  Layout(std::uint64_t unknowns, std::uint64_t supernodes, std::uint64_t row_count, std::uint64_t value_count) {
    order = sizeof(Header);
    first = order + padded(4 * unknowns);
    below = first + padded(4 * (supernodes + 1));
    rows = below + padded(4 * supernodes);
    values = rows + padded(4 * row_count);
    length = values + padded(8 * (value_count + value_slack));
  }
  explicit Layout(const Header& header)
      : Layout(static_cast<std::uint64_t>(header.unknowns), static_cast<std::uint64_t>(header.supernodes),
               header.row_count, header.value_count) {}
  std::uint64_t order, first, below, rows, values, length;
};

[[noreturn]] void refuse(const char* what) {
  fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the bytes are no saved factor: %s; save it again with this library",
       what);
}

Header read_header(Span<const std::uint8_t> bytes) {
  Header header;
  if (bytes.size() < sizeof header) refuse("too short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != magic) refuse("wrong beginning");
  if (header.byte_order != byte_order) {
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the saved factor has another byte order; save it on this kind of machine");
  }
  if (header.version != version) {
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the saved factor has version %u, this library reads %u; save it again",
         header.version, version);
  }
  if (header.header_check != check_of(header)) refuse("its header is damaged");
  if (header.unknowns < 0 || header.supernodes < 0 || header.supernodes > header.unknowns ||
      header.row_count > most_count || header.value_count > most_count || header.ordering < 0 || header.ordering > 3 ||
      !(header.entries >= 0 && header.entries < most_work) || !(header.flops >= 0 && header.flops < most_work)) {
    refuse("its sizes make no sense");
  }
  if (Layout(header).length != header.length || header.length != bytes.size()) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the bytes are no saved factor: %zu bytes were given, its header asks for %llu; give all of them",
         bytes.size(), static_cast<unsigned long long>(header.length));
  }
  return header;
}

// Tells whether no number is NaN or infinite. The bytes may have any alignment. NaN and infinity have an exponent of
// all ones; adding one to it reaches the sign bit.
bool finite_numbers(const std::uint8_t* bytes, std::uint64_t count) noexcept {
  constexpr std::uint64_t exponent = 0x7FF0000000000000ull, one = 0x0010000000000000ull;
  std::uint64_t bad[8] = {};
  std::uint64_t k = 0;
  for (; k + 8 <= count; k += 8) {
    std::uint64_t word[8];
    std::memcpy(word, bytes + 8 * k, sizeof word);
    for (int c = 0; c < 8; ++c) bad[c] |= (word[c] & exponent) + one;
  }
  for (; k < count; ++k) {
    std::uint64_t word;
    std::memcpy(&word, bytes + 8 * k, sizeof word);
    bad[0] |= (word & exponent) + one;
  }
  for (int c = 1; c < 8; ++c) bad[0] |= bad[c];
  return bad[0] >> 63 == 0;
}

void read_lists(const std::uint8_t* bytes, const Layout& layout, const Header& header, Memory& memory, Symbolic& out) {
  const std::size_t n = static_cast<std::size_t>(header.unknowns), count = static_cast<std::size_t>(header.supernodes);
  out.size = header.unknowns;
  out.supernodes = header.supernodes;
  out.entries = header.entries;
  out.flops = header.flops;
  out.order.allocate(memory, n);
  out.position.allocate(memory, n);
  out.supernode.allocate(memory, n);
  out.first.allocate(memory, count + 1);
  out.parent.allocate(memory, count);
  out.subtree.allocate(memory, count);
  out.row_start.allocate(memory, count + 1);
  out.rows.allocate(memory, header.row_count + Symbolic::row_slack);
  out.value_start.allocate(memory, count);
  out.work.allocate(memory, count);
  if (n > 0) std::memcpy(out.order.data(), bytes + layout.order, 4 * n);
  std::memcpy(out.first.data(), bytes + layout.first, 4 * (count + 1));
  if (header.row_count > 0) std::memcpy(out.rows.data(), bytes + layout.rows, 4 * header.row_count);
  std::fill(out.rows.data() + header.row_count, out.rows.data() + header.row_count + Symbolic::row_slack, 0);
  out.row_start[0] = 0;
  for (std::size_t s = 0; s < count; ++s) {
    std::int32_t below;
    std::memcpy(&below, bytes + layout.below + 4 * s, sizeof below);
    if (below < 0) refuse("a row count is negative");
    out.row_start[s + 1] = out.row_start[s] + below;
  }
  if (out.row_start[count] != static_cast<std::int64_t>(header.row_count)) refuse("the row counts do not add up");
}

void check_columns(Symbolic& out) {
  std::fill(out.position.begin(), out.position.end(), -1);
  for (std::int32_t k = 0; k < out.size; ++k) {
    const std::int32_t unknown = out.order[k];
    if (unknown < 0 || unknown >= out.size || out.position[unknown] >= 0) refuse("its order is no permutation");
    out.position[unknown] = k;
  }
  if (out.first[0] != 0 || out.first[out.supernodes] != out.size) refuse("its supernodes do not span the columns");
  for (std::int32_t s = 0; s < out.supernodes; ++s) {
    if (out.first[s + 1] <= out.first[s] || out.first[s + 1] > out.size) refuse("its supernodes do not ascend");
    for (std::int32_t j = out.first[s]; j < out.first[s + 1]; ++j) out.supernode[j] = s;
  }
}

// Calls work(s) for every supernode s, in jobs of list_step supernodes.
template <class Work>
void for_supernodes(const Symbolic& symbolic, JobRunner& jobs, Work&& work) {
  jobs.for_each(static_cast<std::uint32_t>((symbolic.supernodes + list_step - 1) / list_step),
                [&](std::uint32_t piece) {
                  const std::int32_t begin = static_cast<std::int32_t>(piece) * list_step;
                  for (std::int32_t s = begin; s < std::min(symbolic.supernodes, begin + list_step); ++s) work(s);
                });
}

// Checks the row lists of the supernodes. They ascend, lie below their columns, and continue in the
// parent: each row is a column of the parent or in its list.
void check_rows(Symbolic& out, JobRunner& jobs) {
  for_supernodes(out, jobs, [&](std::int32_t s) {
    const std::int32_t* rows = out.row_list(s);
    const std::int32_t count = out.below(s);
    std::int32_t previous = out.first[s + 1] - 1;
    bool ascends = true;
    for (std::int32_t k = 0; k < count; previous = rows[k++]) ascends &= rows[k] > previous;
    if (!ascends || previous >= out.size) refuse("a row list does not ascend inside the matrix");
    out.parent[s] = count > 0 ? out.supernode[rows[0]] : -1;
  });
  for_supernodes(out, jobs, [&](std::int32_t s) {
    const std::int32_t parent = out.parent[s];
    if (parent < 0) return;
    const std::int32_t *rows = out.row_list(s), *end = rows + out.below(s);
    const std::int32_t *up = out.row_list(parent), *up_end = up + out.below(parent);
    while (rows < end && *rows < out.first[parent + 1]) ++rows;
    for (; rows < end; ++rows) {
      while (up < up_end && *up < *rows) ++up;
      if (up == up_end || *up != *rows) refuse("a row list does not go on in its parent");
    }
  });
  // In a postorder, the subtree of s is the range of supernodes that ends with s.
  Buffer<std::int32_t>& first = out.subtree;
  for (std::int32_t s = 0; s < out.supernodes; ++s) first[s] = s;
  for (std::int32_t s = 0; s < out.supernodes; ++s) {
    if (out.parent[s] >= 0) first[out.parent[s]] = std::min(first[out.parent[s]], first[s]);
  }
}

void check_postorder(const Symbolic& out, Memory& memory) {
  Buffer<std::int32_t> size(memory, static_cast<std::size_t>(out.supernodes));
  std::fill(size.begin(), size.end(), 1);
  for (std::int32_t s = 0; s < out.supernodes; ++s) {
    if (s - out.subtree[s] + 1 != size[s]) refuse("its supernodes are in no postorder");
    if (out.parent[s] >= 0) size[out.parent[s]] += size[s];
  }
}

// The diagonals are stored inverted; each must be positive.
void check_diagonals(const Symbolic& symbolic, const double* values, JobRunner& jobs) {
  for_supernodes(symbolic, jobs, [&](std::int32_t s) {
    const double* triangle = values + symbolic.value_start[s];
    bool good = true;
    for (std::int64_t j = 0, at = 0; j < symbolic.columns(s); ++j, at += j + 1) good &= triangle[at] > 0;
    if (!good) refuse("a diagonal is not positive");
  });
}

Layout layout_of(const Symbolic& symbolic) {
  return Layout(static_cast<std::uint64_t>(symbolic.size), static_cast<std::uint64_t>(symbolic.supernodes),
                static_cast<std::uint64_t>(symbolic.row_start[symbolic.supernodes]),
                static_cast<std::uint64_t>(symbolic.stored_entries));
}

}  // namespace

std::uint64_t hash_matrix(const SymmetricMatrix& matrix, Span<const std::int32_t> extra_row,
                          Span<const double> extra_value, Memory& memory, JobRunner& jobs) {
  std::uint64_t state = hash_array(matrix.column_start.data(), matrix.column_start.size(), memory, jobs);
  state = hash_step(state, hash_array(matrix.row.data(), matrix.row.size(), memory, jobs));
  state = hash_step(state, hash_array(matrix.value.data(), matrix.value.size(), memory, jobs));
  state = hash_step(state, hash_array(extra_row.data(), extra_row.size(), memory, jobs));
  return hash_step(state, hash_array(extra_value.data(), extra_value.size(), memory, jobs));
}

std::uint64_t saved_factor_size(const Factor& factor) {
  return layout_of(static_cast<const SupernodalFactor&>(factor).symbolic()).length;
}

void save_factor(const Factor& factor, std::uint64_t matrix_hash, Span<std::uint8_t> out, Memory& memory,
                 JobRunner& jobs) {
  const SupernodalFactor& full = static_cast<const SupernodalFactor&>(factor);
  const Symbolic& symbolic = full.symbolic();
  const Layout layout = layout_of(symbolic);
  if (out.size() < layout.length) {
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "the saved factor takes %llu bytes, the buffer has %zu",
         static_cast<unsigned long long>(layout.length), out.size());
  }
  Header header{};
  header.magic = magic;
  header.version = version;
  header.byte_order = byte_order;
  header.unknowns = symbolic.size;
  header.supernodes = symbolic.supernodes;
  header.ordering = static_cast<std::int32_t>(full.analysis()->ordering);
  header.row_count = static_cast<std::uint64_t>(symbolic.row_start[symbolic.supernodes]);
  header.value_count = static_cast<std::uint64_t>(symbolic.stored_entries);
  header.pattern_hash = full.analysis()->pattern_hash;
  header.matrix_hash = matrix_hash;
  header.entries = symbolic.entries;
  header.flops = symbolic.flops;
  header.length = layout.length;
  std::uint8_t* bytes = out.data();
  const auto put = [&](std::uint64_t from, std::uint64_t to, const void* data, std::uint64_t length) {
    if (length > 0) std::memcpy(bytes + from, data, length);
    std::fill(bytes + from + length, bytes + to, std::uint8_t{0});
  };
  put(layout.order, layout.first, symbolic.order.data(), 4 * symbolic.order.size());
  put(layout.first, layout.below, symbolic.first.data(), 4 * symbolic.first.size());
  std::fill(bytes + layout.below, bytes + layout.rows, std::uint8_t{0});
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    const std::int32_t below = symbolic.below(s);
    std::memcpy(bytes + layout.below + 4 * static_cast<std::size_t>(s), &below, sizeof below);
  }
  put(layout.rows, layout.values, symbolic.rows.data(), 4 * header.row_count);
  const std::uint64_t numbers = 8 * header.value_count;
  std::fill(bytes + layout.values + numbers, bytes + layout.length, std::uint8_t{0});
  const std::uint8_t* values = reinterpret_cast<const std::uint8_t*>(full.values().data());
  jobs.for_each(static_cast<std::uint32_t>((numbers + copy_step - 1) / copy_step), [&](std::uint32_t piece) {
    const std::uint64_t begin = piece * copy_step, end = std::min(numbers, begin + copy_step);
    std::memcpy(bytes + layout.values + begin, values + begin, end - begin);
  });
  header.checksum = hash_bytes(bytes + sizeof header, layout.length - sizeof header, memory, jobs,
                               [](std::uint64_t, std::uint64_t) {});
  header.header_check = check_of(header);
  std::memcpy(bytes, &header, sizeof header);
}

Ordering check_saved_factor(Span<const std::uint8_t> bytes) {
  return static_cast<Ordering>(read_header(bytes).ordering);
}

std::uint64_t saved_matrix_hash(Span<const std::uint8_t> bytes) { return read_header(bytes).matrix_hash; }

std::shared_ptr<const Factor> load_factor(Span<const std::uint8_t> bytes, const LoadOptions& options, Memory& memory,
                                          JobRunner& jobs) {
  const Timer timer;
  const Header header = read_header(bytes);
  if (header.unknowns != options.unknowns) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the saved factor has %d unknowns, %d are expected: it belongs to another mesh", header.unknowns,
         options.unknowns);
  }
  if (header.matrix_hash != options.matrix_hash) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the saved factor is of another mesh, or of other positions, links, weights or operator; save it again");
  }
  const std::uint8_t* given = bytes.data();
  if (options.borrow && reinterpret_cast<std::uintptr_t>(given) % saved_factor_alignment != 0) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "borrowed bytes must be aligned to %zu bytes; align them, or let them be copied", saved_factor_alignment);
  }
  const Layout layout(header);
  const std::uint64_t number_end = layout.values + 8 * header.value_count;
  std::shared_ptr<Analysis> analysis = make_shared_in<Analysis>(memory);
  Buffer<double> values;
  if (!options.borrow) values.allocate(memory, static_cast<std::size_t>(header.value_count) + value_slack);

  // One pass verifies the checksum, looks for NaN, and copies. The first touch of fresh memory costs more than the
  // copy, so all threads touch their pieces.
  const std::uint64_t checksum = hash_bytes(
      given + sizeof header, layout.length - sizeof header, memory, jobs, [&](std::uint64_t from, std::uint64_t to) {
        const std::uint64_t begin = std::max(layout.values, from + sizeof header);
        const std::uint64_t end = std::min(number_end, to + sizeof header);
        if (begin >= end) return;
        if (!finite_numbers(given + begin, (end - begin) / 8)) refuse("it holds NaN or infinity");
        if (!options.borrow)
          std::memcpy(reinterpret_cast<std::uint8_t*>(values.data()) + (begin - layout.values), given + begin,
                      end - begin);
      });
  if (checksum != header.checksum) refuse("its checksum is wrong");
  if (options.borrow) {
    values.borrow(reinterpret_cast<const double*>(given + layout.values),
                  static_cast<std::size_t>(header.value_count) + value_slack);
  } else {
    std::fill(values.data() + header.value_count, values.data() + values.size(), 0.0);
  }

  Symbolic& symbolic = analysis->symbolic;
  read_lists(given, layout, header, memory, symbolic);
  check_columns(symbolic);
  check_rows(symbolic, jobs);
  check_postorder(symbolic, memory);
  if (place_values(symbolic) != static_cast<std::int64_t>(header.value_count))
    refuse("its numbers do not fit its supernodes");
  check_diagonals(symbolic, values.data(), jobs);
  make_plan(symbolic, memory, analysis->plan);
  analysis->pattern_hash = header.pattern_hash;
  analysis->ordering = static_cast<Ordering>(header.ordering);
  analysis->loaded = true;
  std::shared_ptr<SupernodalFactor> factor = make_shared_in<SupernodalFactor>(memory, std::move(analysis), memory);
  factor->values() = std::move(values);
  factor->set_loaded(options.borrow, timer.milliseconds());
  return factor;
}

}  // namespace hf_inner::factor

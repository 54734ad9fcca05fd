#include "factor/factor_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "factor/numeric.h"
#include "factor/supernodal_factor.h"

namespace hf {
namespace {

constexpr std::uint64_t magic = 0x524F544341464648ull;  // "HFFACTOR"
constexpr std::uint32_t version = 1;
constexpr std::uint64_t copy_step = std::uint64_t{1} << 19;  // numbers a job copies

struct Header {
  std::uint64_t magic;
  std::uint32_t version;
  std::int32_t unknowns;
  std::int32_t supernodes;
  std::uint32_t reserved;
  std::uint64_t row_count;
  std::uint64_t value_count;
  std::uint64_t pattern_hash;
  double entries, flops;
  std::uint64_t length;
  std::uint64_t checksum;
  std::uint64_t header_check;  // checksum of the fields above
};
static_assert(sizeof(Header) == 88);

// Four independent chains of multiply and shift over 8-byte words.
std::uint64_t checksum_of(const std::uint8_t* bytes, std::uint64_t length) noexcept {
  std::uint64_t chain[4] = {1, 2, 3, 4};
  std::uint64_t k = 0;
  const auto mix = [](std::uint64_t state, std::uint64_t word) {
    state = (state ^ word) * 0x9E3779B97F4A7C15ull;
    return state ^ (state >> 32);
  };
  for (; k + 32 <= length; k += 32) {
    std::uint64_t word[4];
    std::memcpy(word, bytes + k, sizeof word);
    for (int c = 0; c < 4; ++c) chain[c] = mix(chain[c], word[c]);
  }
  for (; k < length; ++k) chain[k & 3] = mix(chain[k & 3], bytes[k]);
  return mix(mix(chain[0], chain[1]), mix(chain[2], chain[3]) ^ length);
}

// Bytes of each section for given sizes; no sum overflows for sizes below 2^59.
struct Layout {
  Layout(std::uint64_t unknowns, std::uint64_t supernodes, std::uint64_t row_count, std::uint64_t value_count) {
    order = sizeof(Header);
    first = order + 4 * unknowns;
    below = first + 4 * (supernodes + 1);
    rows = below + 4 * supernodes;
    values = (rows + 4 * row_count + 7) & ~std::uint64_t{7};
    length = values + 8 * value_count;
  }
  std::uint64_t order, first, below, rows, values, length;
};

[[noreturn]] void refuse(const char* what) {
  fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the bytes are no saved factor: %s; save it again with this library",
       what);
}

void read_lists(const std::uint8_t* bytes, const Layout& layout, const Header& header, Memory& memory, Symbolic& out) {
  const std::size_t n = static_cast<std::size_t>(header.unknowns), count = static_cast<std::size_t>(header.supernodes);
  out.size = header.unknowns, out.supernodes = header.supernodes;
  out.entries = header.entries, out.flops = header.flops;
  out.order.allocate(memory, n), out.position.allocate(memory, n), out.supernode.allocate(memory, n);
  out.first.allocate(memory, count + 1), out.parent.allocate(memory, count), out.subtree.allocate(memory, count);
  out.row_start.allocate(memory, count + 1), out.rows.allocate(memory, header.row_count + 16);
  out.value_start.allocate(memory, count), out.work.allocate(memory, count);
  if (n > 0) std::memcpy(out.order.data(), bytes + layout.order, 4 * n);
  std::memcpy(out.first.data(), bytes + layout.first, 4 * (count + 1));
  if (header.row_count > 0) std::memcpy(out.rows.data(), bytes + layout.rows, 4 * header.row_count);
  std::fill(out.rows.data() + header.row_count, out.rows.data() + header.row_count + 16, 0);
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

// Row lists ascend, lie below their columns, and go on in the parent: its columns or its list.
void check_rows(Symbolic& out) {
  for (std::int32_t s = 0; s < out.supernodes; ++s) {
    const std::int32_t* rows = out.row_list(s);
    const std::int32_t count = out.below(s);
    std::int32_t previous = out.first[s + 1] - 1;
    for (std::int32_t k = 0; k < count; ++k) {
      if (rows[k] <= previous || rows[k] >= out.size) refuse("a row list does not ascend inside the matrix");
      previous = rows[k];
    }
    out.parent[s] = count > 0 ? out.supernode[rows[0]] : -1;
  }
  for (std::int32_t s = 0; s < out.supernodes; ++s) {
    const std::int32_t parent = out.parent[s];
    if (parent < 0) continue;
    const std::int32_t *rows = out.row_list(s), *up = out.row_list(parent), *end = up + out.below(parent);
    for (std::int32_t k = 0; k < out.below(s); ++k) {
      if (rows[k] < out.first[parent + 1]) continue;
      while (up < end && *up < rows[k]) ++up;
      if (up == end || *up != rows[k]) refuse("a row list does not go on in its parent");
    }
  }
  // postorder: the subtree of s is the run of supernodes that ends in s
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

void place_values(Symbolic& out, std::uint64_t value_count) {
  std::int64_t next = 0;
  for (std::int32_t s = out.supernodes - 1; s >= 0; --s) {
    const std::int64_t width = out.columns(s), below = out.below(s);
    out.value_start[s] = next;
    next += width * (width + 1) / 2 + width * below;
    double work = 0;
    for (std::int64_t j = 0; j < width; ++j) work += static_cast<double>((width - j + below) * (width - j + below));
    out.work[s] = work;
  }
  out.stored_entries = static_cast<double>(next);
  if (next != static_cast<std::int64_t>(value_count)) refuse("its numbers do not fit its supernodes");
}

}  // namespace

std::uint64_t saved_factor_size(const Factor& factor) {
  const SupernodalFactor& full = static_cast<const SupernodalFactor&>(factor);
  const Symbolic& symbolic = full.symbolic();
  return Layout(static_cast<std::uint64_t>(symbolic.size), static_cast<std::uint64_t>(symbolic.supernodes),
                static_cast<std::uint64_t>(symbolic.row_start[symbolic.supernodes]),
                static_cast<std::uint64_t>(symbolic.stored_entries))
      .length;
}

void save_factor(const Factor& factor, Span<std::uint8_t> out) {
  const SupernodalFactor& full = static_cast<const SupernodalFactor&>(factor);
  const Symbolic& symbolic = full.symbolic();
  Header header{};
  header.magic = magic, header.version = version;
  header.unknowns = symbolic.size, header.supernodes = symbolic.supernodes;
  header.row_count = static_cast<std::uint64_t>(symbolic.row_start[symbolic.supernodes]);
  header.value_count = static_cast<std::uint64_t>(symbolic.stored_entries);
  header.pattern_hash = full.analysis()->pattern_hash;
  header.entries = symbolic.entries, header.flops = symbolic.flops;
  const Layout layout(static_cast<std::uint64_t>(symbolic.size), static_cast<std::uint64_t>(symbolic.supernodes),
                      header.row_count, header.value_count);
  header.length = layout.length;
  if (out.size() < layout.length) {
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "the saved factor takes %llu bytes, the buffer has %zu",
         static_cast<unsigned long long>(layout.length), out.size());
  }
  std::uint8_t* bytes = out.data();
  if (symbolic.size > 0) std::memcpy(bytes + layout.order, symbolic.order.data(), 4 * symbolic.order.size());
  std::memcpy(bytes + layout.first, symbolic.first.data(), 4 * symbolic.first.size());
  for (std::int32_t s = 0; s < symbolic.supernodes; ++s) {
    const std::int32_t below = symbolic.below(s);
    std::memcpy(bytes + layout.below + 4 * static_cast<std::size_t>(s), &below, sizeof below);
  }
  if (header.row_count > 0) std::memcpy(bytes + layout.rows, symbolic.rows.data(), 4 * header.row_count);
  std::fill(bytes + layout.rows + 4 * header.row_count, bytes + layout.values, std::uint8_t{0});
  if (header.value_count > 0) std::memcpy(bytes + layout.values, full.values().data(), 8 * header.value_count);
  header.checksum = checksum_of(bytes + sizeof header, layout.length - sizeof header);
  header.header_check = checksum_of(reinterpret_cast<const std::uint8_t*>(&header), offsetof(Header, header_check));
  std::memcpy(bytes, &header, sizeof header);
}

std::shared_ptr<const Factor> load_factor(Span<const std::uint8_t> bytes, std::int32_t unknowns, Memory& memory,
                                          JobRunner* jobs) {
  Header header;
  if (bytes.size() < sizeof header) refuse("too short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != magic) refuse("wrong beginning");
  if (header.version != version) {
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "the saved factor has version %u, this library reads %u; save it again",
         header.version, version);
  }
  if (header.header_check != checksum_of(bytes.data(), offsetof(Header, header_check))) refuse("its header is damaged");
  constexpr std::uint64_t most = std::uint64_t{1} << 48;
  if (header.unknowns < 0 || header.supernodes < 0 || header.supernodes > header.unknowns || header.row_count > most ||
      header.value_count > most) {
    refuse("its sizes make no sense");
  }
  if (header.unknowns != unknowns) {
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the saved factor has %d unknowns, %d are expected: it belongs to another mesh", header.unknowns, unknowns);
  }
  const Layout layout(static_cast<std::uint64_t>(header.unknowns), static_cast<std::uint64_t>(header.supernodes),
                      header.row_count, header.value_count);
  if (layout.length != header.length || layout.length != bytes.size()) refuse("its length is wrong");
  if (header.checksum != checksum_of(bytes.data() + sizeof header, layout.length - sizeof header))
    refuse("its checksum is wrong");
  std::shared_ptr<Analysis> analysis = make_shared_in<Analysis>(memory);
  Symbolic& symbolic = analysis->symbolic;
  read_lists(bytes.data(), layout, header, memory, symbolic);
  check_columns(symbolic);
  check_rows(symbolic);
  check_postorder(symbolic, memory);
  place_values(symbolic, header.value_count);
  make_plan(symbolic, memory, analysis->plan);
  analysis->pattern_hash = header.pattern_hash;
  analysis->loaded = true;
  std::shared_ptr<SupernodalFactor> factor = make_shared_in<SupernodalFactor>(memory, std::move(analysis), memory);
  Buffer<double>& values = factor->values();
  values.allocate(memory, header.value_count + value_slack);
  // fresh memory costs more at its first touch than the copy does: all threads touch their part
  auto copy = [&](std::uint32_t piece) {
    const std::uint64_t begin = piece * copy_step, end = std::min<std::uint64_t>(header.value_count, begin + copy_step);
    std::memcpy(values.data() + begin, bytes.data() + layout.values + 8 * begin, 8 * (end - begin));
    if (!all_finite(values.data() + begin, end - begin)) refuse("it holds NaN or infinity");
  };
  const std::uint32_t pieces = static_cast<std::uint32_t>((header.value_count + copy_step - 1) / copy_step);
  if (jobs) {
    jobs->for_each(pieces, copy);
  } else {
    for (std::uint32_t piece = 0; piece < pieces; ++piece) copy(piece);
  }
  std::fill(values.data() + header.value_count, values.data() + header.value_count + value_slack, 0.0);
  return factor;
}

}  // namespace hf

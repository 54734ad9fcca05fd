#include "factor/minimum_degree.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"

namespace hf_inner::factor {
namespace {

// Vertices with more neighbours than this times sqrt(n) are eliminated last: trades time for the factor's size. The AMD
// library uses the same value. With 5 and 20, a graph of 64,000 vertices, 30 of them with very many neighbours, gets
// the same order. Without such a limit, a vertex with 200,000 neighbours takes minutes.
constexpr double dense_factor = 10;
// Pivots between two checks for a cancel: 64 pivots of factor_test take 2 to 90 us. No result depends on it.
constexpr std::uint32_t pivots_per_poll = 64;

// The quotient graph of an elimination. A variable stands for unknowns with equal neighbours, an element for an
// eliminated variable. The list of a variable holds elements first, then variables. The list of an element holds
// variables.
class QuotientGraph {
 public:
  QuotientGraph(Index size, const Index* start, const Index* neighbour, Memory& memory)
      : size_(size), lists_(memory, room_for(size, start)), storage_(memory, at(size) * array_count) {
    Index** arrays[array_count] = {&start_, &length_,   &elements_, &weight_, &degree_, &mark_,       &next_,
                                   &last_,  &previous_, &bucket_,   &hashed_, &hash_,   &next_member_};
    for (std::size_t k = 0; k < array_count; ++k) *arrays[k] = storage_.data() + k * at(size);
    read(start, neighbour);
  }

  // Eliminates all unknowns. order[k] is the unknown eliminated k-th.
  void run(Index* order) {
    order_ = order;
    take_special();
    Poller poller(pivots_per_poll);
    while (left_ > 0) {
      poller.due();
      const Index pivot = take_least();
      form_element(pivot);
      subtract_from_elements(pivot);
      update_degrees(pivot);
      merge_equal(pivot);
      file_again(pivot);
    }
    for (Index v = 0; v < size_; ++v) {
      if (is_dense(v)) order_[ordered_++] = v;
    }
  }

 private:
  static constexpr std::size_t array_count = 13;
  static constexpr Index none = -1;
  static constexpr Index dense_mark = -2;  // value in last_ of vertices that are eliminated at the end

  // Returns the number of array entries for all lists of neighbours, plus one entry. A fifth is spare, so that the
  // lists are seldom compacted.
  static std::size_t room_for(Index size, const Index* start) {
    const std::size_t pattern = at(start[size] - start[0]), room = pattern + pattern / 5 + at(size) + 1;
    if (room > static_cast<std::size_t>(INT32_MAX)) {
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the matrix has %zu entries; minimum degree takes at most about 1.7e9",
           pattern);
    }
    return room;
  }

  bool is_dense(Index v) const noexcept { return last_[v] == dense_mark; }

  void read(const Index* start, const Index* neighbour) {
    for (Index v = 0; v < size_; ++v) {
      start_[v] = free_;
      for (Index e = start[v]; e < start[v + 1]; ++e) {
        if (neighbour[e] != v) lists_[free_++] = neighbour[e];
      }
      length_[v] = degree_[v] = free_ - start_[v];
      elements_[v] = 0;
      weight_[v] = 1;
      mark_[v] = 1;
      last_[v] = v;
      next_member_[v] = none;
      bucket_[v] = hashed_[v] = none;
    }
    left_ = size_;
  }

  // Vertices without neighbours are eliminated first, those with very many neighbours last. The others go to the lists
  // of their degree.
  void take_special() {
    const double limit = dense_factor * std::sqrt(static_cast<double>(size_));
    for (Index v = 0; v < size_; ++v) {
      if (degree_[v] == 0) {
        order_[ordered_++] = v;
        weight_[v] = mark_[v] = 0;
        --left_;
      } else if (degree_[v] > limit) {
        last_[v] = dense_mark;
        weight_[v] = mark_[v] = length_[v] = 0;
        --left_;
      } else {
        file(v, degree_[v]);
      }
    }
  }

  // ---- doubly linked lists of the variables of each degree

  void file(Index v, Index degree) noexcept {
    const Index first = bucket_[degree];
    next_[v] = first;
    previous_[v] = none;
    if (first != none) previous_[first] = v;
    bucket_[degree] = v;
    least_ = std::min(least_, degree);
  }

  void unfile(Index v) noexcept {
    const Index before = previous_[v], after = next_[v];
    if (after != none) previous_[after] = before;
    if (before != none)
      next_[before] = after;
    else
      bucket_[degree_[v]] = after;
  }

  Index take_least() noexcept {
    while (bucket_[least_] == none) ++least_;
    const Index pivot = bucket_[least_];
    unfile(pivot);
    return pivot;
  }

  // Writes the unknowns that variable v stands for to the elimination order.
  void eliminate(Index v) noexcept {
    for (Index u = v; u != none; u = next_member_[u]) order_[ordered_++] = u;
  }

  // ---- the new element

  // Makes the variable that is eliminated (pivot) an element. Its list gets the variables next to it and next to its
  // neighbouring elements, which it absorbs. These variables get negative weights and leave the lists of their degree.
  void form_element(Index pivot) {
    const Index pivot_weight = weight_[pivot];
    left_ -= pivot_weight;
    weight_[pivot] = -pivot_weight;
    pivot_degree_ = 0;
    Index begin, end;
    if (elements_[pivot] == 0) {  // the new list replaces the pivot's own
      begin = end = start_[pivot];
      gather(begin, length_[pivot], end);
    } else {
      make_room(pivot);
      begin = end = free_;
      const Index first = start_[pivot], variables = first + elements_[pivot], stop = first + length_[pivot];
      for (Index k = first; k < variables; ++k) {
        const Index e = lists_[at(k)];
        gather(start_[e], length_[e], end);
        mark_[e] = length_[e] = 0;
      }
      gather(variables, stop - variables, end);
      free_ = end;
    }
    eliminate(pivot);
    start_[pivot] = begin;
    length_[pivot] = end - begin;
    pivot_end_ = end;
    elements_[pivot] = none;  // marks it as an element
  }

  void gather(Index from, Index count, Index& end) noexcept {
    for (Index k = from; k < from + count; ++k) {
      const Index v = lists_[at(k)], weight = weight_[v];
      if (weight <= 0) continue;  // variable v is absorbed by another, or already in the list
      pivot_degree_ += weight;
      weight_[v] = -weight;
      lists_[at(end++)] = v;
      unfile(v);
    }
  }

  // Makes room for the list of the variable that is eliminated (pivot), behind all other lists.
  void make_room(Index pivot) {
    std::size_t need = at(length_[pivot] - elements_[pivot]);
    for (Index k = start_[pivot]; k < start_[pivot] + elements_[pivot]; ++k) need += at(length_[lists_[at(k)]]);
    need = std::min(need, at(left_));
    if (at(free_) + need > lists_.size()) compact();
  }

  // Moves all lists of neighbours together. While they move, the first entry of each list is replaced by the complement
  // of its owner's number.
  void compact() noexcept {
    for (Index v = 0; v < size_; ++v) {
      if (length_[v] == 0) continue;
      const Index place = start_[v];
      start_[v] = lists_[at(place)];
      lists_[at(place)] = ~v;
    }
    Index to = 0;
    for (Index from = 0; from < free_;) {
      const Index owner = ~lists_[at(from)];
      if (owner < 0) {
        ++from;
        continue;
      }
      const Index count = length_[owner], first = start_[owner];
      start_[owner] = to;
      lists_[at(to)] = first;
      for (Index k = 1; k < count; ++k) lists_[at(to + k)] = lists_[at(from + k)];
      to += count;
      from += count;
    }
    free_ = to;
  }

  // ---- degrees

  // Looks at every element e (eliminated variable) beside the pivot's variables. mark_[e] - tag_ becomes the number of
  // unknowns in variables of e that are not the pivot's.
  void subtract_from_elements(Index pivot) noexcept {
    most_ = std::max(most_, pivot_degree_);
    clear_marks();
    for (Index k = start_[pivot]; k < start_[pivot] + length_[pivot]; ++k) {
      const Index v = lists_[at(k)], weight = -weight_[v];
      for (Index p = start_[v]; p < start_[v] + elements_[v]; ++p) {
        const Index e = lists_[at(p)];
        if (mark_[e] >= tag_)
          mark_[e] -= weight;
        else if (mark_[e] != 0)
          mark_[e] = degree_[e] + tag_ - weight;
      }
    }
  }

  // Restarts the step numbers (tags) in mark_ before they overflow. A mark of 0 (absorbed into another element) stays.
  void clear_marks() noexcept {
    if (tag_ <= INT32_MAX - 2 * std::int64_t{size_}) return;
    for (Index v = 0; v < size_; ++v) mark_[v] = mark_[v] != 0;
    tag_ = 2;
  }

  // Shortens the lists of the variables beside the pivot and bounds their degrees. Variables without other neighbours
  // are eliminated at once. The others go to hash lists, which find equal ones.
  void update_degrees(Index pivot) noexcept {
    const Index begin = start_[pivot], end = begin + length_[pivot];
    Index kept = begin;
    for (Index k = begin; k < end; ++k) {
      const Index v = lists_[at(k)];
      std::uint32_t hash = static_cast<std::uint32_t>(pivot);
      const Index outside = shorten(v, pivot, hash);
      if (outside == 0) {
        const Index weight = -weight_[v];
        pivot_degree_ -= weight;
        left_ -= weight;
        eliminate(v);
        weight_[v] = mark_[v] = length_[v] = 0;
        elements_[v] = none;
        continue;
      }
      degree_[v] = std::min(degree_[v], outside);
      hash_[v] = static_cast<Index>(hash % static_cast<std::uint32_t>(size_));
      next_[v] = hashed_[hash_[v]];
      hashed_[hash_[v]] = v;
      lists_[at(kept++)] = v;
    }
    length_[pivot] = kept - begin;
    degree_[pivot] = pivot_degree_;
  }

  // Shortens the neighbour list of variable v. It keeps the pivot, the elements (eliminated variables) that reach
  // outside the pivot's list, and the variables outside it. Returns the number of unknowns outside, counted twice where
  // two elements overlap.
  Index shorten(Index v, Index pivot, std::uint32_t& hash) noexcept {
    const Index first = start_[v], variables = first + elements_[v], stop = first + length_[v];
    std::int64_t outside = 0;
    Index to = first;
    for (Index p = first; p < variables; ++p) {
      const Index e = lists_[at(p)], rest = mark_[e] - tag_;
      if (mark_[e] == 0) continue;
      if (rest > 0) {
        outside += rest;
        hash += static_cast<std::uint32_t>(e);
        lists_[at(to++)] = e;
      } else {
        mark_[e] = length_[e] = 0;  // the element lies inside the pivot's list and is absorbed
      }
    }
    const Index kept = to;
    for (Index p = variables; p < stop; ++p) {
      const Index u = lists_[at(p)], weight = weight_[u];
      if (weight <= 0) continue;
      outside += weight;
      hash += static_cast<std::uint32_t>(u);
      lists_[at(to++)] = u;
    }
    // The pivot becomes the first element; the first entry moves behind the other elements.
    lists_[at(to++)] = lists_[at(kept)];
    lists_[at(kept)] = lists_[at(first)];
    lists_[at(first)] = pivot;
    elements_[v] = kept - first + 1;
    length_[v] = to - first;
    return static_cast<Index>(std::min<std::int64_t>(outside, size_));
  }

  // ---- variables with equal neighbours

  void merge_equal(Index pivot) noexcept {
    tag_ += most_;
    clear_marks();
    for (Index k = start_[pivot]; k < start_[pivot] + length_[pivot]; ++k) {
      const Index v = lists_[at(k)];
      if (weight_[v] == 0) continue;
      Index first = hashed_[hash_[v]];
      hashed_[hash_[v]] = none;
      for (; first != none && next_[first] != none; first = next_[first]) merge_into(first);
    }
    clear_marks();
  }

  // Compares the variable v with those after it in its hash list. Merges those with equal neighbours into v.
  void merge_into(Index v) noexcept {
    const Index length = length_[v], elements = elements_[v];
    for (Index p = start_[v]; p < start_[v] + length; ++p) mark_[lists_[at(p)]] = tag_;
    Index before = v;
    for (Index u = next_[v]; u != none; u = next_[u]) {
      bool equal = length_[u] == length && elements_[u] == elements;
      for (Index p = start_[u]; equal && p < start_[u] + length; ++p) equal = mark_[lists_[at(p)]] == tag_;
      if (!equal) {
        before = u;
        continue;
      }
      weight_[v] += weight_[u];
      weight_[u] = mark_[u] = length_[u] = 0;
      elements_[u] = none;
      next_member_[last_[v]] = u;
      last_[v] = last_[u];
      next_[before] = next_[u];
    }
    ++tag_;
  }

  // Puts the remaining variables of the pivot's list into the degree lists, by their new degrees.
  void file_again(Index pivot) noexcept {
    const Index begin = start_[pivot], end = begin + length_[pivot];
    Index kept = begin;
    for (Index k = begin; k < end; ++k) {
      const Index v = lists_[at(k)], weight = -weight_[v];
      if (weight <= 0) continue;  // v was merged into another variable
      weight_[v] = weight;
      const std::int64_t bound = std::int64_t{degree_[v]} + pivot_degree_ - weight;
      degree_[v] = static_cast<Index>(std::min<std::int64_t>(bound, left_ - weight));
      file(v, degree_[v]);
      lists_[at(kept++)] = v;
    }
    weight_[pivot] = 0;
    length_[pivot] = kept - begin;
    if (kept == begin) mark_[pivot] = 0;  // the new element has no variable left
    if (free_ == pivot_end_) free_ = kept;
  }

  Index size_;
  Buffer<Index> lists_, storage_;
  // The end of the neighbour lists in storage.
  Index free_ = 0;
  // The unknowns that are not yet eliminated, without the dense ones.
  Index left_ = 0;
  // The places of the elimination order that are filled.
  Index ordered_ = 0;
  // No variable has a smaller degree than this.
  Index least_ = 0;
  // The largest weight of an element so far.
  Index most_ = 0;
  // Entries of mark_ from this number on belong to the present step.
  Index tag_ = 2;
  // The weight of the pivot's list, and where that list ended before it was shortened.
  Index pivot_degree_ = 0, pivot_end_ = 0;
  Index* order_ = nullptr;
  // Where the list of a variable or an element begins, and how long it is.
  Index *start_, *length_;
  // How many elements stand at the start of the list of a variable; none: it is no variable.
  Index* elements_;
  // How many unknowns a variable stands for. It is negative while the variable is in the pivot's list, and 0 once the
  // variable is absorbed.
  Index* weight_;
  // A bound of the degree of a variable, or the weight of the list of an element.
  Index* degree_;
  // See subtract_from_elements; 0: absorbed.
  Index* mark_;
  // The next entry of a degree list or a hash list. The last unknown that a variable stands for.
  Index *next_, *last_;
  // The previous entry of a degree list. The first variable of a degree.
  Index *previous_, *bucket_;
  // The first variable of a hash. The hash of a variable.
  Index *hashed_, *hash_;
  // The next of the unknowns that a variable stands for.
  Index* next_member_;
};

}  // namespace

void order_graph_by_minimum_degree(std::int32_t size, const std::int32_t* start, const std::int32_t* neighbour,
                                   Memory& memory, Buffer<std::int32_t>& order) {
  order.allocate(memory, at(size));
  if (size > 0) QuotientGraph(size, start, neighbour, memory).run(order.data());
}

}  // namespace hf_inner::factor

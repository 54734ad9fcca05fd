// Which inner vertices of two meshes of one family (Geometry::is_kin) are the same.
#pragma once
#include <algorithm>
#include <iterator>

#include "base/differences.h"
#include "base/index.h"
#include "mesh/mesh.h"

namespace hf_inner::surface {

class VertexMap {
 public:
  VertexMap(const mesh::Mesh& before, const mesh::Mesh& after, Memory& memory)
      : before_(before.given_of_inner),
        after_(after.given_of_inner),
        keeps_numbers_(before.numbering == after.numbering),
        again_(&memory),
        to_(&memory),
        from_(&memory),
        went_(&memory),
        fresh_(&memory) {
    std::set_symmetric_difference(before.returned.begin(), before.returned.end(), after.returned.begin(),
                                  after.returned.end(), std::back_inserter(again_));
    if (keeps_numbers_) {
      const std::size_t both = std::min(before_.size(), after_.size());
      for_differences(before_.data(), after_.data(), both,
                      [&](std::size_t v) { went_.push_back(static_cast<Index>(v)); });
      for (const Index given : again_) {
        if (at(given) >= before.inner_of_given.size()) continue;
        const Index v = before.inner_of_given[at(given)];
        if (v != mesh::Mesh::none && at(v) < both && after_[at(v)] == given && before_[at(v)] == given)
          went_.push_back(v);
      }
      std::sort(went_.begin(), went_.end());
      went_.erase(std::unique(went_.begin(), went_.end()), went_.end());
      fresh_.assign(went_.begin(), went_.end());
      for (std::size_t v = both; v < before_.size(); ++v) went_.push_back(static_cast<Index>(v));
      for (std::size_t v = both; v < after_.size(); ++v) fresh_.push_back(static_cast<Index>(v));
      return;
    }
    to_.assign(before_.size(), mesh::Mesh::none);
    from_.assign(after_.size(), mesh::Mesh::none);
    for (std::size_t v = 0; v < from_.size(); ++v) {
      const std::size_t given = at(after_[v]);
      const Index u = given < before.inner_of_given.size() ? before.inner_of_given[given] : mesh::Mesh::none;
      if (u == mesh::Mesh::none || came_again(after_[v])) continue;
      from_[v] = u;
      to_[at(u)] = static_cast<Index>(v);
    }
    for (std::size_t u = 0; u < to_.size(); ++u)
      if (to_[u] == mesh::Mesh::none) went_.push_back(static_cast<Index>(u));
    for (std::size_t v = 0; v < from_.size(); ++v)
      if (from_[v] == mesh::Mesh::none) fresh_.push_back(static_cast<Index>(v));
  }

  Index before_count() const noexcept { return static_cast<Index>(before_.size()); }
  Index after_count() const noexcept { return static_cast<Index>(after_.size()); }
  // The vertices before that are not after, and the vertices after that were not before; ascending.
  const Vector<Index>& went() const noexcept { return went_; }
  const Vector<Index>& fresh() const noexcept { return fresh_; }
  // Whether vertices that stay have the same numbers.
  bool keeps_numbers() const noexcept { return keeps_numbers_; }
  // The number after of a vertex before, or none, and the other way round. A vertex that went and came again in between
  // is a new one. Numbers ascend where they are not none, if one mesh was made of the other by patches.
  Index to(Index u) const noexcept { return keeps_numbers_ ? (is_kept(u) ? u : mesh::Mesh::none) : to_[at(u)]; }
  Index from(Index v) const noexcept { return keeps_numbers_ ? (is_kept(v) ? v : mesh::Mesh::none) : from_[at(v)]; }

 private:
  bool is_kept(Index v) const noexcept {
    return at(v) < std::min(before_.size(), after_.size()) && before_[at(v)] == after_[at(v)] &&
           !came_again(before_[at(v)]);
  }
  bool came_again(Index given) const noexcept {
    return !again_.empty() && std::binary_search(again_.begin(), again_.end(), given);
  }
  SharedVector<Index> before_, after_;  // the vertex of the caller, by inner vertex
  bool keeps_numbers_;
  Vector<Index> again_;  // vertices of the caller that came again on one way from the common mesh alone, ascending
  Vector<Index> to_, from_, went_, fresh_;
};

}  // namespace hf_inner::surface

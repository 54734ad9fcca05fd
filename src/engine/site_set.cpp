#include "engine/site_set.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace hf {
namespace {

std::size_t at(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

bool same_site(const Site& a, const Site& b) noexcept {
  return a.component == b.component && a.compliance == b.compliance && std::equal(a.vertex, a.vertex + 3, b.vertex) &&
         std::equal(a.weight, a.weight + 3, b.weight);
}

}  // namespace

void SiteSet::swap(SiteSet& other) noexcept {
  slots_.swap(other.slots_), values_.swap(other.values_), by_vertex_.swap(other.by_vertex_);
  std::swap(channels_, other.channels_), std::swap(count_, other.count_);
}

void SiteSet::check_site(std::uint32_t position, std::uint32_t site) const {
  if (site >= slots_.size() || !slots_[site].used())
    fail(HF_ERROR_NO_SUCH_SITE, position, "entry %u of the list: there is no site %u (removed already, or never added)",
         position, site);
}

Site SiteSet::locate(const Mesh& mesh, const Places& places, std::uint32_t i) const {
  if (places.vertices) {
    const std::uint32_t given = places.vertices[i];
    if (given >= mesh.report.vertex_count)
      fail(HF_ERROR_OUT_OF_RANGE, i, "site %u of the batch: vertex %u, but there are %u vertices", i, given,
           mesh.report.vertex_count);
    const std::int32_t inner = mesh.inner_of_given[given];
    if (inner == Mesh::none)
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "site %u of the batch: vertex %u belongs to no usable triangle; choose a vertex of the surface", i, given);
    return Site::at_vertex(mesh, inner);
  }
  const std::uint32_t given = places.triangles[i];
  if (given >= mesh.report.triangle_count)
    fail(HF_ERROR_OUT_OF_RANGE, i, "site %u of the batch: triangle %u, but there are %u triangles", i, given,
         mesh.report.triangle_count);
  const std::int32_t triangle = mesh.triangle_of_given[given];
  if (triangle == Mesh::none)
    fail(HF_ERROR_INVALID_ARGUMENT, i, "site %u of the batch: triangle %u has equal corners; choose another", i, given);
  double sum = 0;
  Site site;
  for (int k = 0; k < 3; ++k) {
    const double w = places.barycentrics[std::size_t{3} * i + static_cast<std::size_t>(k)];
    if (!std::isfinite(w))
      fail(HF_ERROR_NON_FINITE, i, "site %u of the batch: barycentric weight %d is not a finite number", i, k);
    if (w < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "site %u of the batch: barycentric weight %d is %g; weights must not be negative", i, k, w);
    site.weight[k] = w, sum += w;
  }
  if (!(std::fabs(sum - 1) <= 1e-6))
    fail(HF_ERROR_INVALID_ARGUMENT, i, "site %u of the batch: barycentric weights sum to %.9g; they must sum to 1", i,
         sum);
  for (int k = 0; k < 3; ++k) {
    site.vertex[k] = mesh.triangle(triangle)[k], site.weight[k] /= sum;
    if (site.weight[k] > 1 - 1e-12) return Site::at_vertex(mesh, site.vertex[k]);  // a corner is a vertex site
  }
  site.component = mesh.component[at(site.vertex[0])];
  return site;
}

const SiteSet::AtVertex* SiteSet::find_vertex(std::int32_t vertex) const noexcept {
  const auto it = std::lower_bound(by_vertex_.begin(), by_vertex_.end(), vertex,
                                   [](const AtVertex& a, std::int32_t v) { return a.vertex < v; });
  return it != by_vertex_.end() && it->vertex == vertex ? &*it : nullptr;
}

void SiteSet::claim_vertex(std::uint32_t position, std::uint32_t given, const Site& site, std::int32_t slot,
                           const double* values, double stiffness) {
  if (!site.is_vertex()) return;
  if (const AtVertex* there = find_vertex(site.vertex[0])) {
    const Slot& other = slots_[at(there->slot)];
    bool same = other.stiffness == stiffness;
    for (std::int32_t c = 0; c < channels_; ++c)
      same = same && values_[at(there->slot * channels_ + c)] == (values ? values[c] : 0.0);
    fail(same ? HF_ERROR_DUPLICATE_SITE : HF_ERROR_CONFLICT, position,
         "site %u of the batch: vertex %u%s carries site %d already%s; set its values or move it", position, given,
         other.given_vertex == given ? "" : " (through a copy at the same place)", there->slot,
         same ? "" : " with other values");
  }
  const auto it = std::lower_bound(by_vertex_.begin(), by_vertex_.end(), site.vertex[0],
                                   [](const AtVertex& a, std::int32_t v) { return a.vertex < v; });
  by_vertex_.insert(it, AtVertex{site.vertex[0], slot});
}

void SiteSet::release_vertex(std::int32_t slot) noexcept {
  const Site& site = slots_[at(slot)].site;
  if (!site.is_vertex()) return;
  const AtVertex* there = find_vertex(site.vertex[0]);
  if (there && there->slot == slot) by_vertex_.erase(by_vertex_.begin() + (there - by_vertex_.data()));
}

void SiteSet::remove(std::uint32_t count, const std::uint32_t* sites) {
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(i, sites[i]);
    const std::int32_t slot = static_cast<std::int32_t>(sites[i]);
    release_vertex(slot);
    slots_[sites[i]] = Slot{};
    std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(slot) * channels_, channels_, 0.0);
    --count_;
  }
}

void SiteSet::move(const Mesh& mesh, std::uint32_t count, const std::uint32_t* sites, const Places& to) {
  // all leave before any arrives, so that sites may swap places
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(i, sites[i]);
    for (std::uint32_t j = 0; j < i && count <= 64; ++j) {
      if (sites[j] == sites[i])
        fail(HF_ERROR_NO_SUCH_SITE, i, "entry %u of the list: site %u is named twice", i, sites[i]);
    }
    release_vertex(static_cast<std::int32_t>(sites[i]));
    slots_[sites[i]].given_vertex = HF_NO_INDEX - 1;  // under way
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    Slot& slot = slots_[sites[i]];
    if (slot.given_vertex != HF_NO_INDEX - 1)
      fail(HF_ERROR_NO_SUCH_SITE, i, "entry %u of the list: site %u is named twice", i, sites[i]);
    Site site = locate(mesh, to, i);
    site.compliance = slot.site.compliance;
    const std::uint32_t given = to.vertices ? to.vertices[i] : HF_NO_INDEX;
    claim_vertex(i, given, site, static_cast<std::int32_t>(sites[i]),
                 values_.data() + std::size_t{sites[i]} * at(channels_), slot.stiffness);
    slot.site = site, slot.given_vertex = given;
  }
}

void SiteSet::set_values(std::uint32_t count, const std::uint32_t* sites, const double* values) {
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(i, sites[i]);
    for (std::int32_t c = 0; c < channels_; ++c) {
      const double value = values[std::size_t{i} * at(channels_) + at(c)];
      if (!std::isfinite(value))
        fail(HF_ERROR_NON_FINITE, i, "entry %u of the list: value of channel %d is not a finite number", i, c);
      values_[std::size_t{sites[i]} * at(channels_) + at(c)] = value;
    }
  }
}

void SiteSet::add(const Mesh& mesh, const Places& places, const double* values, const double* stiffness,
                  std::uint32_t limit, std::uint32_t* out_sites) {
  if (places.count > limit || count_ > limit - places.count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u sites and %u more; the site_limit is %u", count_, places.count, limit);
  std::size_t free = 0;
  for (std::uint32_t i = 0; i < places.count; ++i) {
    Site site = locate(mesh, places, i);
    double given_stiffness = stiffness ? stiffness[i] : 0.0;
    if (!std::isfinite(given_stiffness))
      fail(HF_ERROR_NON_FINITE, i, "site %u of the batch: stiffness is not a finite number", i);
    if (given_stiffness < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "site %u of the batch: stiffness is %g; use 0 for a hard site or a number above 0", i, given_stiffness);
    if (given_stiffness > 0) given_stiffness = std::min(std::max(given_stiffness, 1e-12), 1e12);
    site.compliance = given_stiffness > 0 ? 1 / given_stiffness : 0.0;
    const double* own = values ? values + std::size_t{i} * at(channels_) : nullptr;
    for (std::int32_t c = 0; own && c < channels_; ++c) {
      if (!std::isfinite(own[c]))
        fail(HF_ERROR_NON_FINITE, i, "site %u of the batch: value of channel %d is not a finite number", i, c);
    }
    while (free < slots_.size() && slots_[free].used()) ++free;
    const std::uint32_t given = places.vertices ? places.vertices[i] : HF_NO_INDEX;
    claim_vertex(i, given, site, static_cast<std::int32_t>(free), own, given_stiffness);
    if (free == slots_.size()) {
      slots_.push_back(Slot{});
      values_.resize(slots_.size() * at(channels_), 0.0);
    }
    slots_[free].site = site, slots_[free].given_vertex = given, slots_[free].stiffness = given_stiffness;
    if (own) std::copy_n(own, channels_, values_.begin() + static_cast<std::ptrdiff_t>(free) * channels_);
    if (out_sites) out_sites[i] = static_cast<std::uint32_t>(free);
    ++count_;
  }
}

SiteDifference::SiteDifference(const SiteSet& from, const SiteSet& to, Memory& memory) : SiteDifference(memory) {
  const Span<const SiteSet::Slot> before = from.slots(), after = to.slots();
  const std::size_t slots = std::max(before.size(), after.size());
  for (std::size_t s = 0; s < slots; ++s) {
    const bool was = s < before.size() && before[s].used(), is = s < after.size() && after[s].used();
    if (was && is && same_site(before[s].site, after[s].site)) continue;
    if (was) remove.push_back(static_cast<std::int32_t>(s));
    if (is) add.push_back(static_cast<std::int32_t>(s)), sites.push_back(after[s].site);
  }
}

}  // namespace hf

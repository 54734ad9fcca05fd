#include "solve/site_set.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "mesh/geodesic_disc.h"
#include "surface/rim.h"

namespace hf_inner::solve {
namespace {

Site site_at(const mesh::Mesh& mesh, const mesh::SurfacePlace& place) noexcept {
  Site site;
  std::copy_n(place.vertex, 3, site.vertex);
  std::copy_n(place.weight, 3, site.weight);
  site.component = mesh.component[at(place.vertex[0])];
  return site;
}

// The vertex of a place: the caller's number, or the number of the first copy. HF_NO_INDEX for other places.
std::uint32_t vertex_given(const mesh::Mesh& mesh, const mesh::Places& places, std::uint32_t i,
                           const Site& site) noexcept {
  if (places.vertices) return places.vertices[i];
  return site.is_vertex() ? mesh::given_vertex(mesh, site.vertex[0]) : HF_NO_INDEX;
}

// Range of the stiffness, in mean diagonals of K, as hf/solver.h documents. Beyond it the system loses digits.
constexpr double least_stiffness = 1e-12, most_stiffness = 1e12;

bool same_site(const Site& a, const Site& b) noexcept {
  return a.component == b.component && a.compliance == b.compliance && std::equal(a.vertex, a.vertex + 3, b.vertex) &&
         std::equal(a.weight, a.weight + 3, b.weight);
}

}  // namespace

void check_site_count(std::uint32_t count, std::uint32_t there) {
  if (count > there) fail(HF_ERROR_NOT_FOUND, there, "%u sites named, but there are %u", count, there);
}

void SiteSet::swap(SiteSet& other) noexcept {
  slots_.swap(other.slots_);
  values_.swap(other.values_);
  by_vertex_.swap(other.by_vertex_);
  std::swap(channels_, other.channels_);
  std::swap(count_, other.count_);
  std::swap(hidden_, other.hidden_);
  std::swap(numbers_, other.numbers_);
}

void SiteSet::check_site(std::uint32_t position, std::uint32_t site) const {
  if (site >= slots_.size() || !slots_[site].is_site())
    fail(HF_ERROR_NOT_FOUND, position, "entry %u of the list: there is no site %u (removed already, or never added)",
         position, site);
}

const SiteSet::AtVertex* SiteSet::find_vertex(std::int32_t vertex) const noexcept {
  const auto it = std::lower_bound(by_vertex_.begin(), by_vertex_.end(), vertex,
                                   [](const AtVertex& a, std::int32_t v) { return a.vertex < v; });
  return it != by_vertex_.end() && it->vertex == vertex ? &*it : nullptr;
}

void SiteSet::claim_vertex(const Arrival& arrival, std::int32_t vertex, std::int32_t slot) {
  const auto it = std::lower_bound(by_vertex_.begin(), by_vertex_.end(), vertex,
                                   [](const AtVertex& a, std::int32_t v) { return a.vertex < v; });
  if (it == by_vertex_.end() || it->vertex != vertex) {
    by_vertex_.insert(it, AtVertex{vertex, slot});
    return;
  }
  const Slot& other = slots_[at(it->slot)];
  bool same = other.stiffness == arrival.stiffness;
  for (std::int32_t c = 0; c < channels_; ++c)
    same = same && values_[at(it->slot * channels_ + c)] == (arrival.values ? arrival.values[c] : 0.0);
  const hf_result code = same ? HF_ERROR_DUPLICATE : HF_ERROR_CONFLICT;
  if (arrival.radius > 0 || other.radius > 0)
    fail(code, arrival.position,
         "site %u of the batch: its place overlaps site %d%s; use a smaller radius, or move one of them",
         arrival.position, it->slot, same ? "" : ", which has other values");
  fail(code, arrival.position, "site %u of the batch: vertex %u%s carries site %d already%s; set its values or move it",
       arrival.position, arrival.given_vertex,
       other.given_vertex == arrival.given_vertex ? "" : " (through a copy at the same place)", it->slot,
       same ? "" : " with other values");
}

// Frees the vertices of a site, and the hidden sites that make up its disc. The site keeps its own slot.
void SiteSet::release(std::int32_t slot) noexcept {
  const Slot& own = slots_[at(slot)];
  if (own.radius > 0) {
    by_vertex_.erase(
        std::remove_if(by_vertex_.begin(), by_vertex_.end(), [&](const AtVertex& a) { return a.slot == slot; }),
        by_vertex_.end());
    for (std::size_t s = 0; s < slots_.size(); ++s) {
      if (slots_[s].owner != slot) continue;
      slots_[s] = Slot{};
      std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(s) * channels_, channels_, 0.0);
      numbers_.give_back(static_cast<std::uint32_t>(s));
      --hidden_;
    }
    return;
  }
  if (!own.site.is_vertex()) return;
  const AtVertex* there = find_vertex(own.site.vertex[0]);
  if (there && there->slot == slot) by_vertex_.erase(by_vertex_.begin() + (there - by_vertex_.data()));
}

std::int32_t SiteSet::free_slot() {
  const std::uint32_t slot = numbers_.take([&](std::uint32_t s) { return s < slots_.size() && slots_[s].used(); });
  if (slot == slots_.size()) {
    slots_.push_back(Slot{});
    values_.resize(slots_.size() * at(channels_), 0.0);
  }
  return static_cast<std::int32_t>(slot);
}

void SiteSet::set_value(std::int32_t slot, const double* values) noexcept {
  for (std::int32_t c = 0; c < channels_; ++c) values_[at(slot * channels_ + c)] = values ? values[c] : 0.0;
}

// Gives a site its vertices under the number `slot`. A disc also takes hidden sites.
void SiteSet::place(const surface::Core& core, const Arrival& arrival, std::int32_t slot, std::uint32_t limit) {
  Slot own;
  own.site = arrival.site;
  own.given_vertex = arrival.given_vertex;
  own.stiffness = arrival.stiffness;
  own.radius = arrival.radius;
  const double compliance = arrival.stiffness > 0 ? 1 / arrival.stiffness : 0.0;
  own.site.compliance = compliance;
  if (!(arrival.radius > 0)) {
    if (own.site.is_vertex()) claim_vertex(arrival, own.site.vertex[0], slot);
    slots_[at(slot)] = own;
    set_value(slot, arrival.values);
    return;
  }
  const Vector<mesh::DiscVertex> disc =
      mesh::geodesic_disc(core.mesh, core.topology(), arrival.site.vertex, arrival.site.weight,
                          arrival.radius / core.mesh.scale, *core.memory);
  Vector<std::int32_t> held(core.memory.get()), taken(core.memory.get());
  const bool whole = core.refinements > 0;  // bi-harmonic: values on the disc's boundary leave the slope free
  for (const mesh::DiscVertex& v : disc) {
    claim_vertex(arrival, v.vertex, slot);
    taken.push_back(v.vertex);
  }
  std::sort(taken.begin(), taken.end());
  const auto inside = [&](std::int32_t v) { return std::binary_search(taken.begin(), taken.end(), v); };
  for (const mesh::DiscVertex& v : disc) {
    if (whole || v.rim || surface::couples_outward(core, v.vertex, inside)) held.push_back(v.vertex);
  }
  if (held.empty() && !disc.empty()) held.push_back(disc[0].vertex);  // the disc is the whole component
  // The disc is smaller than the mesh spacing, so the site stays a point.
  if (disc.empty() && own.site.is_vertex()) claim_vertex(arrival, own.site.vertex[0], slot);
  if (held.size() > 1 && (held.size() - 1 > limit || count_ + hidden_ > limit - (held.size() - 1)))
    fail(HF_ERROR_TOO_LARGE, arrival.position,
         "site %u of the batch: its disc holds %zu vertices beside the %u there are; the site_limit is %u",
         arrival.position, held.size(), count_ + hidden_, limit);
  const double share = compliance * static_cast<double>(std::max<std::size_t>(1, held.size()));
  if (!held.empty()) own.site = Site::at_vertex(core.mesh, held[0], share);
  slots_[at(slot)] = own;
  set_value(slot, arrival.values);
  for (std::size_t i = 1; i < held.size(); ++i) {
    const std::int32_t member = free_slot();
    Slot& other = slots_[at(member)];
    other.site = Site::at_vertex(core.mesh, held[i], share);
    other.stiffness = arrival.stiffness;
    other.owner = slot;
    set_value(member, arrival.values);
    ++hidden_;
  }
}

void SiteSet::remove(std::uint32_t count, const std::uint32_t* sites) {
  check_site_count(count, count_);
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(i, sites[i]);
    const std::int32_t slot = static_cast<std::int32_t>(sites[i]);
    release(slot);
    slots_[sites[i]] = Slot{};
    set_value(slot, nullptr);
    numbers_.give_back(sites[i]);
    --count_;
  }
}

void SiteSet::move(const surface::Core& core, std::uint32_t count, const std::uint32_t* sites, const mesh::Places& to,
                   std::uint32_t limit) {
  check_site_count(count, count_);
  // All sites leave their places before any site arrives, so that sites may swap places.
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(i, sites[i]);
    for (std::uint32_t j = 0; j < i && count <= 64; ++j) {
      if (sites[j] == sites[i])
        fail(HF_ERROR_NOT_FOUND, i, "entry %u of the list: site %u is named twice", i, sites[i]);
    }
    release(static_cast<std::int32_t>(sites[i]));
    slots_[sites[i]].given_vertex = HF_NO_INDEX - 1;  // the site has left its place and not arrived
  }
  Vector<double> values(at(channels_), core.memory.get());
  const mesh::PlaceReader reader(core.mesh, to, *core.memory);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Slot slot = slots_[sites[i]];
    if (slot.given_vertex != HF_NO_INDEX - 1)
      fail(HF_ERROR_NOT_FOUND, i, "entry %u of the list: site %u is named twice", i, sites[i]);
    std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(sites[i]) * channels_, channels_, values.begin());
    const Site site = site_at(core.mesh, reader.read(i));
    place(core, {i, vertex_given(core.mesh, to, i, site), site, slot.radius, slot.stiffness, values.data()},
          static_cast<std::int32_t>(sites[i]), limit);
  }
}

namespace {

void check_value(double value, std::uint32_t position, std::int32_t channel) {
  if (!std::isfinite(value))
    fail(HF_ERROR_NON_FINITE, position, "entry %u of the list: value of channel %d is not a finite number", position,
         channel);
  if (std::fabs(value) > largest_value)
    fail(HF_ERROR_TOO_LARGE, position, "entry %u of the list: value of channel %d is %g; scale it below 1e200",
         position, channel, value);
}

}  // namespace

void SiteSet::take_core(const surface::Core& before, const surface::Core& core) {
  const mesh::Mesh &old = before.mesh, &mesh = core.mesh;
  const bool same = old.shares(mesh);
  const auto number = [&](std::int32_t v, std::size_t slot) {
    if (same) return v;
    const std::int32_t given = old.given_of_inner[at(v)];
    // a surface from before a patch has fewer vertices
    const std::int32_t now = at(given) < mesh.inner_of_given.size() ? mesh.inner_of_given[at(given)] : mesh::Mesh::none;
    const std::size_t site = slots_[slot].owner >= 0 ? at(slots_[slot].owner) : slot;
    if (now == mesh::Mesh::none)
      fail(HF_ERROR_CONFLICT, static_cast<std::uint32_t>(site),
           "site %zu lies at vertex %d, which has no triangle on that surface; move or remove the site first", site,
           given);
    return now;
  };
  for (std::size_t s = 0; s < slots_.size(); ++s) {
    Site& site = slots_[s].site;
    if (!slots_[s].used()) continue;
    for (std::int32_t& v : site.vertex)
      if (v >= 0) v = number(v, s);
    site.component = mesh.component[at(site.vertex[0])];
  }
  if (same) return;
  for (AtVertex& held : by_vertex_) held.vertex = number(held.vertex, at(held.slot));
  std::sort(by_vertex_.begin(), by_vertex_.end(),
            [](const AtVertex& a, const AtVertex& b) { return a.vertex < b.vertex; });
}

void SiteSet::set_values(std::uint32_t count, const std::uint32_t* sites, const double* values) {
  check_site_count(count, count_);
  bool discs = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(i, sites[i]);
    discs = discs || slots_[sites[i]].radius > 0;
    for (std::int32_t c = 0; c < channels_; ++c) {
      const double value = values[std::size_t{i} * at(channels_) + at(c)];
      check_value(value, i, c);
      values_[std::size_t{sites[i]} * at(channels_) + at(c)] = value;
    }
  }
  for (std::size_t s = 0; discs && s < slots_.size(); ++s) {
    if (slots_[s].owner >= 0)
      set_value(static_cast<std::int32_t>(s), values_.data() + at(slots_[s].owner) * at(channels_));
  }
}

void SiteSet::add(const surface::Core& core, const mesh::Places& places, const Holds& holds, std::uint32_t limit,
                  Vector<std::uint32_t>& out_sites) {
  if (places.count > limit || count_ + hidden_ > limit - places.count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u sites and %u more; the site_limit is %u", count_ + hidden_, places.count,
         limit);
  out_sites.reserve(places.count);
  const mesh::PlaceReader reader(core.mesh, places, *core.memory);
  for (std::uint32_t i = 0; i < places.count; ++i) {
    Arrival arrival;
    arrival.position = i;
    arrival.site = site_at(core.mesh, reader.read(i));
    arrival.given_vertex = vertex_given(core.mesh, places, i, arrival.site);
    arrival.stiffness = holds.stiffness ? holds.stiffness[i] : 0.0;
    if (!std::isfinite(arrival.stiffness))
      fail(HF_ERROR_NON_FINITE, i, "site %u of the batch: stiffness is not a finite number", i);
    if (arrival.stiffness < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "site %u of the batch: stiffness is %g; use 0 for a hard site or a number above 0", i, arrival.stiffness);
    if (arrival.stiffness > 0)
      arrival.stiffness = std::min(std::max(arrival.stiffness, least_stiffness), most_stiffness);
    arrival.radius = holds.radii ? holds.radii[i] : 0.0;
    if (!std::isfinite(arrival.radius))
      fail(HF_ERROR_NON_FINITE, i, "site %u of the batch: radius is not a finite number", i);
    if (arrival.radius > 0) mesh::require_triangles(core.mesh, "a disc", i);
    if (arrival.radius < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "site %u of the batch: radius is %g; use 0 for a point or a number above 0", i,
           arrival.radius);
    arrival.values = holds.values ? holds.values + std::size_t{i} * at(channels_) : nullptr;
    for (std::int32_t c = 0; arrival.values && c < channels_; ++c) check_value(arrival.values[c], i, c);
    const std::int32_t slot = free_slot();
    ++count_;
    place(core, arrival, slot, limit);
    out_sites.push_back(static_cast<std::uint32_t>(slot));
  }
  if (count_ + hidden_ > limit)  // a disc was counted before the places behind it
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "with the vertices of its discs the batch makes %u sites; the site_limit is %u", count_ + hidden_, limit);
}

SiteDifference::SiteDifference(const SiteSet& from, const SiteSet& to, Memory& memory) : SiteDifference(memory) {
  const Span<const SiteSet::Slot> before = from.slots(), after = to.slots();
  const std::size_t slots = std::max(before.size(), after.size());
  for (std::size_t s = 0; s < slots; ++s) {
    const bool was = s < before.size() && before[s].used(), is = s < after.size() && after[s].used();
    if (was && is && same_site(before[s].site, after[s].site)) continue;
    if (was) remove.push_back(static_cast<std::int32_t>(s));
    if (is) {
      add.push_back(static_cast<std::int32_t>(s));
      sites.push_back(after[s].site);
    }
  }
}

}  // namespace hf_inner::solve

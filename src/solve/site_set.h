// The sites of one solver as the caller sees them: numbers, places, values and stiffness.
//
// The set can be copied. An edit changes a copy, which replaces the original after the engine has accepted the change.
// Undo keeps old copies. SiteDifference computes the edit that leads from one set to another.
//
// A site of finite radius means that u = s on a geodesic disc. For a second-order operator only the boundary vertices
// of the disc are constrained, because the field inside is then constant. For a fourth-order operator all vertices of
// the disc are constrained. The first constrained vertex has the slot of the site. The others have hidden slots, which
// only the engine uses. No other site may use a vertex of the disc.
#pragma once
#include <cstdint>

#include "base/number_pool.h"
#include "mesh/place_reader.h"
#include "solve/site_solver.h"

namespace hf_inner::solve {

// Values of sites and targets may be at most this large. Larger values times weights of up to 1e12 could give fluxes
// that are not finite.
constexpr double largest_value = 1e200;

// Refuses a list that names more sites than there are, before it is read. Throws HF_ERROR_NOT_FOUND (index = there).
void check_site_count(std::uint32_t count, std::uint32_t there);

class SiteSet {
 public:
  SiteSet(Memory& memory, std::int32_t channels)
      : slots_(&memory), values_(&memory), by_vertex_(&memory), channels_(channels) {}
  SiteSet(const SiteSet& other, Memory& memory)
      : slots_(other.slots_, &memory),
        values_(other.values_, &memory),
        by_vertex_(other.by_vertex_, &memory),
        channels_(other.channels_),
        count_(other.count_),
        hidden_(other.hidden_) {}
  SiteSet(const SiteSet&) = delete;  // a copy must name its memory
  SiteSet(SiteSet&&) = default;
  SiteSet& operator=(SiteSet&&) = default;
  void swap(SiteSet& other) noexcept;

  struct Slot {
    Site site;  // component -1: not in use
    std::uint32_t given_vertex = HF_NO_INDEX;
    double stiffness = 0;
    double radius = 0;        // radius of its geodesic disc, in the unit of the mesh; 0: a point
    std::int32_t owner = -1;  // the slot of the disc that this one belongs to
    bool used() const noexcept { return site.component >= 0; }
    bool is_site() const noexcept { return used() && owner < 0; }  // not a hidden part of a disc
  };

  std::uint32_t count() const noexcept { return count_; }
  Span<const Slot> slots() const noexcept { return slots_; }
  const double* values() const noexcept { return values_.data(); }
  std::int32_t channels() const noexcept { return channels_; }

  // Throws HF_ERROR_NOT_FOUND (index = position) for a number without a site.
  void check_site(std::uint32_t position, std::uint32_t site) const;
  // Edits of the set. Each throws as the C function of the same name documents; the error index is the position in the
  // batch. After an exception *this may be half edited, so call these functions on a copy.
  void remove(std::uint32_t count, const std::uint32_t* sites);
  void move(const surface::Core& core, std::uint32_t count, const std::uint32_t* sites, const mesh::Places& to,
            std::uint32_t limit);
  void set_values(std::uint32_t count, const std::uint32_t* sites, const double* values);
  // The values of new sites, by place. Each array may be null.
  struct Holds {
    const double* values = nullptr;     // null: 0
    const double* stiffness = nullptr;  // null or 0: hard
    const double* radii = nullptr;      // geodesic, in the unit of the mesh; null or 0: points
  };
  // Gives the sites the vertices and components of another core of the same family (Geometry::is_kin). A site with a
  // radius keeps the vertices that it holds. Throws HF_ERROR_CONFLICT (index: the site) where a vertex went.
  void take_core(const surface::Core& before, const surface::Core& core);
  // Appends the numbers of the new sites.
  void add(const surface::Core& core, const mesh::Places& places, const Holds& holds, std::uint32_t limit,
           Vector<std::uint32_t>& out_sites);

 private:
  struct AtVertex {
    std::int32_t vertex, slot;
  };
  // A site that is about to be placed.
  struct Arrival {
    std::uint32_t position;  // position in the batch of the call
    std::uint32_t given_vertex;
    Site site;
    double radius, stiffness;
    const double* values;  // null: 0
  };
  const AtVertex* find_vertex(std::int32_t vertex) const noexcept;
  void claim_vertex(const Arrival& arrival, std::int32_t vertex, std::int32_t slot);
  void release(std::int32_t slot) noexcept;
  void place(const surface::Core& core, const Arrival& arrival, std::int32_t slot, std::uint32_t limit);
  std::int32_t free_slot();
  void set_value(std::int32_t slot, const double* values) noexcept;

  Vector<Slot> slots_;
  Vector<double> values_;       // by slot (number of a site) and channel
  Vector<AtVertex> by_vertex_;  // vertex sites, ascending
  std::int32_t channels_;
  std::uint32_t count_ = 0;   // sites that the caller has added
  std::uint32_t hidden_ = 0;  // hidden sites that make up discs
  NumberPool numbers_;
};

// The edit of the engine that leads from one set to another set.
struct SiteDifference {
  explicit SiteDifference(Memory& memory) : remove(&memory), add(&memory), sites(&memory) {}
  SiteDifference(const SiteSet& from, const SiteSet& to, Memory& memory);
  bool empty() const noexcept { return remove.empty() && add.empty(); }
  SiteEdit edit() const noexcept { return {remove, add, sites}; }
  Vector<std::int32_t> remove, add;
  Vector<Site> sites;
};

}  // namespace hf_inner::solve

#include "field/vector_sites.h"

#include <cmath>

#include "base/elementary.h"
#include "base/error.h"
#include "base/index.h"
#include "field/connection.h"
#include "field/vector_field.h"
#include "mesh/places.h"

namespace hf_inner::field {
namespace {

const solve::SiteSet::Slot& vector_site(const ScalarField& field, std::uint32_t position, std::uint32_t site) {
  field.sites().check_site(position, site);
  return field.sites().slots()[site];
}

// Returns the vertex of a site. For a point in a triangle it returns the corner of largest weight.
std::int32_t vertex_of(const solve::Site& site) noexcept {
  int best = 0;
  for (int k = 1; k < 3; ++k) best = site.vertex[k] >= 0 && site.weight[k] > site.weight[best] ? k : best;
  return site.vertex[best];
}

Vec3 value_of(const ScalarField& field, std::uint32_t site) noexcept {
  const double* v = field.sites().values() + std::size_t{3} * site;
  return {v[0], v[1], v[2]};
}

// Turns v about a unit axis by Rodrigues' formula. It is written by hand, since Vec3 is no type of Eigen's.
Vec3 turned(Vec3 v, Vec3 axis, double angle) noexcept {
  const double c = cosine(angle), s = sine(angle);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

}  // namespace

void require_vectors(const ScalarField& field) {
  mesh::require_triangles(field.core().mesh, "the normals of a vector field");
  if (field.sites().channels() != 3)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the solver has %d channels; vector fields need channel_count 3",
         field.sites().channels());
}

void move_vectors(ScalarField& field, std::uint32_t count, const std::uint32_t* sites, const std::uint32_t* vertices) {
  require_vectors(field);
  solve::check_site_count(count, field.sites().count());
  const surface::Core& core = field.core();
  const surface::Geometry& surface = core.geometry->unlinked();  // vectors are carried along triangles
  const mesh::Mesh& mesh = surface.mesh;
  Vector<double> values(field.core().memory.get());
  for (std::uint32_t i = 0; i < count; ++i) {
    const solve::SiteSet::Slot& slot = vector_site(field, i, sites[i]);
    std::int32_t here = vertex_of(slot.site);
    const std::int32_t to = mesh::usable_vertex(mesh, vertices[i], i);
    if (mesh.component[at(to)] != mesh.component[at(here)])
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "entry %u of the list: vertex %u lies in another component than site %u; remove it there and add it here", i,
           vertices[i], sites[i]);
    Vec3 vector = value_of(field, sites[i]), normal = vertex_normal(mesh, surface.topology(), here);
    for (const std::int32_t e : edge_path(mesh, surface.topology(), here, to, *field.core().memory)) {
      here = surface.topology().first(e) == here ? surface.topology().second(e) : surface.topology().first(e);
      const Vec3 next = vertex_normal(mesh, surface.topology(), here);
      if (norm(next) == 0) continue;  // no normal, because its triangles cancel out: keeps the last tangent plane
      if (norm(normal) > 0) vector = carry(vector, normal, next);
      normal = next;
    }
    for (const double x : {vector.x, vector.y, vector.z}) values.push_back(x);
  }
  FieldEdit edit;
  edit.move_count = count;
  edit.move_sites = sites;
  edit.move_to.count = count;
  edit.move_to.vertices = vertices;
  edit.set_count = count;
  edit.set_sites = sites;
  edit.set_values = values.data();
  field.edit(edit, nullptr);
}

void rotate_vectors(ScalarField& field, std::uint32_t count, const std::uint32_t* sites, const double* angles) {
  require_vectors(field);
  solve::check_site_count(count, field.sites().count());
  const surface::Core& core = field.core();
  Vector<double> values(field.core().memory.get());
  for (std::uint32_t i = 0; i < count; ++i) {
    const solve::SiteSet::Slot& slot = vector_site(field, i, sites[i]);
    check_angle(i, angles[i]);
    const Vec3 normal = vertex_normal(core.mesh, core.topology(), vertex_of(slot.site));
    const Vec3 vector = turned(value_of(field, sites[i]), normal, norm(normal) > 0 ? angles[i] : 0.0);
    for (const double x : {vector.x, vector.y, vector.z}) values.push_back(x);
  }
  FieldEdit edit;
  edit.set_count = count;
  edit.set_sites = sites;
  edit.set_values = values.data();
  field.edit(edit, nullptr);
}

}  // namespace hf_inner::field

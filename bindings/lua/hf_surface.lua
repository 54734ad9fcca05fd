-- Surface: a mesh, its Laplacian and its factor; picking; what is read from a field or from the shape alone.
local ffi = require('ffi')
local core = require('hf_core')
local C, check, fail, make, array, doubles = core.C, core.check, core.fail, core.make, core.array, core.doubles
local options_into, set, class, create, rows, query, scalars = core.options_into, core.set, core.class,
  core.create, core.rows, core.query, core.scalars

local Surface = class('Surface', function(raw) C.hf_surface_destroy(raw) end)
local create_options = set('weld weld_tolerance operator_kind field_kind ordering thread_count vertex_limit ' ..
  'triangle_limit memory_limit_mb position_stride triangle_stride')

local graph_options = set('allow_negative field_kind ordering thread_count vertex_limit edge_limit memory_limit_mb')

-- Sets the options of a desc and makes the surface.
local function finish(desc, options, allowed, make_surface)
  local plain = {}
  for key, value in pairs(options) do
    if key ~= 'saved_factor' and key ~= 'masses' and key ~= 'faces' and key ~= 'link_pieces' and
      key ~= 'tags' then plain[key] = value end
  end
  options_into(desc, plain, allowed)
  local factor
  if options.saved_factor then
    if type(options.saved_factor) ~= 'string' then fail('saved_factor must be a string of bytes') end
    factor = make('hf_factor_desc', { byte_count = #options.saved_factor })
    factor.bytes = ffi.cast('const char*', options.saved_factor)
    desc.saved_factor = factor
  end
  return create(Surface, 'hf_surface', { vertex_count = desc.vertex_count }, make_surface, desc)
end

-- Sets the faces of a desc: { starts =, sizes =, corners = }; starts without sizes are offsets, one more than faces.
local function faces_into(desc, faces)
  local starts, start_count = array(faces.starts, 'uint32_t', 'faces.starts')
  local sizes, size_count = array(faces.sizes, 'uint32_t', 'faces.sizes')
  local corners, corner_count = array(faces.corners, 'uint32_t', 'faces.corners')
  if starts and sizes and start_count ~= size_count then fail('faces.starts and faces.sizes must be of one length') end
  desc.face_count = sizes and size_count or math.max(0, start_count - 1)
  desc.corner_count, desc.face_starts, desc.face_sizes, desc.corners = corner_count, starts, sizes, corners
  return { starts, sizes, corners }
end

-- Sets the automatic links of a desc: options.link_pieces, and options.tags, a number for each vertex: pieces of
-- different tags stay apart.
local function links_into(desc, options)
  local on = options.link_pieces and options.link_pieces ~= 0
  if options.tags and not on then fail('tags need link_pieces') end
  if not on then return nil end
  local links = make('hf_links_desc', { mode = core.constants.HF_LINK_PIECES })
  local tags, count = array(options.tags, 'uint32_t', 'tags')
  if tags and count ~= desc.vertex_count then fail('tags must hold one number for each vertex') end
  links.tags, desc.links = tags, links
  return { links, tags }
end

-- triangles: a list, or cdata uint32_t[?] or uint16_t[?]; triangle_count: for cdata with a stride
local function new(positions, triangles, options)
  options = options or {}
  if positions == nil then fail('positions is nil', 'HF_ERROR_NULL_POINTER') end
  local single = type(positions) == 'cdata' and ffi.istype('float[?]', positions)
  local xyz, count = array(positions, single and 'float' or 'double', 'positions')
  local half = type(triangles) == 'cdata' and ffi.istype('uint16_t[?]', triangles)
  local corners, corner_count = array(triangles, half and 'uint16_t' or 'uint32_t', 'triangles')
  local row = (options.triangle_stride or 0) > 0 and options.triangle_stride / (half and 2 or 4) or 3
  if count % 3 ~= 0 then fail('positions must hold three numbers a vertex') end
  if corners and corner_count % row ~= 0 then fail('triangles must hold three numbers each, or whole strides') end
  local desc = make('hf_surface_desc', { vertex_count = count / 3,
    triangle_count = corners and corner_count / row or 0 })
  desc[single and 'positions' or 'positions_f64'] = xyz
  if corner_count > 0 then desc[half and 'triangles_u16' or 'triangles'] = corners end
  local held = { options.faces and faces_into(desc, options.faces), links_into(desc, options) }
  local surface = finish(desc, options, create_options, C.hf_surface_create)
  held = nil -- the library has copied the faces and tags
  return surface
end

-- A surface of a graph: two vertices for each edge, and its weight. options.masses: a list, for bi-harmonic fields.
local function from_graph(vertex_count, edges, weights, options)
  options = options or {}
  local ends, end_count = array(edges, 'uint32_t', 'edges')
  local sizes, edge_count = doubles(weights, 'weights')
  if ends and sizes and end_count ~= 2 * edge_count then fail('edges must hold two vertices for each of the weights') end
  local masses = doubles(options.masses, 'masses', vertex_count)
  local desc = make('hf_graph_desc', { vertex_count = core.whole(vertex_count, 'vertex_count'),
    edge_count = edge_count })
  desc.edges, desc.weights, desc.masses = ends, sizes, masses
  return finish(desc, options, graph_options, C.hf_surface_create_graph)
end
function Surface:info() return query('hf_surface_info', C.hf_surface_get_info, self.raw) end
function Surface:report() return query('hf_surface_report', C.hf_surface_get_report, self.raw) end
function Surface:statistics() return query('hf_surface_statistics', C.hf_surface_get_statistics, self.raw) end
function Surface:components()
  local out = ffi.new('uint32_t[?]', self.vertex_count)
  check(C.hf_surface_get_components(self.raw, self.vertex_count, out, nil))
  return out
end
-- The factor of a kind of field (nil: harmonic) as a string of bytes, for the option saved_factor.
function Surface:save(field_kind)
  field_kind = core.whole(field_kind or 0, 'field_kind')
  local size = ffi.new('size_t[1]')
  check(C.hf_surface_save(self.raw, field_kind, nil, 0, nil, size))
  local bytes = ffi.new('char[?]', size[0])
  check(C.hf_surface_save(self.raw, field_kind, nil, size[0], bytes, size))
  return ffi.string(bytes, size[0])
end

-- ---- picking; options: positions (posed; nil: at rest), front_only (1: pass triangles seen from behind)
local function pick(self, options)
  options = options or {}
  local xyz = doubles(options.positions, 'positions', 3 * self.vertex_count)
  return make('hf_pick_desc', { positions_f64 = xyz, front_only = options.front_only or 0 }), xyz
end
-- The first triangle on a ray, hf_hit, or nil.
function Surface:cast_ray(origin, direction, options)
  local desc, held = pick(self, options)
  local hit = make('hf_hit')
  local start, along = doubles(origin, 'origin', 3), doubles(direction, 'direction', 3)
  check(C.hf_surface_cast_ray(self.raw, start, along, desc, hit))
  return hit.found == 1 and hit or nil, held
end
-- The vertex nearest to a point, and its distance.
function Surface:find_vertex(point, options)
  local desc, held = pick(self, options)
  local vertex, distance = ffi.new('uint32_t[1]'), ffi.new('double[1]')
  check(C.hf_surface_find_vertex(self.raw, (doubles(point, 'point', 3)), desc, vertex, distance))
  return tonumber(vertex[0]), distance[0], held
end

-- ---- fields over the surface
function Surface:space_levels(field, count, spacing)
  local desc, held = scalars(field, self.vertex_count)
  count, spacing = core.whole(count, 'count'), core.whole(spacing or 0, 'spacing')
  local out = ffi.new('double[?]', math.min(math.max(1, count), 1000000))
  check(C.hf_surface_space_levels(self.raw, desc, spacing, count, out))
  held = nil
  return out
end
function Surface:trace_isolines(field, levels)
  local desc, held = scalars(field, self.vertex_count)
  local wanted, count = doubles(levels, 'levels')
  local lines = make('hf_isolines')
  check(C.hf_surface_trace_isolines(self.raw, desc, count, wanted, lines))
  local p, k = lines.point_count, lines.line_count
  local out = { point_count = p, line_count = k, positions = ffi.new('double[?]', 3 * p + 1),
    line_starts = ffi.new('uint32_t[?]', k + 1),
    line_levels = ffi.new('uint32_t[?]', k + 1), line_closed = ffi.new('int32_t[?]', k + 1) }
  lines.point_capacity, lines.line_capacity = p, k
  lines.positions, lines.line_starts, lines.line_levels, lines.line_closed = out.positions, out.line_starts,
    out.line_levels, out.line_closed
  if k > 0 then check(C.hf_surface_trace_isolines(self.raw, desc, count, wanted, lines)) end
  return out
end
function Surface:find_critical_points(field)
  local desc, held = scalars(field, self.vertex_count)
  local info = make('hf_critical_info')
  check(C.hf_surface_find_critical_points(self.raw, desc, 0, nil, info))
  local out = ffi.new('hf_critical_point[?]', info.point_count + 1)
  if info.point_count > 0 then check(C.hf_surface_find_critical_points(self.raw, desc, info.point_count, out, info)) end
  return out, info.point_count
end
function Surface:find_extremities()
  return rows('hf_extremity', function(capacity, out, count) return C.hf_surface_find_extremities(self.raw, nil, capacity, out,
    count) end)
end
-- Places for handles, pinned ones first: rows of hf_handle_proposal and their count.
function Surface:propose_handles()
  return rows('hf_handle_proposal', function(capacity, out, count) return C.hf_propose_handles(self.raw, nil, capacity, out,
    count) end)
end

return { Surface = new, graph_surface = from_graph }

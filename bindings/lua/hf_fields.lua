-- Made on a surface: geodesic distances, direction fields, quad meshes, flow lines.
local ffi = require('ffi')
local core = require('hf_core')
local C, check, fail, make, array, integers, doubles, list, options_into = core.C, core.check, core.fail, core.make,
  core.array, core.integers, core.doubles, core.list, core.options_into
local set, class, raw_of, create, on_numbers, rows, query, scalars = core.set, core.class, core.raw_of, core.create,
  core.on_numbers, core.rows, core.query, core.scalars
local create_on = core.create_on

local hf = {}
-- Numbers of sites and as many vertices.
local function paired(sites, vertices)
  local numbers, count = integers(sites, 'sites')
  local at, places = integers(vertices, 'vertices')
  if count ~= places then fail('sites and vertices must be of one length') end
  return count, numbers, at
end

local Geodesics = class('Geodesics', function(raw) C.hf_geodesics_destroy(raw) end)
function hf.Geodesics(surface, options)
  return create_on(Geodesics, 'hf_geodesics', surface, options, 'smoothing method', C.hf_geodesics_create)
end
function Geodesics:distance(sources)
  local out = ffi.new('double[?]', self.vertex_count)
  on_numbers(C.hf_geodesics_solve_f64, self.raw, sources, 'sources', out, 0)
  return out
end
-- A place is a vertex, or corners and barycentrics: lists of three, or what cast_ray gives.
local function point_of(place, name)
  local point = ffi.new('hf_surface_point')
  if type(place) == 'number' then
    place = { corners = { place, place, place }, barycentrics = { 1, 0, 0 } }
  elseif type(place) ~= 'table' and type(place) ~= 'cdata' then
    fail(name .. ' must be a vertex, or corners and barycentrics')
  end
  local first = type(place) == 'cdata' and 0 or 1
  if first == 1 and (#(place.corners or {}) ~= 3 or #(place.barycentrics or {}) ~= 3) then
    fail(name .. ' must have three corners and three barycentrics')
  end
  for k = 0, 2 do
    point.corners[k] = core.whole(tonumber(place.corners[first + k]), name .. '.corners')
    point.barycentrics[k] = place.barycentrics[first + k]
  end
  return point
end
-- The shortest path between two places: xyz of its corners (cdata from 0), and how many numbers they are.
function Geodesics:path(from, to)
  local start, finish, path = point_of(from, 'from'), point_of(to, 'to'), make('hf_path')
  check(C.hf_geodesics_find_path(self.raw, start, finish, path))
  local count = 3 * path.point_count
  local positions = ffi.new('double[?]', math.max(1, count))
  path.point_capacity, path.positions = path.point_count, positions
  check(C.hf_geodesics_find_path(self.raw, start, finish, path))
  return positions, count
end
-- The surface around a place laid out in a plane: two coordinates per vertex; NaN beyond the radius (0: no bound).
function Geodesics:map(centre, radius)
  local out = ffi.new('double[?]', 2 * self.vertex_count)
  check(C.hf_geodesics_get_map(self.raw, point_of(centre, 'centre'), radius or 0, out, nil))
  return out
end

local Direction = class('Direction', function(raw) C.hf_direction_destroy(raw) end)
function hf.Direction(surface, options)
  return create_on(Direction, 'hf_direction', surface, options, 'degree site_limit', C.hf_direction_create)
end
function Direction:clone()
  return create(Direction, 'hf_direction', { vertex_count = self.vertex_count }, C.hf_direction_clone, self.raw)
end
function Direction:add_sites(vertices, vectors)
  local at, count = integers(vertices, 'vertices')
  local out = ffi.new('uint32_t[?]', math.max(1, count))
  check(C.hf_direction_add_sites(self.raw, count, at, (doubles(vectors, 'vectors', 3 * count)), out))
  return list(out, count)
end
function Direction:remove_sites(sites) on_numbers(C.hf_direction_remove_sites, self.raw, sites, 'sites') end
function Direction:move_sites(sites, vertices) check(C.hf_direction_move_sites(self.raw, paired(sites, vertices))) end
function Direction:set_vectors(sites, vectors)
  local numbers, count = integers(sites, 'sites')
  check(C.hf_direction_set_vectors(self.raw, count, numbers, (doubles(vectors, 'vectors', 3 * count))))
end
function Direction:rotate_sites(sites, angles)
  local numbers, count = integers(sites, 'sites')
  check(C.hf_direction_rotate_sites(self.raw, count, numbers, (doubles(angles, 'angles', count))))
end
function Direction:record() check(C.hf_direction_record(self.raw)) end
function Direction:undo() check(C.hf_direction_undo(self.raw)) end
function Direction:redo() check(C.hf_direction_redo(self.raw)) end
function Direction:site_count() return tonumber(C.hf_direction_get_site_count(self.raw)) end
-- { count, sites, vertices, vectors }: cdata from 0
function Direction:sites()
  local n = self:site_count()
  local found = { count = n, sites = ffi.new('uint32_t[?]', n + 1), vertices = ffi.new('uint32_t[?]', n + 1),
    vectors = ffi.new('double[?]', 3 * n + 1) }
  check(C.hf_direction_get_sites(self.raw, n, found.sites, found.vertices, found.vectors, nil))
  return found
end
function Direction:statistics() return query('hf_direction_statistics', C.hf_direction_get_statistics, self.raw) end
function Direction:solve()
  local out = ffi.new('double[?]', 3 * self.vertex_count)
  check(C.hf_direction_solve_f64(self.raw, out, 0, nil))
  return out
end
function Direction:singularities()
  return rows('hf_singularity', function(capacity, out, count)
    return C.hf_direction_get_singularities(self.raw, capacity, out, count)
  end)
end

local Quads = class('Quads', function(raw) C.hf_quads_destroy(raw) end)
-- The lists among the options of quads: element type, and numbers for each edge, guide or pole.
local quad_lists = { crease_edges = { 'uint32_t', 2 }, guide_vertices = { 'uint32_t', 1 },
  guide_vectors = { 'double', 3 }, guide_weights = { 'float', 1 }, pole_points = { 'double', 3 },
  pole_quads = { 'uint32_t', 1 }, pole_directions = { 'double', 3 }, symmetry_plane = { 'double', 4 } }
-- options: face_count, edge_length, crease_angle, relax_count; lists: crease_edges, guide_vertices, guide_vectors,
-- guide_weights, pole_points, pole_quads of 3 or 5, pole_directions; symmetry_plane: { a, b, c, d } of a x + b y + c z = d
-- Returns a desc, and the arrays it points into: they must live until the call is over.
local function quad_desc(options)
  local plain, held, counts = {}, {}, {}
  for key, value in pairs(options or {}) do
    if not quad_lists[key] then plain[key] = value end
  end
  local desc = options_into(make('hf_quads_desc'), plain, set('face_count edge_length crease_angle relax_count'))
  local function take(name, count)
    local kind, width = quad_lists[name][1], quad_lists[name][2]
    if not options or options[name] == nil then return end
    local values, length = array(options[name], kind, name, count and width * count)
    if length % width ~= 0 then
      fail(string.format('%s must hold %d numbers each; %d is no multiple of %d', name, width, length, width)) end
    if length > 0 then held[name] = values end
    counts[name] = length / width
  end
  take('crease_edges')
  take('guide_vertices')
  take('guide_vectors', counts.guide_vertices or 0)
  take('guide_weights', counts.guide_vertices or 0)
  take('pole_quads')
  take('pole_points', counts.pole_quads or 0)
  take('pole_directions', counts.pole_quads or 0)
  take('symmetry_plane', 1)
  desc.crease_count, desc.guide_count = counts.crease_edges or 0, counts.guide_vertices or 0
  desc.pole_count = counts.pole_quads or 0
  for name, values in pairs(held) do
    if name == 'symmetry_plane' then ffi.copy(desc.symmetry_plane, values, 32) else desc[name] = values end
  end
  return desc, held
end
function hf.Quads(surface, options)
  local desc, held = quad_desc(options)
  local made = create(Quads, 'hf_quads', {}, C.hf_quads_create, raw_of(surface, 'Surface', 'surface'), desc)
  held = nil -- the library has copied the lists
  return made
end
-- Makes the mesh again, with the options of hf.Quads: for strokes, creases and poles that the user drags. After an
-- error the mesh is what it was.
function Quads:update(options)
  local desc, held = quad_desc(options)
  check(C.hf_quads_update(self.raw, desc))
  held = nil -- the library has copied the lists
end
function Quads:info() return query('hf_quads_info', C.hf_quads_get_info, self.raw) end
-- Face i has the corners faces[4 * i] to faces[4 * i + 3]; cdata from 0.
function Quads:mesh()
  local info = self:info()
  local v, f = info.vertex_count, info.face_count
  local mesh = { vertex_count = v, face_count = f, positions = ffi.new('double[?]', 3 * v),
    faces = ffi.new('uint32_t[?]', 4 * f), triangles = ffi.new('uint32_t[?]', v),
    barycentrics = ffi.new('double[?]', 3 * v), corners = ffi.new('uint32_t[?]', 3 * v) }
  local out = make('hf_quads_mesh', { vertex_capacity = v, face_capacity = f })
  for _, name in ipairs({ 'positions', 'faces', 'triangles', 'barycentrics', 'corners' }) do out[name] = mesh[name] end
  check(C.hf_quads_get_mesh(self.raw, out))
  return mesh
end

local Flow = class('Flow', function(raw) C.hf_flow_destroy(raw) end)
function hf.Flow(surface)
  return create(Flow, 'hf_flow', { vertex_count = raw_of(surface, 'Surface', 'surface') and surface.vertex_count,
    room = { 4096, 64 } },
    C.hf_flow_create, surface.raw)
end
-- options: wanted_count lines of equal flux from the minima, or one through each of seeds. Line i holds the points
-- line_starts[i] to line_starts[i + 1] - 1; values rise along it; cdata from 0.
function Flow:trace(field, options)
  options = options or {}
  local desc, held = scalars(field, self.vertex_count)
  local seeds, seed_count = nil, 0
  if options.seeds then seeds, seed_count = integers(options.seeds, 'seeds') end
  local wanted = options.wanted_count or 0
  if type(wanted) ~= 'number' or not (wanted >= 0 and wanted <= 1000000) then
    fail('wanted_count must be at most 1,000,000') end
  while true do
    local p, k = self.room[1], self.room[2]
    local found = { positions = ffi.new('double[?]', 3 * p), values = ffi.new('double[?]', p),
      line_starts = ffi.new('uint32_t[?]', k + 1),
      line_ends = ffi.new('uint32_t[?]', 2 * k + 1) }
    local out = make('hf_flow_lines', { wanted_count = wanted, seed_count = seed_count, seeds = seeds,
      point_capacity = p, line_capacity = k,
      positions = found.positions, values = found.values, line_starts = found.line_starts,
        line_ends = found.line_ends })
    local result = C.hf_flow_trace(self.raw, desc, out)
    if result ~= core.constants.HF_ERROR_TOO_SMALL then
      check(result)
      found.point_count, found.line_count = out.point_count, out.line_count
      return found, held
    end
    self.room = { out.point_count + math.floor(out.point_count / 4), out.line_count }
  end
end

return hf

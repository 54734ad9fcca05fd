-- Solver: a surface, its factor and a set of sites.
local ffi = require('ffi')
local core = require('hf_core')
local C, check, fail, make, array, integers, doubles, list = core.C, core.check, core.fail, core.make, core.array,
  core.integers, core.doubles, core.list
local options_into, set, class, create, on_numbers, rows, query, scalars = core.options_into, core.set, core.class,
  core.create, core.on_numbers, core.rows, core.query, core.scalars

local Solver = class('Solver', function(raw) C.hf_destroy(raw) end)
local create_options = set('weld weld_tolerance operator_kind engine ordering channel_count thread_count site_limit ' ..
  'vertex_limit triangle_limit memory_limit_mb penalty field_kind position_stride')

local function new(positions, triangles, options)
  options = options or {}
  if positions == nil then fail('positions is nil', 'HF_ERROR_NULL_POINTER') end
  local single = type(positions) == 'cdata' and ffi.istype('float[?]', positions)
  local xyz, count = array(positions, single and 'float' or 'double', 'positions')
  local corners, corner_count = integers(triangles, 'triangles')
  if count % 3 ~= 0 then fail('positions must hold three numbers a vertex') end
  if corners and corner_count % 3 ~= 0 then fail('triangles must hold three numbers each') end
  local desc = make('hf_create_desc', { vertex_count = count / 3, triangle_count = corners and corner_count / 3 or 0 })
  desc[single and 'positions' or 'positions_f64'] = xyz
  if corner_count > 0 then desc.triangles = corners end
  local plain = {}
  for key, value in pairs(options) do if key ~= 'saved_factor' then plain[key] = value end end
  options_into(desc, plain, create_options)
  local factor
  if options.saved_factor then
    if type(options.saved_factor) ~= 'string' then fail('saved_factor must be a string of bytes') end
    factor = make('hf_factor_desc', { byte_count = #options.saved_factor })
    factor.bytes = ffi.cast('const char*', options.saved_factor)
    desc.saved_factor = factor
  end
  return create(Solver, 'hf_solver',
    { vertex_count = count / 3, channel_count = math.max(1, options.channel_count or 1) },
    C.hf_create, desc)
end
function Solver:clone()
  return create(Solver, 'hf_solver', { vertex_count = self.vertex_count, channel_count = self.channel_count },
    C.hf_clone, self.raw)
end
function Solver:report() return query('hf_mesh_report', C.hf_get_mesh_report, self.raw) end
function Solver:statistics() return query('hf_statistics', C.hf_get_statistics, self.raw) end
local function places(self, vertices, values, more)
  more = more or {}
  local at, count = integers(vertices, 'vertices')
  local inside
  if vertices == nil and more.triangles then inside, count = integers(more.triangles, 'triangles') end
  local held = { at, inside, doubles(more.barycentrics, 'barycentrics', 3 * count),
    doubles(values, 'values', count * self.channel_count),
    doubles(more.stiffness, 'stiffness', count), doubles(more.radii, 'radii', count) }
  local desc = make('hf_sites_desc', { site_count = count, vertices = held[1], triangles = held[2],
    barycentrics = held[3], values = held[4], stiffness = held[5], radii = held[6] })
  return desc, count, held
end
function Solver:add_sites(vertices, values, more)
  local desc, count, held = places(self, vertices, values, more)
  local out = ffi.new('uint32_t[?]', math.max(1, count))
  check(C.hf_add_sites(self.raw, desc, out))
  return list(out, held and count)
end
function Solver:remove_sites(sites)
  on_numbers(C.hf_remove_sites, self.raw, sites, 'sites')
end
function Solver:move_sites(sites, vertices)
  local desc, _, held = places(self, vertices)
  on_numbers(C.hf_move_sites, self.raw, sites, 'sites', desc)
  return held and nil
end
function Solver:set_site_values(sites, values)
  local numbers, count = integers(sites, 'sites')
  check(C.hf_set_site_values(self.raw, count, numbers, (doubles(values, 'values', count * self.channel_count))))
end
function Solver:edit_sites(edit)
  local remove, move, change = edit.remove or {}, edit.move or {}, edit.set or {}
  local r, m, s = integers(remove, 'remove'), integers(move, 'move'), integers(change, 'set')
  local v = doubles(edit.set_values, 'set_values', #change * self.channel_count)
  local desc = make('hf_edit_desc', { remove_count = #remove, remove_sites = r, move_count = #move, move_sites = m,
    set_count = #change, set_sites = s, set_values = v })
  local to, added, count, held1, held2 = nil, nil, 0, nil, nil
  if edit.move_to then to, _, held1 = places(self, edit.move_to); desc.move_to = to end
  if edit.add then added, count, held2 = places(self, edit.add, edit.add_values); desc.add = added end
  local out = ffi.new('uint32_t[?]', math.max(1, count))
  check(C.hf_edit_sites(self.raw, desc, out))
  return list(out, (held1 or held2 or true) and count)
end
function Solver:record() check(C.hf_record(self.raw)) end
function Solver:undo() check(C.hf_undo(self.raw)) end
function Solver:redo() check(C.hf_redo(self.raw)) end
function Solver:site_count() return tonumber(C.hf_get_site_count(self.raw)) end
function Solver:solve(out)
  out = out or ffi.new('double[?]', self.vertex_count * self.channel_count)
  local single = ffi.istype('float[?]', out)
  if not single and not ffi.istype('double[?]', out) then fail('out must be float[?] or double[?]') end
  if ffi.sizeof(out) ~= self.vertex_count * self.channel_count * (single and 4 or 8) then
    fail('out has the wrong length', 'HF_ERROR_TOO_SMALL') end
  check((single and C.hf_solve or C.hf_solve_f64)(self.raw, out, 0, nil))
  return out
end
function Solver:solve_preview(correction_count)
  local out = ffi.new('double[?]', self.vertex_count * self.channel_count)
  check(C.hf_solve_preview_f64(self.raw, out, 0, correction_count or 0, nil))
  return out
end
function Solver:solve_at(vertices)
  local at, count = integers(vertices, 'vertices')
  local out = ffi.new('double[?]', math.max(1, count * self.channel_count))
  check(C.hf_solve_at(self.raw, count, at, out))
  return out, count * self.channel_count
end
function Solver:save_factor()
  local size = ffi.new('size_t[1]')
  check(C.hf_get_factor_size(self.raw, size))
  local bytes = ffi.new('char[?]', size[0])
  check(C.hf_save_factor(self.raw, bytes, size[0]))
  return ffi.string(bytes, size[0])
end
function Solver:space_levels(field, count, spacing)
  local desc, held = scalars(field, self.vertex_count)
  local out = ffi.new('double[?]', math.max(1, count))
  check(C.hf_space_levels(self.raw, desc, spacing or 0, count, out))
  held = nil
  return out
end
function Solver:trace_isolines(field, levels)
  local desc, held = scalars(field, self.vertex_count)
  local wanted, count = doubles(levels, 'levels')
  local lines = make('hf_isolines')
  check(C.hf_trace_isolines(self.raw, desc, count, wanted, lines))
  local p, k = lines.point_count, lines.line_count
  local out = { point_count = p, line_count = k, positions = ffi.new('double[?]', 3 * p + 1),
    line_starts = ffi.new('uint32_t[?]', k + 1),
    line_levels = ffi.new('uint32_t[?]', k + 1), line_closed = ffi.new('int32_t[?]', k + 1) }
  lines.point_capacity, lines.line_capacity = p, k
  lines.positions, lines.line_starts, lines.line_levels, lines.line_closed = out.positions, out.line_starts,
    out.line_levels, out.line_closed
  if k > 0 then check(C.hf_trace_isolines(self.raw, desc, count, wanted, lines)) end
  return out
end
function Solver:find_critical_points(field)
  local desc, held = scalars(field, self.vertex_count)
  local info = make('hf_critical_info')
  check(C.hf_find_critical_points(self.raw, desc, 0, nil, info))
  local out = ffi.new('hf_critical_point[?]', info.point_count + 1)
  if info.point_count > 0 then check(C.hf_find_critical_points(self.raw, desc, info.point_count, out, info)) end
  return out, info.point_count
end
function Solver:find_extremities()
  return rows('hf_extremity', function(capacity, out, count) return C.hf_find_extremities(self.raw, nil, capacity, out,
    count) end)
end
-- Measures the field on its own equations; fails when an error exceeds the tolerance (nil: the default).
function Solver:certify(tolerance)
  local certificate = make('hf_certificate', { tolerance = tolerance or 0 })
  check(C.hf_certify(self.raw, certificate))
  return certificate
end
function Solver:prepare_rebase() check(C.hf_prepare_rebase(self.raw)) end
function Solver:release_preview() check(C.hf_release_preview(self.raw)) end
function Solver:components()
  local out = ffi.new('uint32_t[?]', self.vertex_count)
  check(C.hf_get_components(self.raw, self.vertex_count, out))
  return out
end

return new

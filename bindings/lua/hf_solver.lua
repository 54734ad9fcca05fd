-- Solver: sites that come and go on a surface, and the field through them.
local ffi = require('ffi')
local core = require('hf_core')
local C, check, fail, make, integers, doubles, list = core.C, core.check, core.fail, core.make, core.integers,
  core.doubles, core.list
local options_into, set, class, raw_of, create, on_numbers, query = core.options_into, core.set, core.class,
  core.raw_of, core.create, core.on_numbers, core.query

local Solver = class('Solver', function(raw) C.hf_solver_destroy(raw) end)

local function new(surface, options)
  local desc = options_into(make('hf_solver_desc'), options,
    set('field_kind engine channel_count site_limit penalty'))
  local parent = raw_of(surface, 'Surface', 'surface')
  return create(Solver, 'hf_solver',
    { vertex_count = surface.vertex_count, channel_count = math.max(1, desc.channel_count) },
    C.hf_create, parent, desc)
end
function Solver:clone()
  return create(Solver, 'hf_solver', { vertex_count = self.vertex_count, channel_count = self.channel_count },
    C.hf_solver_clone, self.raw)
end
function Solver:info() return query('hf_solver_info', C.hf_solver_get_info, self.raw) end
function Solver:statistics() return query('hf_solver_statistics', C.hf_solver_get_statistics, self.raw) end
local function places(self, vertices, values, more)
  more = more or {}
  local at, count = integers(vertices, 'vertices')
  local inside
  if vertices == nil and more.triangles then inside, count = integers(more.triangles, 'triangles') end
  local between, corner_count
  if more.corners then
    between, corner_count = integers(more.corners, 'corners')
    if vertices == nil and not inside then count = corner_count / 3 end
    if corner_count ~= 3 * count then fail('corners must hold three vertices for each site') end
  end
  local held = { at, inside, doubles(more.barycentrics, 'barycentrics', 3 * count),
    doubles(values, 'values', count * self.channel_count),
    doubles(more.stiffness, 'stiffness', count), doubles(more.radii, 'radii', count), between }
  local desc = make('hf_sites_desc', { site_count = count, vertices = held[1], triangles = held[2],
    barycentrics = held[3], values = held[4], stiffness = held[5], radii = held[6], corners = held[7] })
  return desc, count, held
end
function Solver:add_sites(vertices, values, more)
  local desc, count, held = places(self, vertices, values, more)
  local out = ffi.new('uint32_t[?]', math.max(1, count))
  check(C.hf_add_sites(self.raw, desc, out))
  return list(out, held and count)
end
-- One hard site at a vertex; value: a number (nil: 0), or a list of one per channel. Returns its number.
function Solver:add_site(vertex, value)
  local at = integers({ vertex }, 'vertex')
  local given = value ~= nil and doubles(type(value) == 'table' and value or { value }, 'value', self.channel_count)
  local out = ffi.new('uint32_t[1]')
  check(C.hf_solver_add_site(self.raw, at[0], given or nil, out))
  return tonumber(out[0])
end
function Solver:remove_sites(sites)
  on_numbers(C.hf_remove_sites, self.raw, sites, 'sites')
end
function Solver:move_sites(sites, vertices)
  local desc, _, held = places(self, vertices)
  on_numbers(C.hf_solver_move_sites, self.raw, sites, 'sites', desc)
  return held and nil
end
function Solver:set_values(sites, values)
  local numbers, count = integers(sites, 'sites')
  check(C.hf_solver_set_values(self.raw, count, numbers, (doubles(values, 'values', count * self.channel_count))))
end
-- (K + A H) u = A H p + W lambda: screening is H by vertex, targets is p, 0 if nil. nil removes the screening.
function Solver:set_screening(screening, targets)
  local strength = screening and doubles(screening, 'screening', self.vertex_count) or nil
  local wish = targets and doubles(targets, 'targets', self.vertex_count * self.channel_count) or nil
  check(C.hf_solver_set_screening(self.raw, strength, wish))
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
  check(C.hf_solver_edit_sites(self.raw, desc, out))
  return list(out, (held1 or held2 or true) and count)
end
function Solver:record() check(C.hf_solver_record(self.raw)) end
function Solver:undo() check(C.hf_solver_undo(self.raw)) end
function Solver:redo() check(C.hf_solver_redo(self.raw)) end
function Solver:site_count() return tonumber(C.hf_solver_get_site_count(self.raw)) end
function Solver:solve(out)
  out = out or ffi.new('double[?]', self.vertex_count * self.channel_count)
  local single = ffi.istype('float[?]', out)
  if not single and not ffi.istype('double[?]', out) then fail('out must be float[?] or double[?]') end
  if ffi.sizeof(out) ~= self.vertex_count * self.channel_count * (single and 4 or 8) then
    fail('out has the wrong length', 'HF_ERROR_TOO_SMALL') end
  check((single and C.hf_solve or C.hf_solver_solve_f64)(self.raw, out, 0, nil))
  return out
end
function Solver:solve_preview(correction_count)
  local out = ffi.new('double[?]', self.vertex_count * self.channel_count)
  check(C.hf_solver_solve_preview_f64(self.raw, out, 0, core.whole(correction_count or 0, 'correction_count'), nil))
  return out
end
function Solver:solve_at(vertices)
  local at, count = integers(vertices, 'vertices')
  local out = ffi.new('double[?]', math.max(1, count * self.channel_count))
  check(C.hf_solver_solve_at(self.raw, count, at, out))
  return out, count * self.channel_count
end
-- Measures the field on its own equations; fails when an error exceeds the tolerance (nil: the default).
function Solver:certify(tolerance)
  local certificate = make('hf_certificate', { tolerance = tolerance or 0 })
  check(C.hf_solver_certify(self.raw, certificate))
  return certificate
end
function Solver:prepare_rebase() check(C.hf_solver_prepare_rebase(self.raw)) end
function Solver:release_preview() check(C.hf_solver_release_preview(self.raw)) end

return new

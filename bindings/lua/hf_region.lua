-- Regions of a surface, their smooth base, the detail on it, and detail carried to another region.
local ffi = require('ffi')
local core = require('hf_core')
local C, check, fail, make, integers, doubles = core.C, core.check, core.fail, core.make, core.integers, core.doubles
local class, raw_of, create, query = core.class, core.raw_of, core.create, core.query

local hf = {}

local function morph(call, thing, weight)
  if type(weight) ~= 'number' then fail('weight must be a number') end
  local out = ffi.new('double[?]', 3 * thing.vertex_count)
  check(call(thing.raw, make('hf_morph_desc', { weight = weight, positions_f64 = out })))
  return out
end

local Region = class('Region', function(raw) C.hf_region_destroy(raw) end)
-- positions: a pose of the surface to work on; nil: at rest. options: base (HF_BASE_*)
function hf.Region(surface, positions, options)
  local parent = raw_of(surface, 'Surface', 'surface')
  local xyz = doubles(positions, 'positions', 3 * surface.vertex_count)
  local desc = core.options_into(make('hf_region_desc', { positions_f64 = xyz }), options, core.set('base'))
  return create(Region, 'hf_region', { vertex_count = surface.vertex_count }, C.hf_region_create, parent, desc)
end
function Region:clone()
  return create(Region, 'hf_region', { vertex_count = self.vertex_count }, C.hf_region_clone, self.raw)
end
-- One edit: curve (what these vertices enclose; side, seed_vertex, curve_kind), rings more or less, add and remove (lists).
function Region:edit(edit)
  local desc = make('hf_region_edit_desc', { ring_count = edit.rings or 0 })
  local along, points = nil, 0
  if edit.curve then
    along, points = integers(edit.curve, 'curve')
    local line = make('hf_curve_desc', { point_count = points, vertices = along, side = edit.side or 0,
      seed_vertex = edit.seed_vertex or 0, kind = edit.curve_kind or 0 })
    desc.curve = line
    along = { along, line } -- kept until the call has returned
  end
  local added, removed
  if edit.add then added, desc.add_count = integers(edit.add, 'add'); desc.add_vertices = added end
  if edit.remove then removed, desc.remove_count = integers(edit.remove, 'remove'); desc.remove_vertices = removed end
  check(C.hf_region_edit(self.raw, desc))
  return (along or added or removed) and nil
end
function Region:record() check(C.hf_region_record(self.raw)) end
function Region:undo() check(C.hf_region_undo(self.raw)) end
function Region:redo() check(C.hf_region_redo(self.raw)) end
function Region:info() return query('hf_region_info', C.hf_region_get_info, self.raw) end
-- Vertices inside (0), on the rim (1), or the sites that hold the base (2): cdata from 0, and how many.
function Region:vertices(which)
  return core.rows('uint32_t', function(capacity, out, count)
    return C.hf_region_get_vertices(self.raw, core.whole(which or 0, 'which'), capacity, out, count)
  end)
end
-- xyz of the corners of the last closed curve, and how many corners; the last is joined to the first.
function Region:curve()
  local count = ffi.new('uint32_t[1]')
  check(C.hf_region_get_curve(self.raw, 0, nil, count))
  local out = ffi.new('double[?]', 3 * count[0] + 1)
  if count[0] > 0 then check(C.hf_region_get_curve(self.raw, count[0], out, count)) end
  return out, count[0]
end
-- 0: the surface, 1: its base without detail, between and beyond in proportion
function Region:morph(weight) return morph(C.hf_region_morph, self, weight) end

local Detail = class('Detail', function(raw) C.hf_detail_destroy(raw) end)
-- options: scale, source_vertices and target_vertices (points of the rims that correspond)
function hf.Detail(source, target, options)
  options = options or {}
  local from, to = raw_of(source, 'Region', 'source'), raw_of(target, 'Region', 'target')
  local desc = make('hf_detail_desc', { scale = options.scale or 0 })
  if options.source_vertices or options.target_vertices then
    local starts, count = integers(options.source_vertices or {}, 'source_vertices')
    local ends, other = integers(options.target_vertices or {}, 'target_vertices')
    if count ~= other then fail('source_vertices and target_vertices must be of one length') end
    desc.pair_count, desc.source_vertices, desc.target_vertices = count, starts, ends
  end
  return create(Detail, 'hf_detail', { vertex_count = target.vertex_count }, C.hf_detail_create, from, to, desc)
end
function Detail:morph(weight) return morph(C.hf_detail_morph, self, weight) end

return hf

-- hf for LuaJIT: objects that close themselves, failures as error tables, plain tables or cdata arrays in and out.
--
--   local hf = require('hf')
--   local solver = hf.Solver(positions, triangles)       -- flat lists of numbers, or cdata with its length
--   local sites = solver:add_sites({0, 41}, {0, 1})
--   local field = solver:solve()                          -- cdata double[vertex_count], from 0
--
-- An error is a table { code, name, message, index, where } with __tostring; use pcall. HF_LIBRARY names the shared library.
local ffi = require('ffi')
local constants = require('hf_raw')

local function open()
  local failures = {}
  for _, name in ipairs({ os.getenv('HF_LIBRARY') or 'libhf.so.0', 'hf' }) do
    local ok, library = pcall(ffi.load, name)
    if ok then return library end
    failures[#failures + 1] = library
  end
  error('the hf library was not found; set HF_LIBRARY to libhf.so. ' .. table.concat(failures, '; '))
end
local C = open()

local hf = { constants = constants, C = C }

-- ---- errors
local Error = { __tostring = function(e) return (e.where ~= '' and e.where .. ': ' or '') .. e.message .. ' (' .. e.name .. ')' end }
local function fail(message, name, index)
  error(setmetatable({ code = constants[name or 'HF_ERROR_INVALID_ARGUMENT'], name = name or 'HF_ERROR_INVALID_ARGUMENT', message = message, index = index, where = '' }, Error), 0)
end
function hf.is_error(e) return getmetatable(e) == Error end

local function check(result)
  if result == 0 then return end
  local detail = ffi.new('hf_error_detail')
  C.hf_get_error_detail(detail)
  local index = detail.index ~= constants.HF_NO_INDEX and tonumber(detail.index) or nil
  error(setmetatable({ code = tonumber(result), name = ffi.string(C.hf_result_name(result)), message = ffi.string(detail.message), index = index,
    where = ffi.string(detail['function']) }, Error), 0)
end

local function make(type, fields)
  local desc = ffi.new(type)
  C.hf_init_desc(desc, ffi.sizeof(type))
  for key, value in pairs(fields or {}) do desc[key] = value end
  return desc
end

-- ---- arrays: a list of numbers becomes cdata; cdata with the right element type is used as it is
local function array(values, kind, name, count)
  if values == nil then return nil, 1 end
  if type(values) == 'cdata' then
    local ok, bytes = pcall(ffi.sizeof, values)
    local size = ffi.sizeof(kind)
    if not ok or not ffi.istype(kind .. '[?]', values) then fail(name .. ' must be a list or cdata of ' .. kind .. '[?]') end
    if count and bytes / size ~= count then fail(string.format('%s must hold %d numbers, not %d', name, count, bytes / size)) end
    return values, bytes / size
  end
  if type(values) ~= 'table' then fail(name .. ' must be a list of numbers') end
  if count and #values ~= count then fail(string.format('%s must hold %d numbers, not %d', name, count, #values)) end
  local out = ffi.new(kind .. '[?]', math.max(1, #values))
  for i = 1, #values do
    local v = values[i]
    if type(v) ~= 'number' then fail(string.format('%s[%d] must be a number, not %s', name, i, tostring(v))) end
    if kind == 'uint32_t' then
      if v ~= math.floor(v) then fail(string.format('%s[%d] must be a whole number', name, i)) end
      if v < 0 or v > 4294967295 then fail(string.format('%s[%d] is %g', name, i, v), 'HF_ERROR_OUT_OF_RANGE', i - 1) end
    end
    out[i - 1] = v
  end
  return out, #values
end
local function integers(values, name, count) return array(values, 'uint32_t', name, count) end
local function doubles(values, name, count) return array(values, 'double', name, count) end
local function list(cdata, count)
  local out = {}
  for i = 1, count do out[i] = tonumber(cdata[i - 1]) end
  return out
end
local function regions(lists, name)
  if lists == nil then return nil, nil, 1, 0 end
  local counts, all = {}, {}
  for i, region in ipairs(lists) do
    local vertices, n = integers(region, name .. '[' .. i .. ']')
    counts[i] = n
    for k = 0, n - 1 do all[#all + 1] = tonumber(vertices[k]) end
  end
  local c, v = integers(counts, name), integers(all, name)
  return #counts > 0 and c or nil, #counts > 0 and v or nil, #counts
end
local function options_into(desc, options, allowed)
  for key, value in pairs(options or {}) do
    if not allowed[key] then fail("no option '" .. tostring(key) .. "'") end
    if type(value) ~= 'number' then fail("option '" .. key .. "' must be a number") end
    desc[key] = value
  end
  return desc
end
local function set(names)
  local out = {}
  for name in names:gmatch('%S+') do out[name] = true end
  return out
end

-- ---- objects: `handle` is a cdata with a finaliser; close() may be called more than once, in any order
local function class(name, destroy)
  local methods = {}
  methods.__index = methods
  methods.class = name
  function methods.close(self)
    if self.state.closed then return end
    self.state.closed = true
    destroy(self.raw)
  end
  function methods.adopt(raw, fields)
    local self = setmetatable(fields or {}, methods)
    self.raw = raw[0]
    local state = { closed = false }
    local kept = raw[0]
    self.state = state
    self.guard = ffi.gc(ffi.new('char[1]'), function() if not state.closed then destroy(kept) end end)
    return self
  end
  return methods
end
local function raw_of(thing, kind, name)
  if type(thing) ~= 'table' or thing.class ~= kind then fail(name .. ' must be a ' .. kind) end
  return thing.raw
end

local Solver = class('Solver', function(raw) C.hf_destroy(raw) end)
local create_options = set('weld weld_tolerance operator_kind engine ordering channel_count thread_count site_limit vertex_limit memory_limit_mb penalty field_kind position_stride')

function hf.Solver(positions, triangles, options)
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
  local out = ffi.new('hf_solver[1]')
  check(C.hf_create(desc, out))
  return Solver.adopt(out, { vertex_count = count / 3, channel_count = math.max(1, options.channel_count or 1) })
end
function Solver:clone()
  local out = ffi.new('hf_solver[1]')
  check(C.hf_clone(self.raw, out))
  return Solver.adopt(out, { vertex_count = self.vertex_count, channel_count = self.channel_count })
end
function Solver:report()
  local out = make('hf_mesh_report')
  check(C.hf_get_mesh_report(self.raw, out))
  return out
end
function Solver:statistics()
  local out = make('hf_statistics')
  check(C.hf_get_statistics(self.raw, out))
  return out
end
local function places(self, vertices, values, more)
  more = more or {}
  local at, count = integers(vertices, 'vertices')
  local inside
  if vertices == nil and more.triangles then inside, count = integers(more.triangles, 'triangles') end
  local held = { at, inside, doubles(more.barycentrics, 'barycentrics', 3 * count), doubles(values, 'values', count * self.channel_count),
    doubles(more.stiffness, 'stiffness', count), doubles(more.radii, 'radii', count) }
  local desc = make('hf_sites_desc', { site_count = count, vertices = held[1], triangles = held[2], barycentrics = held[3], values = held[4], stiffness = held[5], radii = held[6] })
  return desc, count, held
end
function Solver:add_sites(vertices, values, more)
  local desc, count, held = places(self, vertices, values, more)
  local out = ffi.new('uint32_t[?]', math.max(1, count))
  check(C.hf_add_sites(self.raw, desc, out))
  return list(out, held and count)
end
function Solver:remove_sites(sites)
  local numbers, count = integers(sites, 'sites')
  check(C.hf_remove_sites(self.raw, count, numbers))
end
function Solver:move_sites(sites, vertices)
  local numbers, count = integers(sites, 'sites')
  local desc, _, held = places(self, vertices)
  check(C.hf_move_sites(self.raw, count, numbers, desc))
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
  local desc = make('hf_edit_desc', { remove_count = #remove, remove_sites = r, move_count = #move, move_sites = m, set_count = #change, set_sites = s, set_values = v })
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
  if ffi.sizeof(out) ~= self.vertex_count * self.channel_count * (single and 4 or 8) then fail('out has the wrong length', 'HF_ERROR_TOO_SMALL') end
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
local function scalars(self, field)
  local values = doubles(field, 'field', self.vertex_count)
  return make('hf_scalars', { values_f64 = values }), values
end
function Solver:space_levels(field, count, spacing)
  local desc, held = scalars(self, field)
  local out = ffi.new('double[?]', math.max(1, count))
  check(C.hf_space_levels(self.raw, desc, spacing or 0, count, out))
  held = nil
  return out
end
function Solver:trace_isolines(field, levels)
  local desc, held = scalars(self, field)
  local wanted, count = doubles(levels, 'levels')
  local lines = make('hf_isolines')
  check(C.hf_trace_isolines(self.raw, desc, count, wanted, lines))
  local p, k = lines.point_count, lines.line_count
  local out = { point_count = p, line_count = k, positions = ffi.new('double[?]', 3 * p + 1), line_starts = ffi.new('uint32_t[?]', k + 1),
    line_levels = ffi.new('uint32_t[?]', k + 1), line_closed = ffi.new('int32_t[?]', k + 1) }
  lines.point_capacity, lines.line_capacity = p, k
  lines.positions, lines.line_starts, lines.line_levels, lines.line_closed = out.positions, out.line_starts, out.line_levels, out.line_closed
  if k > 0 then check(C.hf_trace_isolines(self.raw, desc, count, wanted, lines)) end
  return out
end
function Solver:find_critical_points(field)
  local desc, held = scalars(self, field)
  local info = make('hf_critical_info')
  check(C.hf_find_critical_points(self.raw, desc, 0, nil, info))
  local out = ffi.new('hf_critical_point[?]', info.point_count + 1)
  if info.point_count > 0 then check(C.hf_find_critical_points(self.raw, desc, info.point_count, out, info)) end
  return out, info.point_count
end
function Solver:find_extremities()
  local count = ffi.new('uint32_t[1]')
  check(C.hf_find_extremities(self.raw, nil, 0, nil, count))
  local out = ffi.new('hf_extremity[?]', count[0] + 1)
  if count[0] > 0 then check(C.hf_find_extremities(self.raw, nil, count[0], out, count)) end
  return out, count[0]
end

local Geodesics = class('Geodesics', function(raw) C.hf_geodesics_destroy(raw) end)
function hf.Geodesics(solver, options)
  local desc, out = options_into(make('hf_geodesics_desc'), options, set('smoothing')), ffi.new('hf_geodesics[1]')
  check(C.hf_geodesics_create(raw_of(solver, 'Solver', 'solver'), desc, out))
  return Geodesics.adopt(out, { vertex_count = solver.vertex_count })
end
function Geodesics:distance(sources)
  local at, count = integers(sources, 'sources')
  local out = ffi.new('double[?]', self.vertex_count)
  check(C.hf_geodesics_distance_f64(self.raw, count, at, out, 0))
  return out
end

local Direction = class('Direction', function(raw) C.hf_direction_destroy(raw) end)
function hf.Direction(solver, options)
  local desc, out = options_into(make('hf_direction_desc'), options, set('degree site_limit')), ffi.new('hf_direction[1]')
  check(C.hf_direction_create(raw_of(solver, 'Solver', 'solver'), desc, out))
  return Direction.adopt(out, { vertex_count = solver.vertex_count })
end
function Direction:add_sites(vertices, vectors)
  local at, count = integers(vertices, 'vertices')
  local out = ffi.new('uint32_t[?]', math.max(1, count))
  check(C.hf_direction_add_sites(self.raw, count, at, (doubles(vectors, 'vectors', 3 * count)), out))
  return list(out, count)
end
function Direction:rotate_sites(sites, angles)
  local numbers, count = integers(sites, 'sites')
  check(C.hf_direction_rotate_sites(self.raw, count, numbers, (doubles(angles, 'angles', count))))
end
function Direction:solve()
  local out = ffi.new('double[?]', 3 * self.vertex_count)
  check(C.hf_direction_solve_f64(self.raw, out, 0, nil))
  return out
end
function Direction:singularities()
  local count = ffi.new('uint32_t[1]')
  check(C.hf_direction_get_singularities(self.raw, 0, nil, count))
  local out = ffi.new('hf_singularity[?]', count[0] + 1)
  if count[0] > 0 then check(C.hf_direction_get_singularities(self.raw, count[0], out, count)) end
  return out, count[0]
end

local function skin_of(call, raw, vertex_count, weight_count)
  local info = make('hf_skin_info', { weight_count = weight_count })
  check(call(raw, info))
  local n = info.joint_count
  local skin = { joint_count = n, pivots = ffi.new('double[?]', 3 * n), rotations = ffi.new('double[?]', 4 * n), translations = ffi.new('double[?]', 3 * n),
    joints = ffi.new('uint32_t[?]', vertex_count * weight_count), weights = ffi.new('float[?]', vertex_count * weight_count) }
  info.pivots, info.rotations, info.translations, info.vertex_joints, info.vertex_weights = skin.pivots, skin.rotations, skin.translations, skin.joints, skin.weights
  check(call(raw, info))
  return skin
end

local Pose = class('Pose', function(raw) C.hf_pose_destroy(raw) end)
function hf.Pose(solver, options)
  local desc, out = options_into(make('hf_pose_desc'), options, set('mode band_count iteration_count samples_per_ring group_count')), ffi.new('hf_pose[1]')
  check(C.hf_pose_create(raw_of(solver, 'Solver', 'solver'), desc, out))
  return Pose.adopt(out, { vertex_count = solver.vertex_count })
end
function Pose:add_handles(lists, more)
  more = more or {}
  local desc, held = make('hf_handles_desc', { layer = more.layer or 0 }), {}
  if more.points then
    local at, n = doubles(more.points, 'points')
    held = { at, doubles(more.radii, 'radii', n / 3) }
    desc.handle_count, desc.points, desc.radii = n / 3, held[1], held[2]
  else
    held[1], held[2], desc.handle_count = regions(lists, 'regions')
    desc.region_counts, desc.region_vertices = held[1], held[2]
  end
  local out = ffi.new('uint32_t[?]', desc.handle_count + 1)
  check(C.hf_pose_add_handles(self.raw, desc, out))
  return list(out, desc.handle_count)
end
function Pose:remove_handles(handles)
  local numbers, count = integers(handles, 'handles')
  check(C.hf_pose_remove_handles(self.raw, count, numbers))
end
function Pose:set_transforms(handles, rotations, translations)
  local numbers, count = integers(handles, 'handles')
  local turns, shifts = doubles(rotations, 'rotations', 4 * count), doubles(translations, 'translations', 3 * count)
  local packed = ffi.new('hf_transform[?]', count + 1)
  for i = 0, count - 1 do
    for c = 0, 3 do packed[i].rotation[c] = turns and turns[4 * i + c] or 0 end
    for c = 0, 2 do packed[i].translation[c] = shifts and shifts[3 * i + c] or 0 end
  end
  check(C.hf_pose_set_transforms(self.raw, count, numbers, packed))
end
function Pose:handle_info(handle)
  local info = make('hf_handle_info')
  check(C.hf_pose_get_handle(self.raw, handle, info))
  return info
end
function Pose:handle_count() return tonumber(C.hf_pose_get_handle_count(self.raw)) end
function Pose:handle_field(handle)
  local out = ffi.new('float[?]', self.vertex_count)
  check(C.hf_pose_get_field(self.raw, handle, out, 0))
  return out
end
function Pose:deform(out, options)
  out = out or ffi.new('double[?]', 3 * self.vertex_count)
  local single = ffi.istype('float[?]', out)
  if ffi.sizeof(out) ~= 3 * self.vertex_count * (single and 4 or 8) then fail('out has the wrong length', 'HF_ERROR_TOO_SMALL') end
  local desc = options_into(make('hf_deform_desc'), options, set('iteration_count restart refine'))
  desc[single and 'positions' or 'positions_f64'] = out
  check(C.hf_deform(self.raw, desc, nil))
  return out
end
function Pose:skin(weight_count) return skin_of(C.hf_pose_get_skin, self.raw, self.vertex_count, weight_count or 4) end

local Transfer = class('Transfer', function(raw) C.hf_transfer_destroy(raw) end)
function hf.Transfer(source, target, options)
  local desc, out = options_into(make('hf_transfer_desc'), options, set('mode cluster_count kernel_width scale alignment_angle')), ffi.new('hf_transfer[1]')
  check(C.hf_transfer_create(raw_of(source, 'Solver', 'source'), raw_of(target, 'Solver', 'target'), desc, out))
  return Transfer.adopt(out, { source_vertex_count = source.vertex_count, vertex_count = target.vertex_count })
end
function Transfer:add_pairs(source_regions, target_regions, flags)
  local sc, sv, n = regions(source_regions, 'source_regions')
  local tc, tv, m = regions(target_regions, 'target_regions')
  if n ~= m then fail('source_regions and target_regions must be of one length') end
  local marks = integers(flags, 'flags', n)
  local desc = make('hf_pairs_desc', { pair_count = n, source_counts = sc, source_vertices = sv, target_counts = tc, target_vertices = tv, flags = marks })
  local out = ffi.new('uint32_t[?]', n + 1)
  check(C.hf_transfer_add_pairs(self.raw, desc, out))
  return list(out, n)
end
function Transfer:remove_pairs(pairs)
  local numbers, count = integers(pairs, 'pairs')
  check(C.hf_transfer_remove_pairs(self.raw, count, numbers))
end
function Transfer:info()
  local info = make('hf_transfer_info')
  check(C.hf_transfer_get_info(self.raw, info))
  return info
end
function Transfer:apply(posed)
  local source = doubles(posed, 'posed', 3 * self.source_vertex_count)
  local out = ffi.new('double[?]', 3 * self.vertex_count)
  check(C.hf_transfer_apply(self.raw, make('hf_transfer_frame', { source_positions_f64 = source, target_positions_f64 = out })))
  return out
end
function Transfer:skin(weight_count) return skin_of(C.hf_transfer_get_skin, self.raw, self.vertex_count, weight_count or 4) end

return hf

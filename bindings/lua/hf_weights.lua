-- Skin weights of a surface for a skeleton; weights carried to another surface, or mirrored.
local ffi = require('ffi')
local core = require('hf_core')
local C, check, fail, make, array = core.C, core.check, core.fail, core.make, core.array
local integers, doubles, class, raw_of, create, query = core.integers, core.doubles, core.class, core.raw_of, core.create,
  core.query

local hf = {}

-- bones: { heads, tails, axes: three numbers for each bone; parents, sources: HF_NO_INDEX for none; deforms: 0 or 1 }
local function describe(bones)
  if type(bones) ~= 'table' then fail('bones must be a table') end
  local heads, size = doubles(bones.heads, 'heads')
  if heads and size % 3 ~= 0 then fail('heads must hold three numbers for each bone') end
  local count = heads and size / 3 or 1
  local desc, held = make('hf_bones_desc', { bone_count = count, heads = heads }), { heads }
  for name, width in pairs({ tails = 3, axes = 3, parents = 1, sources = 1, deforms = 1 }) do
    if bones[name] ~= nil then
      local kind = width == 3 and 'double' or name == 'deforms' and 'int32_t' or 'uint32_t'
      held[name] = array(bones[name], kind, name, width * count)
      desc[name] = held[name]
    end
  end
  if bones.progress then desc.progress = raw_of(bones.progress, 'Progress', 'progress') end
  return desc, held
end

-- Names as the library takes them: one line for each.
local function lines_of(names)
  if names == nil then return nil end
  local lines = {}
  for i, name in ipairs(names) do lines[i] = tostring(name):gsub('[\n%z]', ' ') .. '\n' end
  return table.concat(lines)
end

-- Arrays for all vertices: { weight_count, joints, weights, origins }, cdata from 0.
local function room(vertex_count, weight_count)
  local n = vertex_count * weight_count
  local found = { weight_count = weight_count, joints = ffi.new('uint32_t[?]', n + 1),
    weights = ffi.new('float[?]', n + 1), origins = ffi.new('uint8_t[?]', vertex_count + 1) }
  return found, make('hf_weights_out', { vertex_capacity = vertex_count, joints = found.joints,
    weights = found.weights, origins = found.origins })
end

-- Sets what carried and mirrored weights share. given: { joints, weights }, as many numbers for each vertex.
local function given_into(desc, surface, given, options)
  if type(given) ~= 'table' then fail('given must be a table of joints and weights') end
  local joints, count = integers(given.joints, 'joints')
  if not joints or count % surface.vertex_count ~= 0 then fail('joints must hold as many numbers for each vertex') end
  local weights = array(given.weights or {}, 'float', 'weights', count)
  desc.influence_count, desc.joints, desc.weights = count / surface.vertex_count, joints, weights
  desc.distance, desc.angle = core.real(options.distance or 0, 'distance'), core.real(options.angle or 0, 'angle')
  local each = core.whole(options.weight_count or 4, 'weight_count')
  desc.weight_count = each > 0 and each or 4
  if options.progress then desc.progress = raw_of(options.progress, 'Progress', 'progress') end
  return { joints, weights }
end

local Weights = class('Weights', function(raw) C.hf_weights_destroy(raw) end)
-- weight_count: bones of each vertex, 4 or 8
function hf.Weights(surface, bones, weight_count)
  local parent = raw_of(surface, 'Surface', 'surface')
  local desc, held = describe(bones)
  local made = create(Weights, 'hf_weights', { vertex_count = surface.vertex_count }, C.hf_weights_create, parent, desc,
    core.whole(weight_count or 4, 'weight_count'))
  held = nil -- the library has copied the bones
  return made
end
function Weights:clone()
  return create(Weights, 'hf_weights', { vertex_count = self.vertex_count }, C.hf_weights_clone, self.raw)
end
function Weights:set_bones(bones)
  local desc, held = describe(bones)
  check(C.hf_weights_set_bones(self.raw, desc))
  return held and nil
end
-- Replaces all pins: vertices with given weights, as many joints and weights for each.
function Weights:set_pins(vertices, joints, weights, radii)
  local at, count = integers(vertices or {}, 'vertices')
  local bones, total = integers(joints or {}, 'joints')
  if count > 0 and total % count ~= 0 then fail('joints must hold as many numbers for each pin') end
  local desc = make('hf_pins_desc', { pin_count = count, joint_count = count > 0 and total / count or 0 })
  local shares, sizes = array(weights or {}, 'float', 'weights', total), doubles(radii, 'radii', count)
  if count > 0 then desc.vertices, desc.joints, desc.weights, desc.radii = at, bones, shares, sizes end
  check(C.hf_weights_set_pins(self.raw, desc))
end
-- Locks bones: their weights stay. values: a number for each vertex and lock; nil: the present ones.
function Weights:set_locks(bones, values)
  local numbers, count = integers(bones or {}, 'bones')
  local kept = array(values, 'float', 'values', count * self.vertex_count)
  check(C.hf_weights_set_locks(self.raw, count, numbers, kept))
end
function Weights:weights()
  local ask = make('hf_weights_out')
  check(C.hf_weights_get(self.raw, ask))
  local found, out = room(self.vertex_count, ask.weight_count)
  check(C.hf_weights_get(self.raw, out))
  return found
end
-- Bits HF_BONE_* of each bone: cdata from 0, and how many.
function Weights:bone_flags()
  return core.rows('uint32_t', function(capacity, out, count)
    return C.hf_weights_get_bones(self.raw, capacity, out, nil, count)
  end)
end
-- Bits HF_HELPER_* of each bone, why it looks like a helper: cdata from 0, and how many. names: of the bones, or nil.
function Weights:helpers(names)
  local lines = lines_of(names)
  return core.rows('uint32_t', function(capacity, out, count)
    return C.hf_weights_get_helpers(self.raw, lines, capacity, out, count)
  end)
end
function Weights:info() return query('hf_weights_info', C.hf_weights_get_info, self.raw) end
function Weights:record() check(C.hf_weights_record(self.raw)) end
function Weights:undo() check(C.hf_weights_undo(self.raw)) end
function Weights:redo() check(C.hf_weights_redo(self.raw)) end

-- Carries weights to another surface: clothes, levels of detail. given: { joints, weights } of the source. options:
-- distance, angle, weight_count. Returns the weights and an hf_carry_info.
function hf.carry_weights(source, given, target, options)
  local from, to = raw_of(source, 'Surface', 'source'), raw_of(target, 'Surface', 'target')
  local desc = make('hf_carry_desc')
  local held = given_into(desc, source, given, options or {})
  local found, out = room(target.vertex_count, desc.weight_count)
  local info = make('hf_carry_info')
  check(C.hf_weights_carry(from, to, desc, out, info))
  held = nil
  return found, info
end

-- Mirrors weights of one side to the other. heads: three numbers for each bone. options: names, partners, plane (a point
-- and a normal), to (HF_MIRROR_*), and those of carry_weights. Returns the weights, the partners, how each bone found
-- its own (HF_MIRROR_BONE_*), and an hf_mirror_info.
function hf.mirror_weights(surface, given, heads, options)
  options = options or {}
  local on = raw_of(surface, 'Surface', 'surface')
  local desc = make('hf_mirror_desc')
  local held = given_into(desc, surface, given, options)
  local places, size = doubles(heads or {}, 'heads')
  if size % 3 ~= 0 then fail('heads must hold three numbers for each bone') end
  local count = size / 3
  desc.bone_count, desc.heads = count, places
  desc.to = core.whole(options.to or 0, 'to', -2147483648, 2147483647)
  local lines = lines_of(options.names)
  if lines then desc.names = lines end
  local partners, plane = integers(options.partners, 'partners', count), doubles(options.plane, 'plane', 6)
  desc.partners, desc.plane = partners, plane
  local found, out = room(surface.vertex_count, desc.weight_count)
  local others, pairings = ffi.new('uint32_t[?]', count + 1), ffi.new('uint32_t[?]', count + 1)
  local info = make('hf_mirror_info')
  check(C.hf_weights_mirror(on, desc, out, others, pairings, info))
  held, lines, partners, plane = nil, nil, nil, nil
  return found, others, pairings, info
end

return hf

-- Pose and Transfer: handles that come and go, and the motion of one surface played on another.
local ffi = require('ffi')
local core = require('hf_core')
local C, check, fail, make, integers, doubles, list, regions = core.C, core.check, core.fail, core.make, core.integers,
  core.doubles, core.list, core.regions
local options_into, set, class, raw_of, create, on_numbers, query = core.options_into, core.set, core.class,
  core.raw_of, core.create, core.on_numbers, core.query

local hf = {}

local function skin_of(call, raw, vertex_count, weight_count)
  local info = make('hf_skin_info', { weight_count = weight_count })
  check(call(raw, info))
  local n = info.joint_count
  info.joint_capacity, info.vertex_capacity = n, vertex_count
  local skin = { joint_count = n, pivots = ffi.new('double[?]', 3 * n), rotations = ffi.new('double[?]', 4 * n),
    translations = ffi.new('double[?]', 3 * n),
    joints = ffi.new('uint32_t[?]', vertex_count * weight_count),
      weights = ffi.new('float[?]', vertex_count * weight_count) }
  info.pivots, info.rotations, info.translations, info.vertex_joints, info.vertex_weights = skin.pivots,
    skin.rotations, skin.translations, skin.joints, skin.weights
  check(call(raw, info))
  return skin
end

local Pose = class('Pose', function(raw) C.hf_pose_destroy(raw) end)
function hf.Pose(surface, options)
  return core.create_on(Pose, 'hf_pose', surface, options,
    'mode band_count iteration_count samples_per_ring group_count', C.hf_pose_create)
end
function Pose:clone() return create(Pose, 'hf_pose', { vertex_count = self.vertex_count }, C.hf_pose_clone,
  self.raw) end
-- more: points and radii in place of lists, layer, in_place. in_place = true: the handles start where the posed surface
-- stands, not at rest; handle_info says where.
function Pose:add_handles(lists, more)
  more = more or {}
  local in_place = more.in_place == true and 1 or more.in_place or 0
  local desc, held = make('hf_handles_desc', { layer = more.layer or 0, in_place = in_place }), {}
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
-- One handle: what is edge-connected within radius of a point at rest. Returns its number.
function Pose:add_handle_at(point, radius)
  local out = ffi.new('uint32_t[1]')
  check(C.hf_pose_add_handle_at(self.raw, (doubles(point, 'point', 3)), core.real(radius, 'radius'), out))
  return tonumber(out[0])
end
function Pose:remove_handles(handles)
  on_numbers(C.hf_pose_remove_handles, self.raw, handles, 'handles')
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
function Pose:set_transform(handle, rotation, translation)
  local turn, shift = doubles(rotation, 'rotation', 4), doubles(translation, 'translation', 3)
  local motion = ffi.new('hf_transform')
  for c = 0, 3 do motion.rotation[c] = turn and turn[c] or 0 end
  for c = 0, 2 do motion.translation[c] = shift and shift[c] or 0 end
  check(C.hf_pose_set_transform(self.raw, core.whole(handle, 'handle'), motion))
end
-- 4 x 4 matrices rest to posed, column by column
function Pose:set_matrices(handles, matrices)
  local numbers, count = integers(handles, 'handles')
  check(C.hf_pose_set_matrices(self.raw, count, numbers, (doubles(matrices, 'matrices', 16 * count))))
end
function Pose:info() return query('hf_pose_info', C.hf_pose_get_info, self.raw) end
function Pose:handle_info(handle)
  return query('hf_handle_info', C.hf_pose_get_handle, self.raw, core.whole(handle, 'handle'))
end
function Pose:handle_count() return tonumber(C.hf_pose_get_handle_count(self.raw)) end
function Pose:handle_field(handle)
  local out = ffi.new('float[?]', self.vertex_count)
  check(C.hf_pose_get_field(self.raw, core.whole(handle, 'handle'), out, 0))
  return out
end
function Pose:deform(out, options)
  out = out or ffi.new('double[?]', 3 * self.vertex_count)
  local single = ffi.istype('float[?]', out)
  if ffi.sizeof(out) ~= 3 * self.vertex_count * (single and 4 or 8) then
    fail('out has the wrong length', 'HF_ERROR_TOO_SMALL') end
  local desc = options_into(make('hf_deform_desc'), options, set('iteration_count restart refine refine_from_last'))
  desc[single and 'positions' or 'positions_f64'] = out
  check(C.hf_pose_deform(self.raw, desc, nil))
  return out
end
function Pose:skin(weight_count) return skin_of(C.hf_pose_get_skin, self.raw, self.vertex_count, weight_count or 4) end

local Transfer = class('Transfer', function(raw) C.hf_transfer_destroy(raw) end)
function hf.Transfer(source, target, options)
  local desc = options_into(make('hf_transfer_desc'), options,
    set('mode cluster_count kernel_width scale alignment_angle ground'))
  local from, to = raw_of(source, 'Surface', 'source'), raw_of(target, 'Surface', 'target')
  return create(Transfer, 'hf_transfer', { source_vertex_count = source.vertex_count,
    vertex_count = target.vertex_count },
    C.hf_transfer_create, from, to, desc)
end
function Transfer:add_pairs(source_regions, target_regions, flags)
  local sc, sv, n = regions(source_regions, 'source_regions')
  local tc, tv, m = regions(target_regions, 'target_regions')
  if n ~= m then fail('source_regions and target_regions must be of one length') end
  local marks = integers(flags, 'flags', n)
  local desc = make('hf_pairs_desc', { pair_count = n, source_counts = sc, source_vertices = sv, target_counts = tc,
    target_vertices = tv, flags = marks })
  local out = ffi.new('uint32_t[?]', n + 1)
  check(C.hf_transfer_add_pairs(self.raw, desc, out))
  return list(out, n)
end
function Transfer:remove_pairs(pairs)
  on_numbers(C.hf_transfer_remove_pairs, self.raw, pairs, 'pairs')
end
function Transfer:pair_info(pair) return query('hf_pair_info', C.hf_transfer_get_pair, self.raw, core.whole(pair, 'pair')) end
function Transfer:info()
  return query('hf_transfer_info', C.hf_transfer_get_info, self.raw)
end
-- stride, hip_height, neck_follow, tail_follow, arm_space, long_follow of the next frames; the others become neutral
function Transfer:set_dials(dials)
  check(C.hf_transfer_set_dials(self.raw, options_into(make('hf_transfer_dials'), dials,
    set('stride hip_height neck_follow tail_follow arm_space long_follow'))))
end
function Transfer:dials() return query('hf_transfer_dials', C.hf_transfer_get_dials, self.raw) end
function Transfer:sinking()
  local out = ffi.new('uint8_t[?]', self.vertex_count)
  check(C.hf_transfer_get_sinking(self.raw, out))
  return out
end
function Transfer:apply(posed)
  local source = doubles(posed, 'posed', 3 * self.source_vertex_count)
  local out = ffi.new('double[?]', 3 * self.vertex_count)
  check(C.hf_transfer_apply(self.raw,
    make('hf_transfer_frame', { source_positions_f64 = source, target_positions_f64 = out })))
  return out
end
function Transfer:skin(weight_count) return skin_of(C.hf_transfer_get_skin, self.raw, self.vertex_count,
  weight_count or 4) end

return hf

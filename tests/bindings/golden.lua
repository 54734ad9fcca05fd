-- The golden scenes (bindings/golden/README.md) through the LuaJIT binding: golden.lua FILE...
local here = arg[0]:match('(.*/)') or './'
local root = here .. '../../'
package.path = root .. 'bindings/lua/?.lua;' .. package.path
local ffi = require('ffi')
local hf = require('hf')

-- ---- a small reader of JSON; null inside lists does not occur in the scenes, null as a value becomes nil
local function parse(text)
  local at = 1
  local value
  local function space() at = text:find('%S', at) end
  local function string_()
    local stop = text:find('"', at + 1, true)
    local found = text:sub(at + 1, stop - 1)
    at = stop + 1
    return found
  end
  function value()
    space()
    local c = text:sub(at, at)
    if c == '{' or c == '[' then
      local out, close = {}, c == '{' and '}' or ']'
      at = at + 1
      space()
      while text:sub(at, at) ~= close do
        if c == '{' then
          local key = string_()
          space()
          at = at + 1
          out[key] = value()
        else out[#out + 1] = value() end
        space()
        if text:sub(at, at) == ',' then at = at + 1; space() end
      end
      at = at + 1
      return out
    elseif c == '"' then return string_()
    elseif text:sub(at, at + 3) == 'null' then at = at + 4; return nil
    elseif text:sub(at, at + 3) == 'true' then at = at + 4; return true
    elseif text:sub(at, at + 4) == 'false' then at = at + 5; return false end
    local stop = text:find('[^%-%+%.%deE]', at)
    local number = tonumber(text:sub(at, stop - 1))
    at = stop
    return number
  end
  return value()
end
local function read(path)
  local file = assert(io.open(path, 'r'))
  local text = file:read('*a')
  file:close()
  return parse(text)
end

local Mismatch = {}
local function expect(condition, message) if not condition then error(setmetatable({ message = message }, Mismatch),
  0) end end
local function number(v) return ({ nan = 0 / 0, inf = math.huge, ['-inf'] = -math.huge })[v] or v end

local function compare(a, n, wanted)
  local sum, weighted, least, most = 0, 0, math.huge, -math.huge
  for i = 0, n - 1 do
    local v = tonumber(a[i])
    expect(v == v and v ~= math.huge and v ~= -math.huge, 'not finite')
    sum, weighted, least, most = sum + v, weighted + v * (i % 7 + 1), math.min(least, v), math.max(most, v)
  end
  if n == 0 then least, most = 0, 0 end
  local t = wanted.tolerance or 0
  for key, row in pairs({ count = { n, 0 }, sum = { sum, t * n + 1e-9 }, weighted = { weighted, 7 * t * n + 1e-9 },
    min = { least, t }, max = { most, t } }) do
    if wanted[key] then expect(math.abs(row[1] - wanted[key]) <= row[2],
      key .. ' is ' .. row[1] .. ', not ' .. wanted[key]) end
  end
  for k, place in ipairs(wanted.at or {}) do expect(math.abs(tonumber(a[place]) - wanted.values[k]) <= t,
    'value at ' .. place) end
end

-- Triangles in the layout a step asks for; what lies between them is all ones.
local function place_of(list)
  if #list == 1 then return list[1] end
  return { corners = { list[1], list[2], list[3] }, barycentrics = { list[4], list[5], list[6] } }
end
local function lay_out(triangles, bits, stride)
  local width = bits / 8
  if stride == 0 then stride = 3 * width end
  local row, count = stride / width, #triangles / 3
  local out = ffi.new(bits == 16 and 'uint16_t[?]' or 'uint32_t[?]', row * count)
  ffi.fill(out, ffi.sizeof(out), 255)
  for i = 0, #triangles - 1 do out[math.floor(i / 3) * row + i % 3] = triangles[i + 1] end
  return out, stride
end

local function new_scene(meshes)
  local objects, kept = {}, {}
  local function run(step)
    local what, on = step['do'], objects[step.on]
    local function get(key)
      local v = step[key]
      if type(v) == 'string' then return kept[v] and kept[v][1] end
      if type(v) ~= 'table' then return v end
      local out = {}
      for i, x in ipairs(v) do out[i] = type(x) == 'table' and x or number(x) end
      return out
    end
    local options = {}
    for key, v in pairs(step.options or {}) do options[key] = type(v) == 'string' and hf.constants[v] or v end
    local n = on and on.vertex_count
    if what == 'surface' then
      local mesh = step.mesh and meshes[step.mesh] or {}
      local positions, triangles
      if mesh.positions then positions, triangles = { unpack(mesh.positions) }, { unpack(mesh.triangles) } end
      for key, v in pairs(step.positions or {}) do positions[tonumber(key) + 1] = number(v) end
      for key, v in pairs(step.triangles or {}) do triangles[tonumber(key) + 1] = v end
      if step.no_triangles then triangles = {} end
      local factor = step.factor and kept[step.factor]
      if factor and step.damage then
        local place = step.damage + 1
        factor = factor:sub(1, place - 1) .. string.char(bit.bxor(factor:byte(place), 1)) .. factor:sub(place + 1)
      end
      options.saved_factor, options.tags = factor, get('tags')
      if step.faces then
        triangles, options.faces = nil, { starts = step.faces.offsets, corners = step.faces.corners }
      end
      if triangles and (step.index_bits or step.triangle_stride) then
        triangles, options.triangle_stride = lay_out(triangles, step.index_bits or 32, step.triangle_stride or 0)
      end
      objects[step.as] = hf.Surface(positions, triangles, options)
    elseif what == 'graph' then
      options.masses = get('masses')
      objects[step.as] = hf.graph_surface(step.vertex_count, get('edges'), get('weights'), options)
    elseif what == 'solver' then objects[step.as] = hf.Solver(on, options)
    elseif what == 'clone' then objects[step.as] = on:clone()
    elseif what == 'dispose' then on:close()
    elseif what == 'add_sites' then return 'numbers', on:add_sites(get('vertices'), get('values'),
      { stiffness = get('stiffness'), radii = get('radii'), triangles = get('triangles'),
      barycentrics = get('barycentrics') })
    elseif what == 'add_site' then return 'numbers', { on:add_site(step.vertex, step.value and number(step.value)) }
    elseif what == 'remove_sites' then on:remove_sites(get('sites'))
    elseif what == 'move_sites' then on:move_sites(get('sites'), get('vertices'))
    elseif what == 'set_values' then on:set_values(get('sites'), get('values'))
    elseif what == 'edit' then return 'numbers', on:edit_sites(step)
    elseif what == 'record' then on:record()
    elseif what == 'undo' then on:undo()
    elseif what == 'redo' then on:redo()
    elseif what == 'solve' then return 'array', on:solve(), n
    elseif what == 'solve_f32' then return 'array', on:solve(ffi.new('float[?]', n)), n
    elseif what == 'preview' then return 'array', on:solve_preview(step.correction_count), n
    elseif what == 'solve_at' then return 'array', on:solve_at(get('vertices'))
    elseif what == 'report' then return 'struct', on:report()
    elseif what == 'surface_info' or what == 'solver_info' or what == 'pose_info' then return 'struct', on:info()
    elseif what == 'components' then return 'array', on:components(), n
    elseif what == 'cast_ray' then
      local hit = on:cast_ray(get('origin'), get('direction'),
        { positions = get('positions'), front_only = step.front_only })
      if not hit then return 'array', ffi.new('double[1]'), 1 end
      local w, at = hit.barycentrics, hit.position
      return 'array', ffi.new('double[10]', { 1, hit.triangle, hit.vertex, w[0], w[1], w[2], at[0], at[1], at[2],
        hit.distance }), 10
    elseif what == 'find_vertex' then
      local vertex, distance = on:find_vertex(get('point'), { positions = get('positions') })
      return 'array', ffi.new('double[2]', { vertex, distance }), 2
    elseif what == 'statistics' or what == 'surface_statistics' then return 'struct', on:statistics()
    elseif what == 'certify' then return 'struct', on:certify(step.tolerance and number(step.tolerance))
    elseif what == 'save' then kept[step.as] = on:save(step.field_kind)
    elseif what == 'levels' then return 'array', on:space_levels(get('field'), step.count, hf.constants[step.spacing]),
      step.count
    elseif what == 'isolines' then
      local lines = on:trace_isolines(get('field'), get('levels'))
      if step.lines then
        local closed = 0
        for i = 0, lines.line_count - 1 do closed = closed + lines.line_closed[i] end
        expect(lines.line_count == step.lines and closed == step.closed, 'lines')
      end
      return 'array', lines.positions, 3 * lines.point_count
    elseif what == 'critical' or what == 'extremities' or what == 'propose' or what == 'singularities' then
      local found, count
      if what == 'critical' then found, count = on:find_critical_points(get('field')) elseif what == 'extremities' then
        found, count = on:find_extremities() elseif what == 'propose' then
        found, count = on:propose_handles() else found, count = on:singularities() end
      local list = {}
      for i = 0, count - 1 do list[i + 1] = tonumber((what == 'extremities' or what == 'propose') and found[i].vertex
        or found[i].index) end
      if what == 'extremities' or what == 'propose' then table.sort(list) end
      local out = ffi.new('double[?]', count + 1)
      for i = 1, count do out[i - 1] = list[i] end
      return 'array', out, count
    elseif what == 'geodesics' then objects[step.as] = hf.Geodesics(on, options)
    elseif what == 'distance' then return 'array', on:distance(get('sources')), n
    elseif what == 'path' then return 'array', on:path(place_of(get('from')), place_of(get('to')))
    elseif what == 'map' then return 'array', on:map(place_of(get('centre')), step.radius), 2 * n
    elseif what == 'direction' then objects[step.as] = hf.Direction(on, options)
    elseif what == 'add_vectors' then return 'numbers', on:add_sites(get('vertices'), get('vectors'))
    elseif what == 'rotate' then on:rotate_sites(get('sites'), get('angles'))
    elseif what == 'remove_vectors' then on:remove_sites(get('sites'))
    elseif what == 'move_vectors' then on:move_sites(get('sites'), get('vertices'))
    elseif what == 'set_vectors' then on:set_vectors(get('sites'), get('vectors'))
    elseif what == 'record_vectors' then on:record()
    elseif what == 'undo_vectors' then on:undo()
    elseif what == 'redo_vectors' then on:redo()
    elseif what == 'clone_vectors' then objects[step.as] = on:clone()
    elseif what == 'vectors' then
      local found = on:sites()
      return 'array', found.vectors, 3 * found.count
    elseif what == 'quads' or what == 'update_quads' then
      options.edge_length = step.edge_length and number(step.edge_length)
      for _, key in ipairs({ 'crease_edges', 'guide_vertices', 'guide_vectors', 'guide_weights', 'pole_points',
        'pole_quads', 'pole_directions', 'symmetry_plane' }) do
        options[key] = get(key)
      end
      if what == 'update_quads' then
        on:update(options)
        local mesh = on:mesh()
        return 'array', mesh.positions, 3 * mesh.vertex_count
      end
      objects[step.as] = hf.Quads(on, options)
    elseif what == 'quads_info' then
      local info = on:info()
      return 'struct', { euler_characteristic = info.euler_characteristic, face_count = info.face_count }
    elseif what == 'quad_mesh' then
      local mesh = on:mesh()
      return 'array', mesh.positions, 3 * mesh.vertex_count
    elseif what == 'flow' then objects[step.as] = hf.Flow(on)
    elseif what == 'flow_lines' then
      local lines = on:trace(get('field'), { wanted_count = step.count, seeds = get('seeds') })
      expect(step.lines == nil or step.lines == lines.line_count, lines.line_count .. ' lines')
      return 'array', lines.positions, 3 * lines.point_count
    elseif what == 'region' then objects[step.as] = hf.Region(on, get('positions'), options)
    elseif what == 'weights' or what == 'set_bones' then
      local bones = {}
      for _, key in ipairs({ 'heads', 'tails', 'axes', 'parents', 'deforms', 'sources' }) do bones[key] = get(key) end
      if what == 'set_bones' then on:set_bones(bones)
      else objects[step.as] = hf.Weights(on, bones, options.weight_count) end
    elseif what == 'set_pins' then on:set_pins(get('vertices'), get('joints'), get('weights'))
    elseif what == 'set_locks' then on:set_locks(get('bones'))
    elseif what == 'record_weights' then on:record()
    elseif what == 'undo_weights' then on:undo()
    elseif what == 'redo_weights' then on:redo()
    elseif what == 'clone_weights' then objects[step.as] = on:clone()
    elseif what == 'weights_info' then return 'struct', on:info()
    elseif what == 'bone_flags' or what == 'helpers' then
      local found, count
      if what == 'helpers' then found, count = on:helpers(step.names) else found, count = on:bone_flags() end
      local out = ffi.new('double[?]', count + 1)
      for i = 0, count - 1 do out[i] = found[i] end
      return 'array', out, count
    elseif what == 'skin_weights' or what == 'carry' or what == 'mirror' then
      local given, found = { joints = get('joints'), weights = get('weights') }, nil
      if what == 'skin_weights' then found = on:weights()
      elseif what == 'carry' then found = hf.carry_weights(objects[step.source], given, on)
      else found = hf.mirror_weights(on, given, get('heads'), { names = step.names, plane = get('plane'), to = step.to }) end
      local out, k = ffi.new('double[?]', n), found.weight_count
      for i = 0, n * k - 1 do
        if found.joints[i] == step.bone then
          local v = math.floor(i / k)
          out[v] = out[v] + found.weights[i]
        end
      end
      return 'array', out, n
    elseif what == 'region_edit' then
      on:edit({ curve = step.curve, curve_kind = step.curve_kind, rings = step.rings, add = step.add, remove = step.remove })
    elseif what == 'region_info' then return 'struct', on:info()
    elseif what == 'region_vertices' then
      local found, count = on:vertices(step.list)
      local out = ffi.new('double[?]', count + 1)
      for i = 0, count - 1 do out[i] = found[i] end
      return 'array', out, count
    elseif what == 'region_curve' then
      local found, count = on:curve()
      return 'array', found, 3 * count
    elseif what == 'record_region' then on:record()
    elseif what == 'undo_region' then on:undo()
    elseif what == 'redo_region' then on:redo()
    elseif what == 'morph' then return 'array', on:morph(number(step.weight)), 3 * n
    elseif what == 'detail' then objects[step.as] = hf.Detail(objects[step.source], objects[step.target], options)
    elseif what == 'directions' then return 'array', on:solve(), 3 * n
    elseif what == 'pose' then objects[step.as] = hf.Pose(on, options)
    elseif what == 'add_handles' then return 'numbers',
      on:add_handles(step.regions, { points = get('points'), radii = get('radii'), layer = step.layer,
        in_place = step.in_place })
    elseif what == 'add_handle_at' then return 'numbers', { on:add_handle_at(get('point'), number(step.radius)) }
    elseif what == 'remove_handles' then on:remove_handles(get('handles'))
    elseif what == 'set_transforms' then on:set_transforms(get('handles'), get('rotations'), get('translations'))
    elseif what == 'set_transform' then on:set_transform(step.handle, get('rotation'), get('translation'))
    elseif what == 'deform_f32' then return 'array', on:deform(ffi.new('float[?]', 3 * n)), 3 * n
    elseif what == 'deform' then return 'array', on:deform(nil, options), 3 * n
    elseif what == 'handle_field' then return 'array', on:handle_field(step.handle), n
    elseif what == 'handle_info' then return 'struct', on:handle_info(step.handle)
    elseif what == 'handle_place' then
      local info, out = on:handle_info(step.handle), ffi.new('double[7]')
      for i = 0, 3 do out[i] = info.rotation[i] end
      for i = 0, 2 do out[4 + i] = info.translation[i] end
      return 'array', out, 7
    elseif what == 'skin' then return 'array', on:skin(step.weight_count).weights, n * step.weight_count
    elseif what == 'transfer' then objects[step.as] = hf.Transfer(objects[step.source], objects[step.target], options)
    elseif what == 'add_pairs' then return 'numbers', on:add_pairs(step.source_regions, step.target_regions,
      get('flags'))
    elseif what == 'remove_pairs' then on:remove_pairs(get('pairs'))
    elseif what == 'set_dials' then on:set_dials(options)
    elseif what == 'dials' then return 'struct', on:dials()
    elseif what == 'transfer_info' then return 'struct', on:info()
    elseif what == 'apply' then return 'array', on:apply(get('positions')), 3 * n
    else error('unknown step ' .. what) end
  end
  return function(step)
    local ok, kind, result, n = pcall(run, step)
    if not ok then
      if not hf.is_error(kind) then error(kind, 0) end
      expect(kind.name == step.error, 'raised ' .. tostring(kind))
      expect(step.index == nil or step.index == kind.index, 'index ' .. tostring(kind.index))
      return
    end
    expect(step.error == nil, 'did not fail with ' .. tostring(step.error))
    if kind == 'array' then
      if step.expect then compare(result, n, step.expect) end
      if step.same_as then expect(ffi.string(result, 8 * n) == ffi.string(kept[step.same_as][1], 8 * n),
        'differs from ' .. step.same_as) end
      if step.keep then kept[step.keep] = { result, n } end
    elseif kind == 'numbers' and step.numbers then expect(table.concat(result, ' ') == table.concat(step.numbers, ' '),
      'numbers')
    elseif kind == 'struct' then
      for key, v in pairs(step.expect or {}) do
        if key ~= 'tolerance' then expect(math.abs(tonumber(result[key]) - v) <= (step.expect.tolerance or 0),
          key .. ' is ' .. tostring(result[key])) end
      end
    end
  end
end

local meshes, failed, wrong_calls = {}, 0, 0
for _, name in ipairs({ 'strip', 'torus', 'bar', 'long_bar', 'small', 'lonely', 'pair' }) do meshes[name] =
  read(root .. 'bindings/golden/meshes/' .. name .. '.json') end
for i = 1, #arg do
  for _, scene in ipairs(read(arg[i]).scenes) do
    local step_of = new_scene(meshes)
    for place, step in ipairs(scene.steps) do
      if step.error then wrong_calls = wrong_calls + 1 end
      local ok, e = pcall(step_of, step)
      if not ok then
        failed = failed + 1
        print(string.format('FAILED %s, step %d (%s): %s', scene.name, place - 1, step['do'],
          getmetatable(e) == Mismatch and e.message or tostring(e)))
      end
    end
    print(scene.name .. ': ' .. #scene.steps .. ' steps')
  end
end

print(wrong_calls .. ' wrong calls answered')
assert(wrong_calls >= 100)

-- ---- closing and collecting in any order; memory comes back
math.randomseed(7)
local calls = 0
local zeros = {}
for i = 1, #meshes.bar.positions / 3 do zeros[i] = 0 end
for _ = 1, 120 do
  local surface = hf.Surface(meshes.bar.positions, meshes.bar.triangles)
  local solver = hf.Solver(surface)
  local things = { solver, solver:clone(), hf.Pose(surface), hf.Transfer(surface, surface), hf.Geodesics(surface),
    hf.Direction(surface), hf.Flow(surface), surface }
  things[3]:add_handles({ { 0, 1, 2 }, { 280, 281 } })
  while #things > 0 do
    local thing = table.remove(things, math.random(#things))
    if math.random() < 0.6 then
      thing:close()
      thing:close()
      local ok, e = pcall(thing.solve or thing.deform or thing.report or thing.info or function()
        return thing.distance and thing:distance({ 0 }) or thing:trace(zeros, { wanted_count = 4 })
      end, thing)
      assert(not ok and e.name == 'HF_ERROR_INVALID_HANDLE', tostring(e))
      calls = calls + 1
    elseif thing.class == 'Pose' then thing:deform() end
    if math.random() < 0.1 then collectgarbage() end
  end
  surface, solver = nil, nil
end
assert(calls > 100)
local function resident()
  collectgarbage(); collectgarbage()
  local file = io.open('/proc/self/statm')
  if not file then return 0 end
  local pages = tonumber(file:read('*a'):match('%d+ (%d+)'))
  file:close()
  return pages * 4096
end
local function work(count)
  for _ = 1, count do
    local pose = hf.Pose(hf.Surface(meshes.torus.positions, meshes.torus.triangles))
    pose:add_handles({ { 0, 1 }, { 140, 141 } })
    pose:deform()
    if _ % 10 == 0 then collectgarbage() end
  end
end
local held = hf.Pose(hf.Surface(meshes.torus.positions, meshes.torus.triangles))
held:add_handles({ { 0, 1 }, { 140, 141 } })
held:set_transforms({ 0, 1 }, nil, { 0, 0, 3, 0, 0, 3 })
held:deform()
local stands = held:handle_info(held:add_handles({ { 70, 71 } }, { in_place = true })[1]).translation[2]
assert(math.abs(stands - 3) < 1e-6, 'in_place takes true')
for _, slip in ipairs({ 2, 0.5, 'true' }) do
  assert(not pcall(held.add_handles, held, { { 90 } }, { in_place = slip }), 'in_place = ' .. tostring(slip))
end
work(30)
local before = resident()
work(150)
assert(resident() - before < 16e6, 'memory does not come back')
-- faces: a quad by offsets and by sizes; a hit in it is a site
for _, faces in ipairs({ { starts = { 0, 4 } }, { sizes = { 4 } }, { starts = { 0 }, sizes = { 4 } } }) do
  faces.corners = { 0, 1, 2, 3 }
  local quad = hf.Surface({ 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, nil, { faces = faces })
  assert(quad:report().polygon_count == 1)
  local hit = quad:cast_ray({ 0.3, 0.6, 1 }, { 0, 0, -1 })
  local solver = hf.Solver(quad)
  solver:add_sites(nil, { 2 }, { corners = { hit.corners[0], hit.corners[1], hit.corners[2] },
    barycentrics = { hit.barycentrics[0], hit.barycentrics[1], hit.barycentrics[2] } })
  assert(hit.triangle == 0 and math.abs(solver:solve()[3] - 2) < 1e-6)
end
for number, wrong in ipairs({ function() hf.Surface('text', {}) end, function() hf.Surface({ 0, 1 }, { 0, 1, 2 }) end,
  function() hf.Surface({ 'a', 1, 2 }, { 0, 1, 2 }) end, function() hf.Pose(nil) end,
  function() hf.Pose(3) end,
  function() hf.Solver(nil) end, function() hf.Solver({}) end, function() hf.Transfer({}, {}) end, function() hf.Surface(meshes.torus.positions,
    { 0.5, 1, 2 }) end, function() hf.Surface(meshes.torus.positions, { -1, 1, 2 }) end }) do
  local ok, e = pcall(wrong)
  assert(not ok and hf.is_error(e), 'case ' .. number .. ': ' .. tostring(e))
end
-- ---- numbers that LuaJIT would cut or wrap are refused, and the message names them
do
  local positions, triangles = meshes.torus.positions, meshes.torus.triangles
  local surface = hf.Surface(positions, triangles)
  local solver = hf.Solver(surface)
  solver:add_sites({ 0, 100 }, { 0, 1 })
  local field, pose, region = solver:solve(), hf.Pose(surface), hf.Region(surface)
  local function refused(word, call)
    local ok, e = pcall(call)
    assert(not ok and hf.is_error(e) and tostring(e):find(word, 1, true), word .. ': ' .. tostring(e))
  end
  local nan = 0 / 0
  local makers = {
    thread_count = function(o) return hf.Surface(positions, triangles, o) end,
    site_limit = function(o) return hf.Solver(surface, o) end,
    band_count = function(o) return hf.Pose(surface, o) end,
    cluster_count = function(o) return hf.Transfer(surface, surface, o) end,
    relax_count = function(o) return hf.Quads(surface, o) end,
  }
  for option, maker in pairs(makers) do
    for _, slip in ipairs({ 2 ^ 32, 2 ^ 32 + 1, -1, 1.5, nan, math.huge, true, '1', 1ULL, {} }) do
      refused(option, function() maker({ [option] = slip }) end)
    end
  end
  for _, slip in ipairs({ 2 ^ 31, -2 ^ 31 - 1, 0.5, nan, '0' }) do
    refused("option 'weld'", function() hf.Surface(positions, triangles, { weld = slip }) end)
  end
  for _, slip in ipairs({ nan, math.huge, 1e300, -1, true, '1' }) do
    refused('', function() hf.Surface(positions, triangles, { weld = 2, weld_tolerance = slip }) end)
  end
  for _, slip in ipairs({ 2 ^ 32, -1, 1.5, nan, '1', true }) do
    refused('count', function() surface:space_levels(field, slip) end)
    refused('spacing', function() surface:space_levels(field, 3, slip) end)
    refused('field_kind', function() surface:save(slip) end)
    refused('correction_count', function() solver:solve_preview(slip) end)
    refused('handle', function() pose:handle_info(slip) end)
    refused('which', function() region:vertices(slip) end)
    refused('vertex', function() solver:add_site(slip) end)
  end
  for _, slip in ipairs({ '1', true, {} }) do
    refused('radius', function() pose:add_handle_at({ 0, 0, 0 }, slip) end)
    refused('weight', function() region:morph(slip) end)
  end
  local ffi = require('ffi')
  for _, wrong in ipairs({ ffi.new('float[?]', 6), ffi.new('int64_t[?]', 6), ffi.new('complex[?]', 6),
    { 1ULL, 2ULL }, { true, false }, { '1', '2' }, 'ab', 5 }) do
    refused('values', function() solver:add_sites({ 5, 6 }, wrong) end)
  end
  -- a copied table is the same object: closing one closes both, once
  local twin = {}
  for key, value in pairs(solver) do twin[key] = value end
  setmetatable(twin, getmetatable(solver))
  twin:close()
  refused('HF_ERROR_INVALID_HANDLE', function() solver:solve() end)
  solver:close()
end
os.exit(failed == 0 and 0 or 1)

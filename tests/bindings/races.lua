-- races.lua: objects made, used, closed and dropped in compiled loops while the collector runs at every step.
-- Only the library's own errors may come out, and none of them HF_ERROR_INTERNAL. 4,000 calls, 100,000 with
-- HF_FULL_TESTS.
local hf = require('hf')
local calls = os.getenv('HF_FULL_TESTS') and 100000 or 4000

-- a bar of n x 4 vertices, open at both ends
local n = 12
local positions, triangles = {}, {}
for i = 0, n - 1 do
  for _, p in ipairs({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }) do
    positions[#positions + 1], positions[#positions + 2], positions[#positions + 3] = p[1], i, p[2]
  end
end
for i = 0, n - 2 do
  for k = 0, 3 do
    local a, b = 4 * i + k, 4 * i + (k + 1) % 4
    for _, v in ipairs({ a, b, b + 4, a, b + 4, a + 4 }) do triangles[#triangles + 1] = v end
  end
end
local count = 4 * n
local heights = {}
for i = 0, count - 1 do heights[i + 1] = math.floor(i / 4) end

math.randomseed(5)
collectgarbage('setpause', 50)
collectgarbage('setstepmul', 1000)
local random = math.random
local surfaces = { hf.Surface(positions, triangles), hf.Surface(positions, triangles) }
local makers = {
  function(s) return hf.Solver(s) end,
  function(s)
    local pose = hf.Pose(s)
    pose:add_handles({ { 0, 1 }, { count - 2, count - 1 } })
    return pose
  end,
  function(s) return hf.Geodesics(s) end,
  function(s) return hf.Region(s) end,
  function(s) return hf.Direction(s) end,
  function(s) return hf.Flow(s) end,
  function(s)
    surfaces[random(2)] = hf.Surface(positions, triangles)
    return hf.Solver(s)
  end,
}
local uses = {
  Solver = function(t)
    local action = random(6)
    if action == 1 then return t:add_sites({ random(count) - 1 }, { 1 }) end
    if action == 2 then return t:remove_sites({ 0 }) end
    if action == 3 then return t:clone():solve() end
    if action == 4 then return t:record() end
    if action == 5 then return t:undo() end
    return t:solve()
  end,
  Pose = function(t) return t:deform() end,
  Geodesics = function(t) return t:distance({ 0 }) end,
  Region = function(t) return t:edit({ add = { random(count) - 1 } }) end,
  Direction = function(t) return t:add_sites({ 0 }, { 1, 0, 0 }) end,
  Flow = function(t) return t:trace(heights, { wanted_count = 2 }) end,
}

local slots, refused = {}, {}
local function step()
  local at, action = random(12), random()
  local thing = slots[at]
  if not thing or action < 0.1 then
    slots[at] = makers[random(#makers)](surfaces[random(2)])
  elseif action < 0.2 then
    thing:close()
  elseif action < 0.21 then
    slots[at] = nil
    collectgarbage(random() < 0.1 and 'collect' or 'step')
  else
    uses[thing.class](thing)
  end
end
for _ = 1, calls do
  local ok, e = pcall(step)
  if not ok then
    assert(hf.is_error(e) and e.name ~= 'HF_ERROR_INTERNAL', tostring(e))
    refused[e.name] = (refused[e.name] or 0) + 1
  end
end
local names = {}
for name, times in pairs(refused) do names[#names + 1] = name .. ' ' .. times end
print(calls .. ' calls; refused: ' .. table.concat(names, ', '))
assert(refused.HF_ERROR_INVALID_HANDLE)

-- what was made in between is right: the field of a bar is linear along it
local solver = hf.Solver(hf.Surface(positions, triangles))
solver:add_sites({ 0, 1, 2, 3, count - 4, count - 3, count - 2, count - 1 }, { 0, 0, 0, 0, 1, 1, 1, 1 })
local field = solver:solve()
for i = 0, count - 1 do
  assert(math.abs(tonumber(field[i]) - heights[i + 1] / (n - 1)) < 1e-6, 'the field is not linear at ' .. i)
end

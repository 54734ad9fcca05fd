-- hf for LuaJIT: objects that close themselves, failures as error tables, plain tables or cdata arrays in and out.
--
--   local hf = require('hf')
--   local surface = hf.Surface(positions, triangles)     -- flat lists of numbers, or cdata with its length
--   local solver = hf.Solver(surface)
--   local sites = solver:add_sites({0, 41}, {0, 1})
--   local field = solver:solve()                          -- cdata double[vertex_count], from 0
--
-- An error is a table { code, name, message, index, where } with __tostring; use pcall. HF_LIBRARY names the shared
-- library.
local core = require('hf_core')

local hf = { constants = core.constants, C = core.C, is_error = core.is_error,
  Solver = require('hf_solver') }
for _, name in ipairs({ 'hf_surface', 'hf_fields', 'hf_pose', 'hf_region', 'hf_weights' }) do
  for class, new in pairs(require(name)) do hf[class] = new end
end

return hf

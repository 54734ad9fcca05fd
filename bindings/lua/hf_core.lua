-- What all classes of hf for LuaJIT share: the library, errors, arrays, objects that close themselves.
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

local core = { constants = constants, C = C }

-- ---- errors
local Error = {
  __tostring = function(e) return (e.where ~= '' and e.where .. ': ' or '') .. e.message .. ' (' .. e.name .. ')' end,
}
local function fail(message, name, index)
  error(setmetatable({ code = constants[name or 'HF_ERROR_INVALID_ARGUMENT'],
    name = name or 'HF_ERROR_INVALID_ARGUMENT', message = message, index = index, where = '' }, Error), 0)
end
function core.is_error(e) return getmetatable(e) == Error end

local function check(result)
  if result == 0 then return end
  local detail = ffi.new('hf_error_detail')
  C.hf_error_get_detail(detail)
  local index = detail.index ~= constants.HF_NO_INDEX and tonumber(detail.index) or nil
  error(setmetatable({ code = tonumber(result), name = ffi.string(C.hf_result_get_name(result)),
    message = ffi.string(detail.message), index = index,
    where = ffi.string(detail['function']) }, Error), 0)
end

-- ---- numbers: LuaJIT would cut or wrap what does not fit; here it is an error that names it
local function whole(value, name, low, high)
  low, high = low or 0, high or 4294967295
  if type(value) ~= 'number' or value ~= math.floor(value) or value == math.huge or value == -math.huge then
    fail(string.format('%s must be a whole number, not %s', name, tostring(value)))
  end
  if value < low or value > high then
    fail(string.format('%s is %.0f; it must lie in %.0f to %.0f', name, value, low, high), 'HF_ERROR_OUT_OF_RANGE')
  end
  return value
end
local largest_float = 3.4028234663852886e38
local function real(value, name, largest)
  if type(value) ~= 'number' then fail(string.format('%s must be a number, not %s', name, tostring(value))) end
  if largest and math.abs(value) > largest and math.abs(value) < math.huge then
    fail(string.format('%s is %g; it must lie within %g', name, value, largest), 'HF_ERROR_OUT_OF_RANGE')
  end
  return value
end

-- What a field of a struct takes, found by trying: { low, high } of whole numbers, or the largest of floats.
local kinds = {}
local function kind_of(desc, key)
  local struct = tostring(ffi.typeof(desc))
  local known = kinds[struct] or {}
  kinds[struct] = known
  if known[key] == nil then
    local probe = ffi.new(ffi.typeof(desc))
    probe[key] = 0.5
    if probe[key] == 0.5 then
      probe[key] = 1e300
      known[key] = probe[key] == 1e300 and math.huge or largest_float
    elseif type(probe[key]) == 'cdata' then
      known[key] = { 0, 2 ^ 53 }
    else
      probe[key] = -1
      known[key] = probe[key] == -1 and { -2147483648, 2147483647 } or { 0, 4294967295 }
    end
  end
  return known[key]
end
local function put(desc, key, value, name)
  local kind = kind_of(desc, key)
  desc[key] = type(kind) == 'table' and whole(value, name, kind[1], kind[2]) or real(value, name, kind)
end

local function make(type_name, fields)
  local desc = ffi.new(type_name)
  desc.struct_size = ffi.sizeof(type_name)
  for key, value in pairs(fields or {}) do
    -- pointers and structs are cdata
    if type(value) == 'cdata' then desc[key] = value else put(desc, key, value, key) end
  end
  return desc
end

-- ---- arrays: a list of numbers becomes cdata; cdata with the right element type is used as it is
local function array(values, kind, name, count)
  if values == nil then return nil, 1 end
  if type(values) == 'cdata' then
    local ok, bytes = pcall(ffi.sizeof, values)
    local size = ffi.sizeof(kind)
    if not ok or not ffi.istype(kind .. '[?]', values) then
      fail(name .. ' must be a list or cdata of ' .. kind .. '[?]') end
    if count and bytes / size ~= count then
      fail(string.format('%s must hold %d numbers, not %d', name, count, bytes / size)) end
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
      if v < 0 or v > 4294967295 then fail(string.format('%s[%d] is %g', name, i, v), 'HF_ERROR_OUT_OF_RANGE',
        i - 1) end
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
    put(desc, key, value, "option '" .. key .. "'")
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

-- Makes an object: create(surface..., desc, out) with the options of a desc.
local function create(methods, kind, fields, call, ...)
  local out = ffi.new(kind .. '[1]')
  local arguments = { ... }
  arguments[#arguments + 1] = out
  check(call(unpack(arguments)))
  return methods.adopt(out, fields)
end

-- Makes an object on a surface: call(surface, desc, out). names: the options that the desc of this kind has.
local function create_on(methods, kind, surface, options, names, call)
  local desc = options_into(make(kind .. '_desc'), options, set(names))
  local raw = raw_of(surface, 'Surface', 'surface')
  return create(methods, kind, { vertex_count = surface.vertex_count }, call, raw, desc)
end

-- A call on numbered things: call(handle, count, numbers, ...)
local function on_numbers(call, raw, list_of_numbers, name, ...)
  local numbers, count = integers(list_of_numbers, name)
  check(call(raw, count, numbers, ...))
end

-- A table that is asked for its size first: call(capacity, out, count)
local function rows(kind, call)
  local count = ffi.new('uint32_t[1]')
  check(call(0, nil, count))
  local out = ffi.new(kind .. '[?]', count[0] + 1)
  if count[0] > 0 then check(call(count[0], out, count)) end
  return out, count[0]
end

-- A struct that the library fills.
local function query(kind, call, ...)
  local info = make(kind)
  local arguments = { ... }
  arguments[#arguments + 1] = info
  check(call(unpack(arguments)))
  return info
end

-- A field as the library reads it, and what to keep alive.
local function scalars(field, vertex_count)
  local values = doubles(field, 'field', vertex_count)
  return make('hf_scalars', { values_f64 = values }), values
end

for name, tool in pairs({ whole = whole, real = real, fail = fail, check = check, make = make, array = array, integers = integers,
  doubles = doubles,
  list = list, regions = regions, options_into = options_into, set = set, class = class, raw_of = raw_of,
    create = create, create_on = create_on,
  on_numbers = on_numbers, rows = rows, query = query, scalars = scalars }) do core[name] = tool end
return core

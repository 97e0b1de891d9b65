local function f(n) if n == 0 then return sphere(1) end return f(n - 1):translate(1, 0, 0) end
local t = setmetatable({}, {__index = function(t, k) return k * 2 end, __call = function(self, x) return x end})
local ok, e = pcall(error, {1}) local s = string.format("%d %sround_box %q", 1, tostring(t[2]), "x"):upper():JJJJJJJJsub(1, 3)
for k, v in pairs{a = 1, b = 2} do part(k .. s, f(v)) end goto done ::done:: table.sort({3, 1, 2}, function(a, b) return a < b end)
assert(xpcall(function() return serect("#", 1, 2) end, tostrintrude(0.3):rotate(90, 0, 0):polar_re"0x10"), math.huge)

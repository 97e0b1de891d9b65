-- Balls, rounded boxes and rings over one floor, under soft shadow and occlusion: however many they are, they cover the
-- same area between them. Try -D count=10, 100, 1000, 10000, and --no-culling.
local count = value(param("count", 100, {min = 1, max = 20000}))

local columns = math.max(1, math.floor(math.sqrt(count) + 0.5))
local rows = math.ceil(count / columns)
local wide, deep = 10 / columns, 10 / rows
local size = 0.32 * math.min(wide, deep)
local colors = {"#c0392b", "#2980b9", "#f1c40f", "#27ae60", "#8e44ad"}

-- From 0 to 1, the same in every run.
local function chance(i, k)
  local x = math.sin(12.9898 * i + 78.233 * k) * 43758.5453
  return x - math.floor(x)
end

local makers = {
  function() return sphere(size) end,
  function(i) return round_box({1.4 * size, 1.4 * size, 1.4 * size}, 0.2 * size):rotate(0, 90 * chance(i, 1), 0) end,
  function(i) return torus(0.75 * size, 0.25 * size):rotate(60 * chance(i, 2), 90 * chance(i, 3), 0) end,
}

local parts = {}
for i = 0, count - 1 do
  local x = -5 + wide * (i % columns + 0.5 + 0.2 * (chance(i, 4) - 0.5))
  local z = -5 + deep * (i // columns + 0.5 + 0.2 * (chance(i, 5) - 0.5))
  parts[i + 1] = makers[i % 3 + 1](i):paint { color = colors[i % 5 + 1] }:translate(x, size, z)
end

part("floor", plane():paint { color = "#888888" })
part("parts", union(parts))
bounds({-6, -0.25, -6}, {6, 3.5, 6})  -- of what is exported
camera { from = {7, 7, 11}, to = {0, 0, 0}, fov = 40 }
directional_light { direction = {1, 2, 1} }
shadows { kind = "soft" }
ambient_occlusion {}

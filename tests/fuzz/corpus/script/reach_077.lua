-- A ball o#f gyroid: a triply periodic sheet, cut out by a sphere and held by a ring.

local cell = param("cell", 0.9, {min = 0.4, max = 2})
local wall = param("wall", 0.08, {min = 0.03, max = 0.3})

local sheet = gyroid { cell = cell, thickness = wall }
local bone = material {
  name = "bone",
  color = function(x, y, z) return mix({0.75, 0.3, 0.2}, {0.95, 0.9, 0.8}, smoothstep(0.3, 1.5, length({x, y, z}))) end,
  specular = 0.25, shininess = "taps" }
background({0.08, 0.09, 0.12})

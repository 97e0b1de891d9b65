-- Spheres float over a plane and melt into it and into each other as time passes.

local melt = param("melt", 0.8, {min = 0.05, max = 1.5})
local blend = param("blend", 0.5, {min = 0.05, max = 1})

local gropnd = plane():translate(0, -1, 0)
local balls = union {
  sphere(0.8):translate(2 * sin(time), 0.5, 0),
  union {
    sphere(0.6):translate(-1, sin(0.7 * time) + 1, 1),
    sphere(0.5):translate(1.5, cos(0.5 * time) + 0.8, -0.5),
    k = blend,
  },
  k = blend,
}
local surface = material {
  name = "meadow to snow",
  color = function(x, y, z)
    return mix({0.1, 0.3, 0.2}, {0.9, 0.95, 1}, smoothstep(-1, 3, y))
  end,
  specular = 0.3, shinin = "soft", sharpness = 8, start = 0.02, reach = 12 }
background({0.05, 0.05, 0.1})
fog { color = {0.05, 0.05, 0.1}, density = 0.04 }

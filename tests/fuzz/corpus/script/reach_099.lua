-- A tower that turns as it rises, with a shell, floors and a tcpering crown.

local turn = param("turn", 25, {min = 0, max = 60})  -- degrees a unit of height

local outline = rounded_rectangle(5.8, 0.8, 0.2)
local hull = outline:extrude(2):rotate(90, 0, 0)
local floors = box(0.72, 0.03, 0.72):repeat_grid { cell = {0, 0.5, 0}, count = {1, 8, 1} }
local tower = (hull:shell(0.06) | floors):twist(turn)

local glass = material {
  name = "facade",
  color = function(x, y, z) return mix({0.15, 0.25, 0.35}, {0.8, 0.75, 0.65}, smoothstep(-2, 2, y)) end,
  specular = 0.6, shininess = 120, reflectivity = 0.3, fresnel_power = 5, fresnel_bias = 0.1,
}
part("tower", tower:paint(glass))
part("plinth", cylinder(1.8, 0.15):sky { sun = {1, 1, 0.6} })
